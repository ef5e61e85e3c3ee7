"""Smooth transitions between two values."""

from __future__ import annotations

import numpy as np


def smooth(share) -> np.ndarray:
    """0 below 0, 1 above 1, and a slope of 0 at both; its largest slope, in the middle, is 1.5."""
    share = np.clip(share, 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)
