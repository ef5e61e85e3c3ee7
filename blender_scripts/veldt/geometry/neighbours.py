"""Search for pairs of nearby points in the plane."""

from __future__ import annotations

import numpy as np


def pairs_within(a_m: np.ndarray, b_m: np.ndarray, radius_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Indices (i, j), each (n,), of all pairs of points a_m[i] and b_m[j] less than radius_m apart.

    a_m (k, 2), b_m (l, 2). A point is near itself. The points are sorted into squares of side radius_m, so that only
    nine squares are searched for each.
    """
    cell_a, cell_b = (np.floor(points / radius_m).astype(np.int64) for points in (a_m, b_m))
    order = np.argsort(_key(cell_b), kind="stable")
    keys = _key(cell_b)[order]
    found = []
    for step in [(dx, dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]:
        wanted = _key(cell_a + np.array(step))
        first, past = np.searchsorted(keys, wanted, "left"), np.searchsorted(keys, wanted, "right")
        i = np.repeat(np.arange(len(a_m)), past - first)
        starts = np.cumsum(past - first) - (past - first)
        j = order[np.arange(len(i)) + np.repeat(first - starts, past - first)]
        near = ((a_m[i] - b_m[j]) ** 2).sum(axis=1) < radius_m**2
        found.append((i[near], j[near]))
    return np.concatenate([i for i, _ in found]), np.concatenate([j for _, j in found])


def _key(cell: np.ndarray) -> np.ndarray:
    """One number for each square, ascending row by row; unique for fewer than 2^31 squares per side."""
    return (cell[:, 0] << np.int64(32)) + cell[:, 1]
