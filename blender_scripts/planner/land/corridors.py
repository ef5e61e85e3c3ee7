"""Ground that is taken: walkers' paths, and the places of what stands still."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.neighbours import pairs_within


@dataclass(frozen=True)
class Corridor:
    """A line, points_m (n, 2) at most a metre apart, and how far to its sides the ground is taken."""

    points_m: np.ndarray
    half_width_m: float


class Corridors:
    """Several corridors, searched at once."""

    def __init__(self, corridors: Sequence[Corridor] = ()):
        self._points_m = np.concatenate([np.zeros((0, 2)), *(each.points_m for each in corridors)])
        counts = [len(each.points_m) for each in corridors]
        self._half_widths_m = np.repeat([float(each.half_width_m) for each in corridors], counts)

    def is_clear(self, points_m: np.ndarray, by_m: float) -> bool:
        """Whether all of a few points (n, 2) are at least by_m away from all corridors."""
        return not self._is_near(points_m[:, None], self._points_m, self._half_widths_m, by_m).any()

    def taken(self, points_m: np.ndarray, by_m: float) -> np.ndarray:
        """Mask of the points (n, 2) that are less than by_m away from a corridor."""
        taken = np.zeros(len(points_m), bool)
        i, j = pairs_within(points_m, self._points_m, by_m + self._half_widths_m.max(initial=0.0))
        taken[i[self._is_near(points_m[i], self._points_m[j], self._half_widths_m[j], by_m)]] = True
        return taken

    @staticmethod
    def _is_near(one_m: np.ndarray, other_m: np.ndarray, half_width_m: np.ndarray, by_m: float) -> np.ndarray:
        off_m = one_m - other_m
        return off_m[..., 0] ** 2 + off_m[..., 1] ** 2 < (by_m + half_width_m) ** 2
