"""Waypoints, and the distinct positions that they are merged into, each with a speed of its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .path_segments import Point, distance_m
from .timetables import Climb

_SAME_M = 1e-3

SurfaceAt = Callable[
    [np.ndarray, np.ndarray], np.ndarray
]  # height (n,) of ground or water over x (n,), y (n,), m


@dataclass(frozen=True)
class Waypoint:
    """A position to fly to: height_m above ground or above the datum; hold_s to stay there.

    speed_m_s applies from here on; None keeps the speed.
    """

    point_m: tuple[float, float]
    height_m: float
    is_agl: bool
    hold_s: float = 0.0
    speed_m_s: float | None = None


@dataclass(frozen=True)
class Place:
    """A waypoint with its `number`, from 1, or several at one position; speed_m_s applies from here on."""

    number: int
    point_m: Point
    height_m: float
    is_agl: bool
    hold_s: float
    speed_m_s: float

    @property
    def level(self) -> Climb:
        """A step at constant height."""
        return Climb(self.height_m, self.height_m, self.is_agl)


def merged(waypoints: Sequence[Waypoint], speed_m_s: float) -> list[Place]:
    """Merged positions of waypoints, flown to at speed_m_s > 0 until a waypoint changes the speed.

    Successive waypoints less than 1 mm apart become one, with the last one's height and speed and the sum of their hold
    times.
    """
    places: list[Place] = []
    for k, waypoint in enumerate(waypoints):
        speed_m_s = speed_m_s if waypoint.speed_m_s is None else waypoint.speed_m_s
        place = Place(k + 1, waypoint.point_m, waypoint.height_m, waypoint.is_agl, waypoint.hold_s, speed_m_s)
        if places and distance_m(places[-1].point_m, place.point_m) < _SAME_M:
            place = replace(place, hold_s=places[-1].hold_s + place.hold_s, point_m=places[-1].point_m)
            places.pop()
        places.append(place)
    return places


def climb_between(start: Place, end: Place, start_m: Point, surface_at: SurfaceAt) -> Climb:
    """The climb between two waypoints, in the height reference of the second; the leg begins over start_m."""
    if start.is_agl == end.is_agl:
        return Climb(start.height_m, end.height_m, end.is_agl)
    surface_m = float(surface_at(np.array([start_m[0]]), np.array([start_m[1]]))[0])
    return Climb(start.height_m + (surface_m if start.is_agl else -surface_m), end.height_m, end.is_agl)
