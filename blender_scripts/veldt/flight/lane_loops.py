"""The steps of closed courses along lanes."""

from __future__ import annotations

from collections.abc import Sequence

from .aircraft import Aircraft
from .dubins import shortest
from .lanes import Lane
from .speed_profile import Steady, StopToStop
from .path_segments import NOTHING_M, Straight, distance_m
from .timetables import Leg, Step, spin


def winged_round(lanes: Sequence[Lane], aircraft: Aircraft) -> list[Step]:
    """At constant speed, with the shortest path from the end of each lane to the start of the next, in a ring."""
    pieces = []
    for lane, after in zip(lanes, _next(lanes)):
        pieces.append(Straight(lane.start, lane.end))
        pieces += shortest(lane.end, lane.course_rad, after.start, after.course_rad, aircraft.turn_radius_m)
    return [Leg(piece, Steady(piece.length_m, aircraft.speed_m_s)) for piece in pieces]


def hovering_round(lanes: Sequence[Lane], aircraft: Aircraft, nose_rad: float | None) -> list[Step]:
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
