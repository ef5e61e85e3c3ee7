"""Laws of motion along a path: distance from the start as a function of time, 0 to duration_s."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Steady:
    """Constant speed."""

    length_m: float
    speed_m_s: float

    @property
    def duration_s(self) -> float:
        """Duration of the motion."""
        return self.length_m / self.speed_m_s

    def along_m(self, time_s: np.ndarray) -> np.ndarray:
        """Distances (n,) from the start."""
        return self.speed_m_s * np.asarray(time_s, float)


@dataclass(frozen=True)
class StopToStop:
    """From rest to rest: acceleration to at most speed_m_s, and braking at the same rate."""

    length_m: float
    speed_m_s: float
    acceleration_m_s2: float

    @property
    def peak_m_s(self) -> float:
        """Highest speed; below speed_m_s on a path too short to reach it."""
        return min(self.speed_m_s, math.sqrt(self.acceleration_m_s2 * self.length_m))

    @property
    def duration_s(self) -> float:
        """Duration: that at peak speed, plus half of the time spent accelerating and braking."""
        return self.length_m / self.peak_m_s + self.peak_m_s / self.acceleration_m_s2

    def along_m(self, time_s: np.ndarray) -> np.ndarray:
        """Distances (n,) from the start."""
        time_s, duration_s = np.asarray(time_s, float), self.duration_s
        is_early = time_s < 0.5 * duration_s
        gained_m = self._from_rest_m(np.where(is_early, time_s, duration_s - time_s))
        return np.where(is_early, gained_m, self.length_m - gained_m)

    def _from_rest_m(self, time_s: np.ndarray) -> np.ndarray:
        """Distances while accelerating and then flying at peak speed."""
        ramp_s = np.minimum(time_s, self.peak_m_s / self.acceleration_m_s2)
        return 0.5 * self.acceleration_m_s2 * ramp_s * ramp_s + self.peak_m_s * (time_s - ramp_s)


Law = Steady | StopToStop
