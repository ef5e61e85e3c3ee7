"""The commands to an aircraft over time; courses of steps: pieces flown by a law of motion, and stays on the spot."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from .speed_profile import Law
from .path_segments import Piece, Point, turn_rad

_WHOLE_TURN = 2.0 * math.pi
_SPIN_RAD_S = math.radians(60.0)  # estimate: yaw rate of a multirotor on the spot


@dataclass(frozen=True)
class Ride:
    """The commands to an aircraft at n moments.

    point_m (n, 2); course_rad (n,): direction of its nose, counter-clockwise from +x, unwrapped; height_m (n,): above
    ground where is_agl (n,), else above the datum; None: the height of the flight plan.
    """

    point_m: np.ndarray
    course_rad: np.ndarray
    height_m: np.ndarray | None = None
    is_agl: np.ndarray | None = None


class Course(Protocol):
    """A flight path as a pure function of time: accepts times (n,) from 0 to duration_s in any order."""

    duration_s: float  # infinite if it repeats

    def at(self, time_s: np.ndarray) -> Ride:
        """The commands at the given times."""


@dataclass(frozen=True)
class Climb:
    """Heights in m at a step's start and end, linear in between; above ground, or else above the datum."""

    start_m: float
    end_m: float
    is_agl: bool


@dataclass(frozen=True)
class Leg:
    """A flight along a piece; the nose points along it, or always to nose_rad."""

    piece: Piece
    law: Law
    nose_rad: float | None = None
    climb: Climb | None = None

    @property
    def duration_s(self) -> float:
        """Duration of the step."""
        return self.law.duration_s

    @property
    def courses_rad(self) -> tuple[float, float]:
        """Direction of the nose at its start and its end."""
        return self.piece.courses_rad if self.nose_rad is None else (self.nose_rad, self.nose_rad)

    def at(self, time_s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Points (n, 2), directions of the nose (n,) and fractions (n,) of the length, at times since its start."""
        along_m = self.law.along_m(time_s)
        point_m, course_rad = self.piece.at(along_m)
        if self.nose_rad is not None:
            course_rad = np.full(course_rad.shape, self.nose_rad)
        return point_m, course_rad, along_m / self.law.length_m


@dataclass(frozen=True)
class Stay:
    """Hovering over a point while the nose turns evenly from nose_rad by turn_rad."""

    point_m: Point
    duration_s: float
    nose_rad: float
    turn_rad: float = 0.0
    climb: Climb | None = None

    @property
    def courses_rad(self) -> tuple[float, float]:
        """Direction of the nose at its start and its end."""
        return self.nose_rad, self.nose_rad + self.turn_rad

    def at(self, time_s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """As `Leg.at`; the fraction is that of its duration."""
        share = np.asarray(time_s, float) / self.duration_s
        point_m = np.stack([np.full(share.shape, value) for value in self.point_m], axis=-1)
        return point_m, self.nose_rad + share * self.turn_rad, share


Step = Leg | Stay


def spin(point_m: Point, nose_rad: float, to_rad: float, climb: Climb | None = None) -> list[Step]:
    """A turn on the spot by the smaller angle; no step if the nose already points there."""
    turn = turn_rad(nose_rad, to_rad)
    return [Stay(point_m, abs(turn) / _SPIN_RAD_S, nose_rad, turn, climb)] if abs(turn) > 1e-9 else []


class Timetable:
    """A Course of steps, each of which starts in the state in which the last one ended.

    With `repeats`, the first step follows the last one without end; otherwise the course stays at its end. The nose
    directions of each step, and of each round, are shifted by whole turns so that they are continuous. Either all steps
    have a climb, or none has.
    """

    def __init__(self, steps: Sequence[Step], repeats: bool):
        ends_s = np.cumsum([step.duration_s for step in steps])
        self._steps, self._repeats = tuple(steps), repeats
        self._round_s = float(ends_s[-1])
        self._starts_s = np.concatenate([[0.0], ends_s[:-1]])
        self._whole_rad, self._round_rad = _whole_turns(steps)

    @property
    def duration_s(self) -> float:
        """Duration of all steps; infinite with `repeats`."""
        return math.inf if self._repeats else self._round_s

    def at(self, time_s: np.ndarray) -> Ride:
        """The commands at any times (n,) >= 0."""
        rounds, local_s = self._local(np.asarray(time_s, float))
        number = np.searchsorted(self._starts_s, local_s, side="right") - 1
        point_m, course_rad, share = np.empty((len(number), 2)), np.empty(len(number)), np.empty(len(number))
        for k, here in _grouped(number):
            since_s = np.minimum(local_s[here] - self._starts_s[k], self._steps[k].duration_s)
            point_m[here], course_rad[here], share[here] = self._steps[k].at(since_s)
        course_rad += self._whole_rad[number] + rounds * self._round_rad
        return Ride(point_m, course_rad, *self._heights(number, share))

    def _local(self, time_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The number of completed rounds, and the times within a round."""
        if self._repeats:
            return np.divmod(time_s, self._round_s)
        return np.zeros(len(time_s)), time_s

    def _heights(self, number: np.ndarray, share: np.ndarray) -> tuple[np.ndarray | None, np.ndarray | None]:
        if self._steps[0].climb is None:
            return None, None
        used, which = np.unique(number, return_inverse=True)
        climbs = [self._steps[k].climb for k in used]
        start_m, end_m = (np.array([getattr(c, end) for c in climbs])[which] for end in ("start_m", "end_m"))
        return start_m + share * (end_m - start_m), np.array([c.is_agl for c in climbs], bool)[which]


def _whole_turns(steps: Sequence[Step]) -> tuple[np.ndarray, float]:
    """The shift in rad, a multiple of 2 pi, of each step's nose directions, and that of the next round."""
    turns, last_rad = [], steps[0].courses_rad[0]
    for step in steps:
        first_rad, end_rad = step.courses_rad
        turns.append(round((last_rad - first_rad) / _WHOLE_TURN) * _WHOLE_TURN)
        last_rad = turns[-1] + end_rad
    return np.array(turns), round((last_rad - steps[0].courses_rad[0]) / _WHOLE_TURN) * _WHOLE_TURN


def _grouped(number: np.ndarray):
    """Each distinct number with the indices at which it occurs."""
    order = np.argsort(number, kind="stable")
    there, first = np.unique(number[order], return_index=True)
    return zip(there, np.split(order, first[1:]))
