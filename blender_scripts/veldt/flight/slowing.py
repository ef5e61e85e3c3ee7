"""Slow an aircraft down where the ground rises or falls faster than it can climb."""

from __future__ import annotations

import numpy as np

from .heights import moving_average

_USED = 0.9  # share of the climb rate for the planned rise; the rest covers what averaging leaves out
_SMOOTHED_S = 0.5  # of the rise that is considered
_REACH_S = 1.0  # before and after a steep place, during which it is already slow
_EASED_S = 2.0  # over which its pace changes


def slowed_times(wanted_m: np.ndarray, step_s: float, climb_m_s: float) -> np.ndarray:
    """The moment (n,) of its plan that an aircraft has reached if it flies no faster than it can climb.

    wanted_m (n,): wanted heights at moments step_s apart, from 0, if it flies as planned. Its pace is at most the
    planned one, such that the heights change by at most climb_m_s, apart from changes shorter than half a second. No
    bit of a result depends on heights more than three seconds later.
    """
    level_m = moving_average(wanted_m, round(0.5 * _SMOOTHED_S / step_s))
    rise_m_s = np.abs(np.diff(level_m, append=level_m[-1])) / step_s
    slower = np.maximum(1.0, rise_m_s / (_USED * climb_m_s))
    slower = moving_average(_widened(slower, round(_REACH_S / step_s)), round(0.5 * _EASED_S / step_s))
    slower = np.maximum(1.0, slower)
    planned_s = step_s * np.arange(len(wanted_m))
    flown_s = np.concatenate([[0.0], np.cumsum(slower[:-1]) * step_s])
    return np.interp(planned_s, flown_s, planned_s)


def _widened(values: np.ndarray, reach: int) -> np.ndarray:
    """The running maximum over the given number of moments, by doubling."""
    padded = np.pad(values, reach, mode="edge")
    width, done = 2 * reach + 1, 1
    while done < width:
        shift = min(done, width - done)
        padded = np.maximum(padded[:-shift], padded[shift:])
        done += shift
    return padded
