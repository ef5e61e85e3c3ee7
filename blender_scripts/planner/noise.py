"""Random values that depend only on a seed, a name and a position.

Uses only integer mixing and +, -, * on doubles, never a library's cos or exp: these round identically on every
machine, so a scene is bit-identical everywhere.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable

import numpy as np

_MASK = (1 << 64) - 1
_AT_ONCE = 1 << 14  # positions whose intermediate values fit the cache


def stream(seed: int, subsystem: str, *entity: int) -> np.random.Generator:
    """The random generator of one entity of one subsystem, independent of all others."""
    key = [seed, zlib.crc32(subsystem.encode()), *entity]
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(key)))


def lattice_hash(seed: int, name: str, ix: np.ndarray, iy: np.ndarray) -> np.ndarray:
    """64 well-mixed bits for each lattice point (ix, iy), integers of any sign; uint64, with the shape of ix and iy.

    The mixer is the finaliser of SplitMix64 (Steele, Lea & Flood 2014), applied once per coordinate.
    """
    key = np.uint64((seed << 32 | zlib.crc32(name.encode())) & _MASK)
    with np.errstate(over="ignore"):  # NumPy warns about overflow of scalars, but not of arrays
        bits = _mix(np.asarray(ix, np.int64).astype(np.uint64) ^ key)
        return _mix(bits + np.asarray(iy, np.int64).astype(np.uint64) * np.uint64(0x9E3779B97F4A7C15))


def lattice_uniform(seed: int, name: str, ix: np.ndarray, iy: np.ndarray) -> np.ndarray:
    """A uniform value in [0, 1) for each lattice point."""
    return (lattice_hash(seed, name, ix, iy) >> np.uint64(11)) * 2.0**-53


def gradient_noise(seed: int, name: str, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Smooth noise with lattice period 1: zero at lattice points, mean 0, within [-1, 1], C2 (Perlin 2002).

    Gradients fill the square [-1, 1]^2 instead of the unit circle, which avoids cosines.
    """
    x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
    ix, iy = np.floor(x), np.floor(y)
    u, v = x - ix, y - iy
    gradients = _gradients(seed, name, ix, iy)
    corners = [[_slope(gradients(i, j), u - i, v - j) for i in (0, 1)] for j in (0, 1)]
    a, b = _fade(u), _fade(v)
    low = corners[0][0] + a * (corners[0][1] - corners[0][0])
    high = corners[1][0] + a * (corners[1][1] - corners[1][0])
    return low + b * (high - low)


def fractal_noise(
    seed: int,
    name: str,
    x_m: np.ndarray,
    y_m: np.ndarray,
    wavelength_m: float,
    octaves: int,
    gain: float = 0.5,
) -> np.ndarray:
    """Octaves of gradient noise: octave k has wavelength_m / 2^k and amplitude gain^k. Mean 0, about [-1, 1].

    Each octave is rotated (by the angle of a 3-4-5 triangle) and shifted against the previous one to hide the lattices.
    """
    x_m, y_m = np.broadcast_arrays(np.asarray(x_m, float), np.asarray(y_m, float))
    total = np.zeros(x_m.shape)
    flat, x_m, y_m = total.reshape(-1), x_m.reshape(-1), y_m.reshape(-1)
    for begin in range(0, len(flat), _AT_ONCE):
        part = slice(begin, begin + _AT_ONCE)
        x, y = x_m[part] / wavelength_m, y_m[part] / wavelength_m
        for k in range(octaves):
            flat[part] += gain**k * gradient_noise(seed, f"{name}/{k}", x, y)
            x, y = 2.0 * (0.8 * x - 0.6 * y) + 0.37, 2.0 * (0.6 * x + 0.8 * y) + 0.71
    return total


def _mix(bits: np.ndarray) -> np.ndarray:
    bits = (bits ^ (bits >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    bits = (bits ^ (bits >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return bits ^ (bits >> np.uint64(31))


def _gradients(seed: int, name: str, ix: np.ndarray, iy: np.ndarray) -> Callable:
    """A function of (i, j): the gradients drawn at lattice points (ix + i, iy + j), i and j 0 or 1.

    If many positions share lattice points, each point is drawn once and looked up: the same bits, faster.
    """
    if ix.size == 0:
        return lambda i, j: _gradient(seed, name, ix, iy)
    x0, y0 = ix.min(), iy.min()
    wide, high = int(ix.max() - x0) + 2, int(iy.max() - y0) + 2
    if wide * high > ix.size:
        return lambda i, j: _gradient(seed, name, ix + i, iy + j)
    table = _gradient(seed, name, x0 + np.arange(wide), y0 + np.arange(high)[:, None])
    place = (iy - y0).astype(np.int64) * wide + (ix - x0).astype(np.int64)
    return lambda i, j: tuple(part.ravel()[place + (j * wide + i)] for part in table)


def _gradient(seed: int, name: str, ix, iy) -> tuple[np.ndarray, np.ndarray]:
    bits = lattice_hash(seed, name, ix, iy)
    gx = (bits >> np.uint64(32)) * 2.0**-31 - 1.0
    gy = (bits & np.uint64(0xFFFFFFFF)) * 2.0**-31 - 1.0
    return gx, gy


def _slope(gradient: tuple[np.ndarray, np.ndarray], dx, dy) -> np.ndarray:
    """The plane that is zero at a lattice point and has the gradient drawn there."""
    gx, gy = gradient
    return gx * dx + gy * dy


def _fade(t: np.ndarray) -> np.ndarray:
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
