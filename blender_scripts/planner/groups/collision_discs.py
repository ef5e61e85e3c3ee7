"""Distances between groups over time, with bodies approximated by discs on the ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..geometry.components import length

HORIZON_S = 1800.0  # the duration of a flight of the published system
_STEP_S = 0.5
TIMES_S = np.arange(0.0, HORIZON_S + _STEP_S, _STEP_S)


@dataclass(frozen=True)
class Discs:
    """Discs that together cover a body seen from above: offsets ahead_m (k,) along its heading, and one radius."""

    ahead_m: np.ndarray
    radius_m: float


@dataclass(frozen=True)
class Crowd:
    """Discs of a group's members at TIMES_S, or constant in time: centre_m (t or 1, k, 2), radius_m (k,).

    fastest_m_s is the largest speed of a disc.
    """

    centre_m: np.ndarray
    radius_m: np.ndarray
    fastest_m_s: float

    @cached_property
    def ring_m(self) -> tuple[np.ndarray, np.ndarray]:
        """A disc, centre (t, 2) and radius (t,), around all discs of the crowd."""
        middle = self.centre_m.mean(axis=1)
        reach = (_length_m(self.centre_m - middle[:, None]) + self.radius_m).max(axis=1)
        return middle, reach


def cover(half_length_m: float, half_width_m: float) -> Discs:
    """The smallest row of discs that covers a rectangle without being much wider than it."""
    count = max(1, int(np.ceil(half_length_m / half_width_m - 0.2)))
    step_m = 2.0 * half_length_m / count
    ahead_m = step_m * (np.arange(count) - 0.5 * (count - 1))
    return Discs(ahead_m, float(np.hypot(0.5 * step_m, half_width_m)))


def centres(discs: Discs, point_m: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """Centres (t, k, 2) of the discs of a body at points (t, 2) with headings (t, 2)."""
    return point_m[:, None, :] + discs.ahead_m[:, None] * heading[:, None, :]


def gather(bodies: Sequence[tuple[Discs, np.ndarray, np.ndarray]]) -> Crowd:
    """The crowd of bodies, each with points (t, 2) and headings (t, 2) at TIMES_S; t is 1 if none of them moves."""
    centre_m = np.concatenate([centres(*body) for body in bodies], axis=1)
    steps_m = _length_m(np.diff(centre_m, axis=0))
    return Crowd(
        centre_m,
        np.concatenate([np.full(len(discs.ahead_m), discs.radius_m) for discs, _, _ in bodies]),
        float(steps_m.max(initial=0.0)) / _STEP_S,
    )


def nearest_m(one: Crowd, other: Crowd, enough_m: float = np.inf, until_s: float = HORIZON_S) -> float:
    """The smallest distance between the discs of two crowds, at most enough_m; negative where they overlap.

    Considers those of TIMES_S up to until_s.
    """
    least_m, most_m = (bound[: np.searchsorted(TIMES_S, until_s) + 1] for bound in _bounds_m(one, other))
    gaps_m = _gaps_m(one, other, np.flatnonzero(least_m <= min(enough_m, most_m.min())))
    return float(min(gaps_m.min(initial=np.inf), enough_m))


def clear_until_s(one: Crowd, other: Crowd, gap_m: float) -> float:
    """A lower bound, one of TIMES_S, for when two crowds come nearer than gap_m; HORIZON_S if they never do."""
    apart_m = gap_m + 0.5 * _STEP_S * (one.fastest_m_s + other.fastest_m_s)
    moments = np.flatnonzero(_bounds_m(one, other)[0] < apart_m)
    near = moments[_gaps_m(one, other, moments) < apart_m]
    return float(TIMES_S[near[0]]) if len(near) else HORIZON_S


def _gaps_m(one: Crowd, other: Crowd, moments: np.ndarray) -> np.ndarray:
    """Distances (n,) of the nearest two discs at moments (n,), given as indices into TIMES_S."""
    a, b = (crowd.centre_m[moments % len(crowd.centre_m)] for crowd in (one, other))
    gaps_m = _length_m(a[:, :, None] - b[:, None, :]) - one.radius_m[:, None] - other.radius_m
    return gaps_m.min(axis=(1, 2), initial=np.inf)


def _bounds_m(one: Crowd, other: Crowd) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper bounds (t,) of the distance between the nearest discs of two crowds."""
    (middle, reach), (others_middle, others_reach) = one.ring_m, other.ring_m
    between_m = _length_m(middle - others_middle)
    return between_m - reach - others_reach, between_m + reach + others_reach


def _length_m(offset_m: np.ndarray) -> np.ndarray:
    """Of offsets (..., 2): several times as fast as numpy.linalg.norm, to the same bits."""
    return length(np.moveaxis(offset_m, -1, 0))
