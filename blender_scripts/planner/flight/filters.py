"""Linear filters of equally spaced values. All are causal: no bit of a result depends on later values."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

_BLOCK = 64  # moments computed one by one, in all blocks at once


def states(kept: np.ndarray, added: np.ndarray) -> np.ndarray:
    """s[0] = added[0], s[k] = kept s[k-1] + added[k]; s and added (m, ..., n), n >= 1; kept (m, m).

    Blocks of equal size are computed from zero, all at once; then each receives the decayed final state of the one
    before it. Only sums and products are used, in an order that does not depend on n: the same bits on every machine.
    """
    size, moments = len(kept), added.shape[-1]
    series = added.reshape(size, -1, moments)
    block = min(_BLOCK, moments)
    blocks = -(-moments // block)
    padded = np.pad(series, ((0, 0), (0, 0), (0, blocks * block - moments)))
    state = np.ascontiguousarray(np.reshape(padded, (size, -1, block)).transpose(2, 0, 1))
    for k in range(1, block):
        state[k] += product(kept, state[k - 1])
    left = _powers(tuple(map(tuple, kept.tolist())), block)  # what is left of the state before a block
    ends = np.split(state[-1], series.shape[1], axis=1)
    before = np.hstack([_ends_before(left[-1].tolist(), end.T.tolist()) for end in ends])
    for column in range(size):
        state += left[:, :, column, None] * before[column]
    return state.transpose(1, 2, 0).reshape(*series.shape[:2], -1)[..., :moments].reshape(added.shape)


def lag_error(values: np.ndarray, lag_s: float, step_s: float) -> np.ndarray:
    """values - lagged (n, ...) of a first-order lag, lagged' = (values - lagged) / lag_s; lag_s = 0 gives zeros.

    It starts settled on the first value, and is exact for values that are linear between moments: the error
    e' = values' - e / lag_s then decays by a = exp(-step / lag) and gains (1 - a) lag / step of each difference.
    """
    changes = np.diff(values, axis=0, prepend=values[:1])
    if lag_s == 0 or not changes.any():
        return np.zeros(values.shape)
    steps = step_s / lag_s
    gained = changes * (-math.expm1(-steps) / steps)
    kept = np.array([[math.exp(-steps)]])
    return states(kept, gained.reshape(1, len(values), -1).transpose(0, 2, 1))[0].T.reshape(values.shape)


def product(matrix: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Matrix (m, m) times columns (m, n), summed in a fixed order; the rounding of a library's product may vary."""
    total = matrix[:, 0, None] * columns[0]
    for k in range(1, len(matrix)):
        total += matrix[:, k, None] * columns[k]
    return total


@lru_cache(maxsize=32)
def _powers(rows: tuple[tuple[float, ...], ...], count: int) -> np.ndarray:
    """The first to the count-th power (count, m, m) of a matrix, by its rows."""
    matrix = np.array(rows)
    powers = np.empty((count, *matrix.shape))
    powers[0] = matrix
    for k in range(1, count):
        powers[k] = product(matrix, powers[k - 1])
    return powers


def _ends_before(kept: list[list[float]], added: list[list[float]]) -> np.ndarray:
    """The state (m, blocks) before each block, from the decay over a block and what each block adds."""
    state, before = [0.0] * len(kept), []
    for gain in added:
        before.append(state)
        state = [sum(k * s for k, s in zip(row, state)) + g for row, g in zip(kept, gain)]
    return np.array(before).T
