"""The course of a fixed wing along waypoints: it rounds the corners."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..faults import ConfigError
from .aircraft import Aircraft
from .speed_profile import Steady
from .path_segments import NOTHING_M, Arc, Piece, Point, Straight, beside, distance_m, turn_rad
from .places import Place, SurfaceAt, climb_between
from .timetables import Leg, Step

_MOST_TURN_DEG = 175.0  # at a corner this sharp, the arc starts 22 radii before the waypoint


@dataclass(frozen=True)
class _Corner:
    """An arc tangent to both legs at inset_m from the place, turning by turn_rad."""

    inset_m: float
    radius_m: float
    turn_rad: float


def fly_by_turns(places: Sequence[Place], aircraft: Aircraft, surface_at: SurfaceAt) -> list[Step]:
    """Past all places but the first and the last on arcs tangent to the legs, each leg at its own speed.

    The radius of an arc is that of the faster leg. A leg, and the change of height along it, extends from the middle of
    one arc to the middle of the next. ConfigError for a single place, a hold time, a turn of more than 175 deg, or a
    leg too short for its arcs.
    """
    _check_places(places)
    courses_rad = [Straight(a.point_m, b.point_m).courses_rad[0] for a, b in zip(places, places[1:])]
    corners = _corners(places, courses_rad, aircraft)
    steps: list[Step] = []
    for k, (start, end) in enumerate(zip(places, places[1:])):
        _check_leg(start, end, corners[k].inset_m + corners[k + 1].inset_m)
        pieces = _pieces(start.point_m, end.point_m, courses_rad[k], corners[k], corners[k + 1])
        steps += _steps(pieces, start, end, surface_at)
    return steps


def _corners(places: Sequence[Place], courses_rad: Sequence[float], aircraft: Aircraft) -> list[_Corner]:
    """A corner for each place; those of the first and the last are empty."""
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


def _steps(pieces: Sequence[Piece], start: Place, end: Place, surface_at: SurfaceAt) -> list[Step]:
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


def _check_places(places: Sequence[Place]) -> None:
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
