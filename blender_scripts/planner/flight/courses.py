"""Courses of flight plans: a zigzag, a transect, waypoints.

A multirotor stops at each corner; a fixed wing rounds them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..faults import ConfigError
from .aircraft import FIXED_WING, Aircraft
from .dubins import shortest
from .lanes import Footprint, Lane, round_of_lanes
from .path_segments import NOTHING_M, Arc, Piece, Point, Straight, beside, distance_m, turn_rad
from .speed_profile import Steady, StopToStop
from .timetables import Leg, Stay, Step, Timetable, spin
from .waypoints import Place, SurfaceAt, Waypoint, climb_between, merged

_MOST_TURN_DEG = 175.0  # at a corner this sharp, the arc starts 22 radii before the waypoint


def zigzag_course(plan: dict, aircraft: Aircraft, footprint: Footprint, nose_turns: bool = True) -> Timetable:
    """Lanes over area_m (`lanes.round_of_lanes`), flown back and forth endlessly from the start of the first lane.

    A fixed wing flies from lane to lane on the shortest path that its turn radius allows, at constant speed. A
    multirotor stops at both ends of a lane and turns on the spot. Without nose_turns the camera looks along heading_deg
    on all lanes, and a multirotor keeps its nose in that direction too.
    """
    lanes = round_of_lanes(plan, footprint, nose_turns)
    return _there_and_back(lanes, aircraft, None if nose_turns else math.radians(plan["heading_deg"]))


def transect_course(plan: dict, aircraft: Aircraft, nose_turns: bool = True) -> Timetable:
    """From the first of points_m to the second and back, endlessly, with the turns of a zigzag.

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
    gives the height (n,) of ground or water to convert the first one's. A multirotor flies straight and stops at each;
    a fixed wing rounds the corners. ConfigError, without its key in the config, if it cannot.
    """
    places = merged(waypoints, aircraft.speed_m_s)
    if aircraft.kind == FIXED_WING:
        return Timetable(_fly_by_turns(places, aircraft, height_at), repeats=False)
    return Timetable(_visits(places, aircraft.acceleration_m_s2, height_at, nose_turns), repeats=False)


def _there_and_back(lanes: Sequence[Lane], aircraft: Aircraft, nose_rad: float | None) -> Timetable:
    """`nose_rad`: fixed direction of a multirotor's nose; None: along its course."""
    if aircraft.kind == FIXED_WING:
        return Timetable(_winged_round(lanes, aircraft), repeats=True)
    return Timetable(_hovering_round(lanes, aircraft, nose_rad), repeats=True)


def _winged_round(lanes: Sequence[Lane], aircraft: Aircraft) -> list[Step]:
    """At constant speed, with the shortest path from the end of each lane to the start of the next, in a ring."""
    pieces = []
    for lane, after in zip(lanes, _next(lanes)):
        pieces.append(Straight(lane.start, lane.end))
        pieces += shortest(lane.end, lane.course_rad, after.start, after.course_rad, aircraft.turn_radius_m)
    return [Leg(piece, Steady(piece.length_m, aircraft.speed_m_s)) for piece in pieces]


def _hovering_round(lanes: Sequence[Lane], aircraft: Aircraft, nose_rad: float | None) -> list[Step]:
    """From stop to stop, turning on the spot towards the next lane, or with the nose always at nose_rad."""
    corners = [corner for lane in lanes for corner in (lane.start, lane.end)]
    ways = [Straight(a, b) for a, b in zip(corners, _next(corners)) if distance_m(a, b) > NOTHING_M]
    steps: list[Step] = []
    for way, after in zip(ways, _next(ways)):
        law = StopToStop(way.length_m, aircraft.speed_m_s, aircraft.acceleration_m_s2)
        steps.append(Leg(way, law, nose_rad))
        if nose_rad is None:
            steps += spin(way.end, way.courses_rad[1], after.courses_rad[0])
    return steps


def _next(things: Sequence) -> list:
    """The successor of each item in a ring."""
    return [*things[1:], things[0]]


def _visits(
    places: Sequence[Place], acceleration_m_s2: float, surface_at: SurfaceAt, nose_turns: bool
) -> list[Step]:
    """From stop to stop, turning on the spot towards the next waypoint, or with the nose kept as on the first leg.

    Over a single waypoint it hovers endlessly, its nose towards +x.
    """
    if len(places) == 1:
        return [Stay(places[0].point_m, math.inf, 0.0, climb=places[0].level)]
    ways = [Straight(start.point_m, end.point_m) for start, end in zip(places, places[1:])]
    nose_rad = ways[0].courses_rad[0]
    steps = _hold(places[0], nose_rad)
    for way, start, end in zip(ways, places, places[1:]):
        if nose_turns:
            steps += spin(way.start, nose_rad, way.courses_rad[0], start.level)
            nose_rad = way.courses_rad[1]
        law = StopToStop(way.length_m, start.speed_m_s, acceleration_m_s2)
        steps.append(Leg(way, law, nose_rad, climb_between(start, end, way.start, surface_at)))
        steps += _hold(end, nose_rad)
    return steps


