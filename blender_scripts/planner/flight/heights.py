"""The heights, and the pace, flown by an aircraft with a limited climb rate."""

from __future__ import annotations

import numpy as np

_AVERAGED_S = 2.0  # estimate: time to change from sinking to climbing

_USED = 0.9  # share of the climb rate for the planned rise; the rest allows for averaging
_SMOOTHED_S = 0.5  # before and after a steep section, during which it is already slow
_REACH_S = 1.0  # before and after a steep place, during which it is already slow
_EASED_S = 2.0  # over which its pace changes


def look_ahead_s(relief_m: float, climb_m_s: float) -> float:
    """How far ahead wanted heights, which span relief_m, can affect `follow_heights`."""
    return relief_m / climb_m_s + 0.5 * _AVERAGED_S


def follow_heights(wanted_m: np.ndarray, step_s: float, climb_m_s: float) -> np.ndarray:
    """Heights (n,) near wanted_m (n,), step_s apart, with a smooth climb rate of at most climb_m_s.

    `nearest_heights`, averaged over 2 s: vertical acceleration is at most climb_m_s per second, and heights are at
    most climb_m_s times 0.5 s from the nearest ones. The first and last heights extend before and after. Values more
    than `look_ahead_s` ahead do not change any bit of a height.
    """
    first_m = wanted_m[:1]  # subtracted so that level flight is exactly level
    nearest_m = nearest_heights(wanted_m - first_m, step_s, climb_m_s)
    return first_m + moving_average(nearest_m, int(0.5 * _AVERAGED_S / step_s + 0.5))


def nearest_heights(wanted_m: np.ndarray, step_s: float, climb_m_s: float) -> np.ndarray:
    """The heights (n,) with climb rates of at most climb_m_s whose largest deviation from wanted_m is smallest.

    They are m, midway between U(t) = max over s of w(s) - c|t - s| and L(t) = min over s of w(s) + c|t - s|, the
    extensions of E. J. McShane, "Extension of range of functions", Bulletin of the American Mathematical Society 40
    (1934). U and L have rates of at most c, hence so does m; since U >= w >= L, |m - w| <= (U - L) / 2. If g has rates
    of at most c and is within d of w, then g(t) >= g(s) - c|t - s| >= w(s) - d - c|t - s| for all s, so g >= U - d;
    likewise g <= L + d. Hence d >= (U - L) / 2 everywhere, and no g is better than m.
    """
    ramp_m = climb_m_s * step_s * np.arange(len(wanted_m))
    return 0.5 * (_upper(wanted_m, ramp_m) - _upper(-wanted_m, ramp_m))


def _upper(wanted_m: np.ndarray, ramp_m: np.ndarray) -> np.ndarray:
    forth = np.maximum.accumulate(wanted_m + ramp_m) - ramp_m
    back = np.maximum.accumulate((wanted_m - ramp_m)[::-1])[::-1] + ramp_m
    return np.maximum(forth, back)


def moving_average(values: np.ndarray, reach: int) -> np.ndarray:
    """Means (n,) over each value and the `reach` values before and after it; ends are extended by their last value.

    With blocks as long as a window, each window is the end of one block and the start of the next: sums within blocks
    do not drift, however many there are (M. van Herk, Pattern Recognition Letters 13 (1992), for maxima).
    """
    window = 2 * reach + 1
    blocks = -(-(len(values) + 2 * reach) // window)
    after = blocks * window - len(values) - reach
    padded = np.pad(values, (reach, after), mode="edge").reshape(blocks, window)
    begun = np.cumsum(padded, axis=1).ravel()
    left = np.cumsum(padded[:, ::-1], axis=1)[:, ::-1].ravel()
    is_block = np.arange(len(values)) % window == 0
    sums = np.where(is_block, 0.0, left[: len(values)]) + begun[window - 1 :][: len(values)]
    return sums / window


def slowed_times(wanted_m: np.ndarray, step_s: float, climb_m_s: float) -> np.ndarray:
    """The moment (n,) of its plan that an aircraft has reached if it slows down to its climb rate.

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
