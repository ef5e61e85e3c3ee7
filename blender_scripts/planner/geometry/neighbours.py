"""Search for pairs of nearby points in the plane."""

from __future__ import annotations

import numpy as np

_ROW_BITS = np.int64(32)


def pairs_within(a_m: np.ndarray, b_m: np.ndarray, radius_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Indices (i, j), each (n,), of all pairs of points a_m[i] and b_m[j] less than radius_m apart.

    a_m (k, 2), b_m (l, 2). A point is near itself. The points are sorted into squares of side radius_m, so that only
    nine squares are searched for each; three in a column follow each other.
    """
    if len(a_m) == 0 or len(b_m) == 0:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    (ax_m, ay_m), (bx_m, by_m) = a_m.T, b_m.T
    keys = _key(bx_m, by_m, radius_m)
    order = np.argsort(keys, kind="stable")
    keys = keys[order]
    middle = _key(ax_m, ay_m, radius_m)
    found = []
    for column in (-1, 0, 1):
        wanted = middle + (np.int64(column) << _ROW_BITS)
        first, past = np.searchsorted(keys, wanted - 1, "left"), np.searchsorted(keys, wanted + 1, "right")
        i = np.repeat(np.arange(len(a_m)), past - first)
        starts = np.cumsum(past - first) - (past - first)
        j = order[np.arange(len(i)) + np.repeat(first - starts, past - first)]
        near = (ax_m[i] - bx_m[j]) ** 2 + (ay_m[i] - by_m[j]) ** 2 < radius_m**2
        found.append((i[near], j[near]))
    return np.concatenate([i for i, _ in found]), np.concatenate([j for _, j in found])


def _key(x_m: np.ndarray, y_m: np.ndarray, side_m: float) -> np.ndarray:
    """One number for the square of each point, ascending by column; unique for fewer than 2^31 squares a side."""
    column, row = (np.floor(along / side_m).astype(np.int64) for along in (x_m, y_m))
    return (column << _ROW_BITS) + row
