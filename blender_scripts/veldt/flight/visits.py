"""The course of a multirotor through waypoints: it stops at each."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .speed_profile import StopToStop
from .path_segments import Straight
from .places import Place, SurfaceAt, climb_between
from .timetables import Leg, Stay, Step, spin


def visits(
    places: Sequence[Place], acceleration_m_s2: float, surface_at: SurfaceAt, nose_turns: bool
) -> list[Step]:
    """From stop to stop, turning on the spot towards the next place, or with the nose kept as on the first leg.

    Over a single place it hovers without end, its nose towards +x.
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
