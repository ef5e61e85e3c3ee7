"""Courses of flight plans: a zigzag, a transect, waypoints."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .aircraft import FIXED_WING, Aircraft
from .fly_by_turns import fly_by_turns
from .footprints import Footprint
from .lanes import Lane, round_of_lanes
from .path_segments import Straight
from .places import SurfaceAt, merged
from .lane_loops import hovering_round, winged_round
from .timetables import Timetable
from .visits import visits
from .waypoints import Waypoint


def zigzag_course(plan: dict, aircraft: Aircraft, footprint: Footprint, nose_turns: bool = True) -> Timetable:
    """Lanes over area_m (`lanes.round_of_lanes`), flown there and back without end from the start of the first lane.

    A fixed wing flies from lane to lane on the shortest path that its turn radius allows, at constant speed. A
    multirotor stops at both ends of a lane and turns on the spot. Without nose_turns the camera looks along heading_deg
    on all lanes, and a multirotor keeps its nose in that direction too.
    """
    lanes = round_of_lanes(plan, footprint, nose_turns)
    return _there_and_back(lanes, aircraft, None if nose_turns else math.radians(plan["heading_deg"]))


def transect_course(plan: dict, aircraft: Aircraft, nose_turns: bool = True) -> Timetable:
    """From the first of points_m to the second and back without end, with the turns of a zigzag.

    Without nose_turns a multirotor flies back tail first.
    """
    start, end = (tuple(map(float, point)) for point in plan["points_m"])
    course_rad = Straight(start, end).courses_rad[0]
    lanes = [Lane(start, end, course_rad), Lane(end, start, course_rad + math.pi)]
    return _there_and_back(lanes, aircraft, None if nose_turns else course_rad)


def waypoint_course(
    waypoints: Sequence[Waypoint],
    aircraft: Aircraft,
    height_at: SurfaceAt,
    nose_turns: bool = True,
) -> Timetable:
    """Through waypoints, at least one, in their order, once.

    Between two waypoints the height changes linearly, in the height reference of the second; height_at(x (n,), y (n,))
    gives the height (n,) of ground or water to convert the first one's. A multirotor flies straight and stops at each
    (`visits`); a fixed wing rounds the corners (`fly_by_turns`). ConfigError, without its place in the config,
    if it cannot.
    """
    places = merged(waypoints, aircraft.speed_m_s)
    if aircraft.kind == FIXED_WING:
        return Timetable(fly_by_turns(places, aircraft, height_at), repeats=False)
    return Timetable(visits(places, aircraft.acceleration_m_s2, height_at, nose_turns), repeats=False)


def _there_and_back(lanes: Sequence[Lane], aircraft: Aircraft, nose_rad: float | None) -> Timetable:
    """`nose_rad`: fixed direction of a multirotor's nose; None: along its course."""
    if aircraft.kind == FIXED_WING:
        return Timetable(winged_round(lanes, aircraft), repeats=True)
    return Timetable(hovering_round(lanes, aircraft, nose_rad), repeats=True)
