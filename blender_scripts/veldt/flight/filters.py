"""Linear filters of values a fixed step apart. No value depends on what comes after it, bit for bit."""

from __future__ import annotations

import math

import numpy as np

_BLOCK = 256  # moments worked through one by one, in all blocks at once


def states(kept: np.ndarray, added: np.ndarray) -> np.ndarray:
    """s[0] = added[0], s[k] = kept s[k-1] + added[k]: (m, n), as added, which has at least one moment; kept (m, m).

    Equal blocks start from nothing, all at once; then each gets what is left of the end of the last one. These are only
    sums and products of numbers, in an order that the number of moments does not change: the same bits anywhere.
    """
    moments = added.shape[1]
    block = min(_BLOCK, moments)
    blocks = -(-moments // block)
    padded = np.pad(added, ((0, 0), (0, blocks * block - moments)))
    state = np.ascontiguousarray(np.reshape(padded, (len(kept), blocks, block)).transpose(2, 0, 1))
    left = np.empty((block, *kept.shape))  # of the state before a block, at each of its moments
    left[0] = kept
    for k in range(1, block):
        state[k] += product(kept, state[k - 1])
        left[k] = product(kept, left[k - 1])
    before = _ends_before(left[-1].tolist(), state[-1].T.tolist())
    for column in range(len(kept)):
        state += left[:, :, column, None] * before[column]
    return state.transpose(1, 2, 0).reshape(len(kept), -1)[:, :moments]


def lag_error(values: np.ndarray, lag_s: float, step_s: float) -> np.ndarray:
    """values - lagged (n, ...) of a first-order lag, lagged' = (values - lagged) / lag_s; lag_s = 0 gives zeros.

    It starts settled on the first value, and is exact where values are linear from one moment to the next: the error
    e' = values' - e / lag_s then decays by a = exp(-step / lag) and gains (1 - a) lag / step of each difference.
    """
    if lag_s == 0:
        return np.zeros(values.shape)
    steps = step_s / lag_s
    gained = np.diff(values, axis=0, prepend=values[:1]) * (-math.expm1(-steps) / steps)
    kept = np.array([[math.exp(-steps)]])
    columns = [states(kept, column[None])[0] for column in gained.reshape(len(values), -1).T]
    return np.stack(columns, axis=-1).reshape(values.shape)


def product(matrix: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Matrix (m, m) times columns (m, n); a library's product rounds as it likes."""
    return sum(matrix[:, k, None] * columns[k] for k in range(len(matrix)))


def _ends_before(kept: list[list[float]], added: list[list[float]]) -> np.ndarray:
    """The state (m, blocks) before each block, from what a block leaves of it and what each block adds."""
    state, before = [0.0] * len(kept), []
    for gain in added:
        before.append(state)
        state = [sum(k * s for k, s in zip(row, state)) + g for row, g in zip(kept, gain)]
    return np.array(before).T
