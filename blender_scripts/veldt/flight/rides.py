"""What an aircraft is asked to do, as a function of time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np


@dataclass(frozen=True)
class Ride:
    """An aircraft's orders at n moments.

    point_m (n, 2); course_rad (n,): where its nose points, counter-clockwise from +x, without jumps of a whole turn;
    height_m (n,): above ground where is_agl (n,), else above the datum; None: as the flight plan says.
    """

    point_m: np.ndarray
    course_rad: np.ndarray
    height_m: np.ndarray | None = None
    is_agl: np.ndarray | None = None


class Course(Protocol):
    """A way through the air; pure: any times (n,) from 0 to duration_s, in any order."""

    duration_s: float  # infinite if it goes on for ever

    def at(self, time_s: np.ndarray) -> Ride:
        """The orders at some times."""
