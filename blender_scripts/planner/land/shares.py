"""Shares of the ground, kept in bytes."""

from __future__ import annotations

import numpy as np

_WHOLE = 255  # of a share stored in a byte


def as_bytes(share: np.ndarray) -> np.ndarray:
    """Shares as bytes, of which 255 is all."""
    return np.rint(_WHOLE * np.clip(share, 0.0, 1.0)).astype("|u1")


def raise_to(shares: np.ndarray, place: np.ndarray, share: np.ndarray) -> None:
    """Raise bytes at flat indices (n,), which may repeat, to the largest of their new values (n,) if that is more."""
    flat = shares.reshape(-1)
    more = share > flat[place]
    while more.any():  # of several new values for an index, NumPy keeps one; larger ones remain
        place, share = place[more], share[more]
        flat[place] = share
        more = share > flat[place]
