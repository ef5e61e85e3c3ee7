"""Search for pairs of nearby points in the plane."""

from __future__ import annotations

import numpy as np

_ROW_BITS = np.int64(32)


class Neighbours:
    """Points (l, 2) sorted into squares of side radius_m, so that only nine squares are searched for those near another
    one; three in a column follow each other.
    """

    def __init__(self, points_m: np.ndarray, radius_m: float):
        self._x_m, self._y_m = points_m.T
        self._radius_m = radius_m
        keys = _key(self._x_m, self._y_m, radius_m) if len(points_m) else np.zeros(0, np.int64)
        self._order = np.argsort(keys, kind="stable")
        self._keys = keys[self._order]

    def pairs(self, points_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Indices (i, j), each (n,), of all pairs of points_m[i], (k, 2), and one of these points, j, less than
        radius_m apart. A point is near itself.
        """
        if len(points_m) == 0 or len(self._keys) == 0:
            return np.zeros(0, np.int64), np.zeros(0, np.int64)
        x_m, y_m = points_m.T
        middle = _key(x_m, y_m, self._radius_m)
        found = []
        for column in (-1, 0, 1):
            wanted = middle + (np.int64(column) << _ROW_BITS)
            first = np.searchsorted(self._keys, wanted - 1, "left")
            past = np.searchsorted(self._keys, wanted + 1, "right")
            i = np.repeat(np.arange(len(points_m)), past - first)
            starts = np.cumsum(past - first) - (past - first)
            j = self._order[np.arange(len(i)) + np.repeat(first - starts, past - first)]
            near = (x_m[i] - self._x_m[j]) ** 2 + (y_m[i] - self._y_m[j]) ** 2 < self._radius_m**2
            found.append((i[near], j[near]))
        return np.concatenate([i for i, _ in found]), np.concatenate([j for _, j in found])


def pairs_within(a_m: np.ndarray, b_m: np.ndarray, radius_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Indices (i, j), each (n,), of all pairs of points a_m[i] (k, 2) and b_m[j] (l, 2) less than radius_m apart."""
    return Neighbours(b_m, radius_m).pairs(a_m)


def _key(x_m: np.ndarray, y_m: np.ndarray, side_m: float) -> np.ndarray:
    """One number for the square of each point, ascending by column; unique for fewer than 2^31 squares a side."""
    column, row = (np.floor(along / side_m).astype(np.int64) for along in (x_m, y_m))
    return (column << _ROW_BITS) + row
