"""How much ground a camera sees."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..camera import Intrinsics


@dataclass(frozen=True)
class Footprint:
    """Level ground in a picture, in m.

    width_m: across the picture's edge nearest to the camera, its narrowest row; near_m and far_m: from below the camera
    ahead to the nearest and the farthest row. near_m is below 0 behind the camera; far_m is infinite if the picture
    reaches up to the horizon.
    """

    width_m: float
    near_m: float
    far_m: float


def footprint(intrinsics: Intrinsics, height_m: float, look_angle_deg: float) -> Footprint:
    """What a camera without roll sees from height_m > 0 over level ground; look_angle_deg 0 to 90 below the horizon."""
    down, ahead = math.sin(math.radians(look_angle_deg)), math.cos(math.radians(look_angle_deg))
    half_high, half_wide = (
        0.5 * side_px / intrinsics.f_px for side_px in (intrinsics.height_px, intrinsics.width_px)
    )
    # A ray through the lowest row goes 1 m along the camera's axis and half_high across it, downwards in the picture.
    drop, top_drop = down + half_high * ahead, down - half_high * ahead
    far_m = height_m * (ahead + half_high * down) / top_drop if top_drop > 0.0 else math.inf
    near_m = height_m * (ahead - half_high * down) / drop
    return Footprint(2.0 * half_wide * height_m / drop, near_m, far_m)
