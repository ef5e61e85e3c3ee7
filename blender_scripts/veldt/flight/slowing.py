"""Slows an aircraft down where the ground rises or falls faster than it can climb."""

from __future__ import annotations

import numpy as np

from .heights import moving_average

_USED = 0.9  # of the climb rate, by the planned rise; the rest is for what averages leave out
_SMOOTHED_S = 0.5  # of the rise that counts
_REACH_S = 1.0  # before and after a steep place at which it is already slow
_EASED_S = 2.0  # over which its pace changes


def slowed_times(wanted_m: np.ndarray, step_s: float, climb_m_s: float) -> np.ndarray:
    """At which moment (n,) of its plan an aircraft is that goes no faster than it can climb.

    wanted_m (n,): heights it shall have at moments step_s apart if it flies as planned, from 0. Its pace is the planned
    one, or less, so that the heights change by at most climb_m_s, but for steps shorter than half a second. What comes
    more than three seconds later changes nothing, bit for bit.
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
    """The largest of the values within so many moments, by doubling."""
    padded = np.pad(values, reach, mode="edge")
    width, done = 2 * reach + 1, 1
    while done < width:
        shift = min(done, width - done)
        padded = np.maximum(padded[:-shift], padded[shift:])
        done += shift
    return padded
