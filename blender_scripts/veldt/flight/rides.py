"""The commands to an aircraft as a function of time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np


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
