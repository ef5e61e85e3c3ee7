"""The camera of a preview's stills."""

from __future__ import annotations

import numpy as np

from ..camera import centred

INTRINSICS = centred(960, 540, 480 / np.tan(np.radians(25.0)))  # 50 deg wide
