"""How a rigid leg swings while its foot keeps up with the ground."""

from __future__ import annotations

import numpy as np

STANCE = 0.6  # share of a stride a foot is on the ground; walking animals 0.5 to 0.75 (Alexander 1989)


def swing_rad(phase, stride_m: float, leg_m: float) -> np.ndarray:
    """Angle of a leg about the hip's y axis, positive backward, at `phase` strides after it touched down.

    On the ground the foot moves straight back by STANCE * stride_m while the body moves forward as far, so it does not
    slide; then it swings forward smoothly. The foot never reaches farther than 0.9 leg_m from under the hip.
    """
    phase = np.mod(np.asarray(phase, float), 1.0)
    reach = min(0.5 * STANCE * stride_m / leg_m, 0.9)
    ground = phase / STANCE
    air = (phase - STANCE) / (1.0 - STANCE)
    back = np.where(phase < STANCE, 2.0 * ground - 1.0, np.cos(np.pi * np.clip(air, 0.0, 1.0)))
    return np.arcsin(reach * back)
