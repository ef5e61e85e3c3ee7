"""Schedules of walking, standing and lowering heads, as functions of time.

The schedules of a group's members differ in a number or a phase alone. Both may be (n,), for n moments of several
members.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from ..geometry.easing import smooth
from ..noise import lattice_uniform

_BOUT_S = 24.0  # estimate: period of a grazer, from one patch of grass to the next
_WALKING = 0.12  # of a bout; estimate
_JITTER = 0.3  # of the distance per bout: largest lead or lag of a grazer against the herd's mean at the end of a bout
_PEAK = 1.5  # largest slope of `smooth`: peak speed of a grazer over its mean speed while walking
_RAISING_S = 1.5
_SIP_S = 32.0  # estimate: period of a drinker, from one look around to the next
_DRINKING = 0.7  # of that time


@dataclass(frozen=True)
class Doing:
    """The state of an actor at n moments: walked_m (n,) since time 0, pace (n,) and head_down (n,), both 0 to 1."""

    walked_m: np.ndarray
    pace: np.ndarray
    head_down: np.ndarray


@dataclass(frozen=True)
class Steady:
    """Walking at constant speed; 0 means standing."""

    speed_m_s: float

    reach_m = 0.0
    lowers_head = False

    @property
    def mean_m_s(self) -> float:
        """Speed over a long time."""
        return self.speed_m_s

    def at(self, time_s: np.ndarray) -> Doing:
        """The state at times (n,)."""
        walked_m = self.speed_m_s * np.asarray(time_s, float)
        return Doing(walked_m, np.full(len(walked_m), float(self.speed_m_s > 0)), np.zeros(len(walked_m)))


@dataclass(frozen=True)
class StopAndGo:
    """A grazer's schedule: in each bout it stands and feeds, then walks on at up to speed_m_s.

    All members of a herd have the same mean speed, so that it stays together; which member is ahead, and
    when, depends on the seed, the name and the member's number.
    """

    seed: int
    name: str
    number: int | np.ndarray
    speed_m_s: float

    lowers_head = True

    @property
    def mean_m_s(self) -> float:
        """Speed over a long time."""
        return _WALKING * self.speed_m_s

    @property
    def reach_m(self) -> float:
        """Largest lead or lag against a walker of constant mean speed."""
        return (1.0 + _JITTER) * self.mean_m_s * _BOUT_S

    def at(self, time_s: np.ndarray) -> Doing:
        """The state at times (n,)."""
        phase = self._draw("phase", np.zeros(1))
        bouts = np.asarray(time_s, float) / _BOUT_S + phase
        number = np.floor(bouts)
        begin, end = self._way_bouts(number), self._way_bouts(number + 1)
        lasts = _PEAK * _WALKING * (end - begin)
        starts = 0.3 + 0.4 * self._draw("start", number) - 0.5 * lasts
        done = (bouts - number - starts) / lasts
        raising = _RAISING_S / _BOUT_S / lasts  # as a fraction of the walk
        walked = begin + (end - begin) * smooth(done) - phase
        return Doing(
            walked_m=walked * self.mean_m_s * _BOUT_S,
            pace=_plateau(done, 0.0, 0.3),
            head_down=1.0 - _plateau(done, -raising, raising),
        )

    def _way_bouts(self, number: np.ndarray) -> np.ndarray:
        """Distance covered at the end of bouts, in distances of a mean bout."""
        return number + _JITTER * (2.0 * self._draw("way", number) - 1.0)

    def _draw(self, what: str, number: np.ndarray) -> np.ndarray:
        return lattice_uniform(self.seed, f"{self.name}/{what}", number, self.number)


@dataclass(frozen=True)
class Drinking:
    """A drinker's schedule: standing, it lowers its head to the water and raises it, delayed by `phase` (0 to 1)."""

    phase: float | np.ndarray

    reach_m = 0.0
    mean_m_s = 0.0
    lowers_head = True

    def at(self, time_s: np.ndarray) -> Doing:
        """The state at times (n,)."""
        turn = np.mod(np.asarray(time_s, float) / _SIP_S + self.phase, 1.0) / _DRINKING
        still = np.zeros(len(turn))
        return Doing(still, still, _plateau(turn, 0.0, _RAISING_S / _SIP_S))


Schedule = Steady | StopAndGo | Drinking


def together(schedules: Sequence[Schedule], of: np.ndarray) -> Schedule:
    """The schedule for n moments of several members of a group: schedules[of[k]] for the k-th; of (n,)."""
    first = schedules[0]
    own = [
        field.name
        for field in fields(first)
        if any(getattr(schedule, field.name) != getattr(first, field.name) for schedule in schedules)
    ]
    return replace(first, **{name: np.array([getattr(each, name) for each in schedules])[of] for name in own})


def _plateau(share: np.ndarray, start: float | np.ndarray, rise: float | np.ndarray) -> np.ndarray:
    """Rises from 0 at `start` to 1 over `rise`, and falls symmetrically to 0 at 1 - start."""
    return smooth((share - start) / rise) * smooth((1.0 - start - share) / rise)