def _hold(place: Place, nose_rad: float) -> list[Step]:
    return [Stay(place.point_m, place.hold_s, nose_rad, climb=place.level)] if place.hold_s > 0.0 else []


@dataclass(frozen=True)
class _Corner:
    """An arc tangent to both legs at inset_m from the corner, turning by turn_rad."""

    inset_m: float
    radius_m: float
    turn_rad: float


def _fly_by_turns(places: Sequence[Place], aircraft: Aircraft, surface_at: SurfaceAt) -> list[Step]:
    """Past all waypoints but the first and the last on arcs tangent to the legs, each leg at its own speed.

    The radius of an arc is that of the faster leg. A leg, and the change of height along it, extends from the middle of
    one arc to the middle of the next. ConfigError for a single waypoint, a hold time, a turn of more than 175 deg, or a
    leg too short for its arcs.
    """
    _check_winged(places)
    courses_rad = [Straight(a.point_m, b.point_m).courses_rad[0] for a, b in zip(places, places[1:])]
    corners = _corners(places, courses_rad, aircraft)
    steps: list[Step] = []
    for k, (start, end) in enumerate(zip(places, places[1:])):
        _check_leg(start, end, corners[k].inset_m + corners[k + 1].inset_m)
        pieces = _pieces(start.point_m, end.point_m, courses_rad[k], corners[k], corners[k + 1])
        steps += _climbing(pieces, start, end, surface_at)
    return steps


def _corners(places: Sequence[Place], courses_rad: Sequence[float], aircraft: Aircraft) -> list[_Corner]:
    """A corner for each waypoint; those of the first and the last are empty."""
    none = _Corner(0.0, 0.0, 0.0)
    return [
        none,
        *(_corner(*places[k : k + 2], *courses_rad[k : k + 2], aircraft) for k in range(len(places) - 2)),
        none,
    ]


def _corner(before: Place, here: Place, in_rad: float, out_rad: float, aircraft: Aircraft) -> _Corner:
    turn = turn_rad(in_rad, out_rad)
    if abs(turn) > math.radians(_MOST_TURN_DEG):
        raise ConfigError(
            f"the turn at waypoint {here.number} = {math.degrees(abs(turn)):.1f} deg;"
            f" expected at most {_MOST_TURN_DEG:g} deg for a fixed wing"
        )
    radius_m = replace(aircraft, speed_m_s=max(before.speed_m_s, here.speed_m_s)).turn_radius_m
    return _Corner(radius_m * math.tan(0.5 * abs(turn)), radius_m, turn)


def _pieces(start: Point, end: Point, course_rad: float, first: _Corner, last: _Corner) -> list[Piece]:
    """The second half of the first corner's arc, a straight line, and the first half of the second corner's arc."""
    leaves, enters = beside(start, course_rad, first.inset_m), beside(end, course_rad, -last.inset_m)
    pieces = [
        _half_arc(leaves, course_rad, first, -1.0),
        Straight(leaves, enters),
        _half_arc(enters, course_rad, last, 0.0),
    ]
    return [piece for piece in pieces if piece.length_m > NOTHING_M]


def _half_arc(touches: Point, course_rad: float, corner: _Corner, begins: float) -> Arc:
    """Half of a corner's arc, which begins (0) or ends (-1) at its tangent point on the leg."""
    left = math.copysign(1.0, corner.turn_rad)
    centre = beside(touches, course_rad, 0.0, left * corner.radius_m)
    half_rad = 0.5 * corner.turn_rad
    return Arc(centre, corner.radius_m, course_rad - 0.5 * math.pi * left + begins * half_rad, half_rad)


def _climbing(pieces: Sequence[Piece], start: Place, end: Place, surface_at: SurfaceAt) -> list[Step]:
    """The pieces at constant speed, with the climb distributed by length."""
    start_m, _ = pieces[0].at([0.0])
    climb = climb_between(start, end, tuple(start_m[0]), surface_at)
    rise_per_m = (climb.end_m - climb.start_m) / sum(piece.length_m for piece in pieces)
    steps, from_m = [], climb.start_m
    for piece in pieces:
        to_m = from_m + rise_per_m * piece.length_m
        part = replace(climb, start_m=from_m, end_m=to_m)
        steps.append(Leg(piece, Steady(piece.length_m, start.speed_m_s), climb=part))
        from_m = to_m
    return steps


def _check_winged(places: Sequence[Place]) -> None:
    if len(places) < 2:
        raise ConfigError("the waypoints = 1 place; expected at least 2, since a fixed wing cannot hover")
    for place in places:
        if place.hold_s > 0.0:
            raise ConfigError(
                f"the hold at waypoint {place.number} = {place.hold_s:g} s;"
                " expected 0 s, since a fixed wing cannot hover"
            )


def _check_leg(start: Place, end: Place, needed_m: float) -> None:
    length_m = distance_m(start.point_m, end.point_m)
    if length_m < needed_m:
        most_m = math.ceil(10.0 * needed_m) / 10.0  # rounded up: the stated length is sufficient
        raise ConfigError(
            f"the leg to waypoint {end.number} = {length_m:.1f} m;"
            f" expected at least {most_m:.1f} m for a fixed wing's turns at its ends"
        )
