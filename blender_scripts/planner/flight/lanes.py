"""Lanes of a zigzag, and the area of ground that a camera sees from them."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..camera import Intrinsics, edge_tangents
from ..faults import ConfigError
from .path_segments import Point, beside


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


@dataclass(frozen=True)
class Lane:
    """Flown from `start` to `end` on course_rad."""

    start: Point
    end: Point
    course_rad: float


def check_lane_spacing(where: str, plan: dict, footprint: Footprint) -> None:
    """Check that neighbouring lanes leave no gap between their footprints."""
    spacing_m = plan.get("lane_spacing_m")
    if spacing_m is not None and spacing_m > footprint.width_m:
        most_m = math.floor(10.0 * footprint.width_m) / 10.0  # rounded down: the stated spacing is accepted
        raise ConfigError(
            f"{where}.lane_spacing_m = {spacing_m:g} m; expected at most {most_m:g} m,"
            " the width of ground in the picture"
        )


def lane_spacing_m(plan: dict, footprint: Footprint) -> float:
    """The given spacing, or the width of ground in the picture less `overlap`."""
    given_m = plan.get("lane_spacing_m")
    return footprint.width_m * (1.0 - plan["overlap"]) if given_m is None else given_m


def round_of_lanes(plan: dict, footprint: Footprint, nose_turns: bool) -> list[Lane]:
    """The lanes over area_m in the order flown: to the last one and back to the second; then it repeats.

    They lie side by side, in alternating directions, in the smallest rectangle rotated by heading_deg that contains
    area_m. A camera that looks ahead does not see the ground below it, so each lane is shifted back by near_m, against
    the direction in which the camera looks; its nearest row then sweeps the rectangle from end to end. That direction
    is the course if nose_turns, and heading_deg on all lanes otherwise.
    """
    half_along_m, half_across_m = half_extents_m(plan)
    spacing_m = lane_spacing_m(plan, footprint)
    # A turn needs a second lane; and a width that is a whole number of lanes up to rounding gets no extra lane.
    lanes = max(2, math.ceil(2.0 * half_across_m / spacing_m - 1e-9))
    order = [*range(lanes), *range(lanes - 2, 0, -1)]
    return [
        _lane(
            plan,
            left_m=(k - 0.5 * (lanes - 1)) * spacing_m,
            half_m=half_along_m,
            shift_m=max(footprint.near_m, 0.0) * (-1.0 if nose_turns and place % 2 else 1.0),
            goes_back=place % 2 == 1,
        )
        for place, k in enumerate(order)
    ]


def half_extents_m(plan: dict) -> tuple[float, float]:
    """Half lengths along and across heading_deg of the smallest rectangle in that direction that contains area_m."""
    x0, y0, x1, y1 = plan["area_m"]
    heading_rad = math.radians(plan["heading_deg"])
    cos, sin = abs(math.cos(heading_rad)), abs(math.sin(heading_rad))
    return 0.5 * ((x1 - x0) * cos + (y1 - y0) * sin), 0.5 * ((x1 - x0) * sin + (y1 - y0) * cos)


def _lane(plan: dict, left_m: float, half_m: float, shift_m: float, goes_back: bool) -> Lane:
    """A lane left_m beside the middle of the area, half_m to both ends, shifted back by shift_m against heading_deg."""
    x0, y0, x1, y1 = plan["area_m"]
    middle, heading_rad = (0.5 * (x0 + x1), 0.5 * (y0 + y1)), math.radians(plan["heading_deg"])
    rear, front = (beside(middle, heading_rad, end_m - shift_m, left_m) for end_m in (-half_m, half_m))
    return Lane(front, rear, heading_rad + math.pi) if goes_back else Lane(rear, front, heading_rad)
