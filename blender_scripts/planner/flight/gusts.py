"""Dryden turbulence at low altitude: MIL-F-8785C (1980).

MIL-HDBK-1797 gives the same spectra, written with transverse scales half as long.
"""

from __future__ import annotations

import math
import zlib

import numpy as np

from ..noise import stream
from .filters import states

_M_PER_FT = 0.3048
_M_S_PER_KT = 1852.0 / 3600.0
_HEIGHTS_FT = (10.0, 1000.0)  # the model's range of heights; values outside are clamped to it

# Wind at 20 ft for each intensity of turbulence: the specification's 15, 30 and 45 kt.
WIND_M_S = {"none": 0.0, "light": 15 * _M_S_PER_KT, "moderate": 30 * _M_S_PER_KT, "severe": 45 * _M_S_PER_KT}


def gusts_m_s(
    seed: int, name: str, severity: str, height_m: float, airspeed_m_s: float, moments: int, step_s: float
) -> np.ndarray:
    """Gusts (moments, 3) forward, left and up, step_s apart, on an aircraft flying height_m above ground.

    They are exact samples of the stationary Dryden process from the first moment on. A longer series begins with the
    same values, bit for bit. airspeed_m_s must be above 0; `name` keys the random numbers.
    """
    rng = stream(seed, "turbulence", zlib.crc32(name.encode()))
    normal = rng.standard_normal((moments, 5)).T
    level_m_s, up_m_s = intensities_m_s(severity, height_m)
    level_m, up_m = scales_m(height_m)
    level, up = (airspeed_m_s * step_s / scale_m for scale_m in (level_m, up_m))
    nose, left = _longitudinal(normal[0], level), _transverse(normal[1:3], level)
    return np.stack([level_m_s * nose, level_m_s * left, up_m_s * _transverse(normal[3:], up)], axis=-1)


def intensities_m_s(severity: str, height_m: float) -> tuple[float, float]:
    """Standard deviations of horizontal and vertical gusts."""
    up_m_s = 0.1 * WIND_M_S[severity]
    return up_m_s / _nearness(height_m) ** 0.4, up_m_s


def scales_m(height_m: float) -> tuple[float, float]:
    """Length scales of horizontal and vertical gusts."""
    height_ft = _height_ft(height_m)
    return height_ft / _nearness(height_m) ** 1.2 * _M_PER_FT, height_ft * _M_PER_FT


def _nearness(height_m: float) -> float:
    return 0.177 + 0.000823 * _height_ft(height_m)


def _height_ft(height_m: float) -> float:
    lowest, highest = _HEIGHTS_FT
    return min(max(height_m / _M_PER_FT, lowest), highest)


def _longitudinal(normal: np.ndarray, step: float) -> np.ndarray:
    """White noise (n,) filtered by sqrt(2) / (1 + s): variance 1. `step` is in units of the time scale L/V."""
    added = math.sqrt(-math.expm1(-2.0 * step)) * normal
    added[:1] = normal[:1]
    return states(np.array([[math.exp(-step)]]), added[None])[0]


def _transverse(normal: np.ndarray, step: float) -> np.ndarray:
    """White noise, normal (2, n), filtered by (1 + sqrt(3) s) / (1 + s)^2: (n,), variance 1.

    It is sqrt(3) p + (1 - sqrt(3)) q, where p and q are the noise filtered by 1 / (1 + s) and 1 / (1 + s)^2. In one
    step p gains the integral of e^-r over the noise and q that of r e^-r, r from 0 to `step`, or to infinity at the
    first moment.
    """
    added = _correlated(normal, *(_gained(order, step) for order in (1, 2, 3)))
    added[:, :1] = _correlated(normal[:, :1], 0.5, 0.25, 0.25)
    p, q = states(math.exp(-step) * np.array([[1.0, 0.0], [step, 1.0]]), added)
    return math.sqrt(3.0) * p + (1.0 - math.sqrt(3.0)) * q


def _correlated(normal: np.ndarray, p_variance: float, covariance: float, q_variance: float) -> np.ndarray:
    """Pairs (2, n) with the given variances and covariance from pairs (2, n) of independent standard normal values."""
    slope = covariance / p_variance
    p = math.sqrt(p_variance) * normal[0]
    return np.stack([p, slope * p + math.sqrt(q_variance - slope * covariance) * normal[1]])


def _gained(order: int, step: float) -> float:
    """Integral of r^(order - 1) e^(-2r) for r from 0 to `step`, by a series of positive terms, for small steps."""
    term = step**order / order
    total, k = term, order
    while term > 1e-17 * total:
        k += 1
        term *= 2.0 * step / k
        total += term
    return total * math.exp(-2.0 * step)
