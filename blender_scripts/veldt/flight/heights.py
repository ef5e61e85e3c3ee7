"""The heights flown by an aircraft with a limited climb rate."""

from __future__ import annotations

import numpy as np

_AVERAGED_S = 2.0  # estimate: time to change from sinking to climbing


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
