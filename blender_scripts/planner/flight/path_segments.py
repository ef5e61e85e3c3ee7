"""The pieces of flight paths: straight lines and arcs."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

Point = tuple[float, float]

NOTHING_M = 1e-9  # a shorter piece is a rounding error, and so is its direction


@dataclass(frozen=True)
class Straight:
    """A straight line between two points, m."""

    start: Point
    end: Point

    @property
    def length_m(self) -> float:
        """Distance between the points."""
        return distance_m(self.start, self.end)

    @property
    def courses_rad(self) -> tuple[float, float]:
        """Courses at its start and its end, which are equal."""
        course_rad = math.atan2(self.end[1] - self.start[1], self.end[0] - self.start[0])
        return course_rad, course_rad

    def at(self, along_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points (n, 2) and courses (n,) at distances (n,) from the start, 0 to length_m, which must not be 0."""
        share = np.asarray(along_m, float) / self.length_m
        points = [start + share * (end - start) for start, end in zip(self.start, self.end)]
        return np.stack(points, axis=-1), np.full(share.shape, self.courses_rad[0])


@dataclass(frozen=True)
class Arc:
    """Part of a circle, m: counter-clockwise by sweep_rad from the direction start_rad as seen from its centre.

    A negative sweep turns clockwise.
    """

    centre: Point
    radius_m: float
    start_rad: float
    sweep_rad: float

    @property
    def length_m(self) -> float:
        """Length of the arc."""
        return self.radius_m * abs(self.sweep_rad)

    @property
    def courses_rad(self) -> tuple[float, float]:
        """Courses at its start and its end; they differ by sweep_rad."""
        start_rad = self.start_rad + math.copysign(0.5 * math.pi, self.sweep_rad)
        return start_rad, start_rad + self.sweep_rad

    def at(self, along_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points (n, 2) and courses (n,) at distances (n,) from the start, 0 to length_m."""
        swept_rad = np.copysign(np.asarray(along_m, float) / self.radius_m, self.sweep_rad)
        angle_rad = self.start_rad + swept_rad
        x_m = self.centre[0] + self.radius_m * np.cos(angle_rad)
        y_m = self.centre[1] + self.radius_m * np.sin(angle_rad)
        return np.stack([x_m, y_m], axis=-1), self.courses_rad[0] + swept_rad


Piece = Straight | Arc


def distance_m(a: Point, b: Point) -> float:
    """Distance between two points."""
    dx_m, dy_m = b[0] - a[0], b[1] - a[1]
    return math.sqrt(dx_m * dx_m + dy_m * dy_m)


def beside(point: Point, course_rad: float, ahead_m: float, left_m: float = 0.0) -> Point:
    """The point at the given distances ahead and to the left of a point with course_rad."""
    cos, sin = math.cos(course_rad), math.sin(course_rad)
    return point[0] + ahead_m * cos - left_m * sin, point[1] + ahead_m * sin + left_m * cos


def turn_rad(course_rad: float, to_rad: float) -> float:
    """The smallest turn from one course to another, positive to the left; half a turn goes to the left."""
    turn = math.remainder(to_rad - course_rad, 2.0 * math.pi)
    return turn + 2.0 * math.pi if turn < -math.pi + 1e-9 else turn  # rounding must not choose the side
