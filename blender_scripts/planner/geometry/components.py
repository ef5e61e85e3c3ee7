"""Vectors (3, ...) and rotations (3, 3, ...), many at once. Axes: x forward, y left, z up.

Components come first and moments last, so that NumPy works along moments and not along three numbers. Sums are written
out, in order: BLAS may change their order, and with it their last bits.
"""

from __future__ import annotations

import numpy as np


def about(axis: str, angle_rad) -> np.ndarray:
    """Rotations (3, 3, ...) about an axis, `x`, `y` or `z`, right-handed."""
    angle_rad = np.asarray(angle_rad, float)
    first, second, fixed = {"x": (1, 2, 0), "y": (2, 0, 1), "z": (0, 1, 2)}[axis]
    turn = np.zeros((3, 3) + angle_rad.shape)
    turn[fixed, fixed] = 1.0
    turn[first, first] = turn[second, second] = np.cos(angle_rad)
    turn[second, first] = np.sin(angle_rad)
    turn[first, second] = -turn[second, first]
    return turn


def turned(angles_rad: np.ndarray) -> np.ndarray:
    """Rotations (3, 3, ...) by angles (3, ...): about x first, then y, then z."""
    x, y, z = angles_rad
    return product(product(about("z", z), about("y", y)), about("x", x))


def facing(heading: np.ndarray) -> np.ndarray:
    """Rotations (3, 3, ...) about z that turn x to horizontal unit vectors (2, ...)."""
    turn = np.zeros((3, 3) + heading.shape[1:])
    turn[0, 0] = turn[1, 1] = heading[0]
    turn[1, 0] = heading[1]
    turn[0, 1] = -heading[1]
    turn[2, 2] = 1.0
    return turn


def frame(along: np.ndarray, hinge: np.ndarray) -> np.ndarray:
    """Rotations (3, 3, ...) whose columns are a unit vector, a perpendicular unit vector, and their cross product."""
    return np.stack([along, hinge, cross(along, hinge)], axis=1)


def product(last: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Rotations (3, 3, ...) that turn by `first` and then by `last`; their other axes are broadcast."""
    turn = last[:, 0, None] * first[None, 0]
    turn += last[:, 1, None] * first[None, 1]
    turn += last[:, 2, None] * first[None, 2]
    return turn


def applied(rotation: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Vectors (3, ...), each rotated by its rotation (3, 3, ...); their other axes are broadcast."""
    x, y, z = vectors
    return rotation[:, 0] * x + rotation[:, 1] * y + rotation[:, 2] * z


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross products (3, ...) of vectors (3, ...)."""
    return np.stack([a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2] for k in range(3)])


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Scalar products (...) of vectors (c, ...)."""
    return sum(p * q for p, q in zip(a, b))


def length(vectors: np.ndarray) -> np.ndarray:
    """Lengths (...) of vectors (c, ...)."""
    return np.sqrt(dot(vectors, vectors))


def unit(vectors: np.ndarray) -> np.ndarray:
    """Unit vectors (c, ...) in the directions of vectors; zero vectors stay zero."""
    return vectors / np.maximum(length(vectors), 1e-12)
