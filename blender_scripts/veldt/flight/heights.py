"""The heights an aircraft flies that can climb and sink only so fast."""

from __future__ import annotations

import numpy as np

_AVERAGED_S = 2.0  # estimate: how long it takes to go from sinking to climbing


def look_ahead_s(relief_m: float, climb_m_s: float) -> float:
    """How long before a moment its wanted height can matter to `follow_heights`, if wanted heights span relief_m."""
    return relief_m / climb_m_s + 0.5 * _AVERAGED_S


def follow_heights(wanted_m: np.ndarray, step_s: float, climb_m_s: float) -> np.ndarray:
    """Heights (n,) near wanted_m (n,), step_s apart, that climb and sink at most climb_m_s and change that gently.

    `nearest_heights`, averaged over 2 s: vertical acceleration is at most climb_m_s each second, and heights are at
    most climb_m_s times 0.5 s from the nearest. The first and the last height go on before and after. Values further
    on than `look_ahead_s` change no bit of a height.
    """
    first_m = wanted_m[:1]  # taken off so that level flight is level to the bit
    nearest_m = nearest_heights(wanted_m - first_m, step_s, climb_m_s)
    return first_m + moving_average(nearest_m, int(0.5 * _AVERAGED_S / step_s + 0.5))


def nearest_heights(wanted_m: np.ndarray, step_s: float, climb_m_s: float) -> np.ndarray:
    """Of all heights (n,) that change at most climb_m_s, those whose largest deviation from wanted_m is least.

    They are m, midway between U(t) = max over s of w(s) - c|t - s| and L(t) = min over s of w(s) + c|t - s|, the
    extensions of E. J. McShane, "Extension of range of functions", Bulletin of the American Mathematical Society 40
    (1934). U and L change at most by c, so m does too; and as U >= w >= L, |m - w| <= (U - L) / 2. If some g changes at
    most by c and is within d of w, then g(t) >= g(s) - c|t - s| >= w(s) - d - c|t - s| for all s, so g >= U - d;
    likewise g <= L + d. So d >= (U - L) / 2 everywhere: no g does better than m.
    """
    ramp_m = climb_m_s * step_s * np.arange(len(wanted_m))
    return 0.5 * (_upper(wanted_m, ramp_m) - _upper(-wanted_m, ramp_m))


def _upper(wanted_m: np.ndarray, ramp_m: np.ndarray) -> np.ndarray:
    forth = np.maximum.accumulate(wanted_m + ramp_m) - ramp_m
    back = np.maximum.accumulate((wanted_m - ramp_m)[::-1])[::-1] + ramp_m
    return np.maximum(forth, back)


def moving_average(values: np.ndarray, reach: int) -> np.ndarray:
    """Means (n,) of `reach` values before and after each and of itself; the first and last value go on for ever.

    In blocks as long as a window, each window is the end of one and the beginning of the next: sums within blocks do
    not drift, however many there are (M. van Herk, Pattern Recognition Letters 13 (1992), for maxima).
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
