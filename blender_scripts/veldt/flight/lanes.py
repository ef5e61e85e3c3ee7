"""Lanes of a zigzag."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..faults import ConfigError
from .footprints import Footprint
from .pieces import Point, beside


@dataclass(frozen=True)
class Lane:
    """Flown from `start` to `end` on course_rad."""

    start: Point
    end: Point
    course_rad: float


def check_lane_spacing(where: str, plan: dict, footprint: Footprint) -> None:
    """Neighbouring lanes leave no gap between what they see."""
    spacing_m = plan.get("lane_spacing_m")
    if spacing_m is not None and spacing_m > footprint.width_m:
        most_m = math.floor(10.0 * footprint.width_m) / 10.0  # what is named must be allowed
        raise ConfigError(
            f"{where}.lane_spacing_m = {spacing_m:g} m; expected at most {most_m:g} m,"
            " the width of ground in the picture"
        )


def lane_spacing_m(plan: dict, footprint: Footprint) -> float:
    """As given, or what `overlap` leaves of the ground's width in the picture."""
    given_m = plan.get("lane_spacing_m")
    return footprint.width_m * (1.0 - plan["overlap"]) if given_m is None else given_m


def round_of_lanes(plan: dict, footprint: Footprint, nose_turns: bool) -> list[Lane]:
    """The lanes over area_m in the order they are flown in: to the last one and back to the second; then it repeats.

    They lie side by side in the smallest rectangle turned by heading_deg that holds area_m, forth and back in turn. A
    camera that looks ahead sees the ground below it only later or never: what each lane sees in its nearest row goes
    from one end of the rectangle to the other if the lane itself is shifted back by near_m against where the camera
    looks. That is against the course if nose_turns, and against heading_deg on all lanes otherwise.
    """
    half_along_m, half_across_m = half_extents_m(plan)
    spacing_m = lane_spacing_m(plan, footprint)
    # A turn needs a lane to turn into; and a width that is whole lanes but for rounding gets no lane more.
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
    """Half lengths along and across heading_deg of the smallest rectangle so turned that holds area_m."""
    x0, y0, x1, y1 = plan["area_m"]
    heading_rad = math.radians(plan["heading_deg"])
    cos, sin = abs(math.cos(heading_rad)), abs(math.sin(heading_rad))
    return 0.5 * ((x1 - x0) * cos + (y1 - y0) * sin), 0.5 * ((x1 - x0) * sin + (y1 - y0) * cos)


def _lane(plan: dict, left_m: float, half_m: float, shift_m: float, goes_back: bool) -> Lane:
    """left_m beside the area's middle, half_m to both ends, all of it shift_m back against heading_deg."""
    x0, y0, x1, y1 = plan["area_m"]
    middle, heading_rad = (0.5 * (x0 + x1), 0.5 * (y0 + y1)), math.radians(plan["heading_deg"])
    rear, front = (beside(middle, heading_rad, end_m - shift_m, left_m) for end_m in (-half_m, half_m))
    return Lane(front, rear, heading_rad + math.pi) if goes_back else Lane(rear, front, heading_rad)
