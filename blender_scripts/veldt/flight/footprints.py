"""The area of ground that a camera sees."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..camera import Intrinsics, edge_tangents


@dataclass(frozen=True)
class Footprint:
    """The extent of level ground in a picture, in m.

    width_m: width of the row nearest to the camera, the narrowest. If the principal point is off the centre, twice the
    narrower half, which is what lanes in both directions see of the ground beside them. near_m and far_m: distance
    ahead, from the point below the camera to the nearest and the farthest row. near_m is negative behind the camera;
    far_m is infinite if the horizon is in the picture.
    """

    width_m: float
    near_m: float
    far_m: float


def footprint(intrinsics: Intrinsics, height_m: float, look_angle_deg: float) -> Footprint:
    """Footprint of a camera without roll at height_m > 0 above level ground; look_angle_deg 0 to 90 below horizon."""
    down, ahead = math.sin(math.radians(look_angle_deg)), math.cos(math.radians(look_angle_deg))
    (left, top), (right, bottom) = edge_tangents(intrinsics)
    # A ray through the lowest row advances 1 m along the camera's axis and `bottom` downwards in the picture.
    drop, top_drop = down + bottom * ahead, down - top * ahead
    far_m = height_m * (ahead + top * down) / top_drop if top_drop > 0.0 else math.inf
    near_m = height_m * (ahead - bottom * down) / drop
    return Footprint(2.0 * min(left, right) * height_m / drop, near_m, far_m)
