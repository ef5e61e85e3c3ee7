"""Arrays of rotation matrices. Axes: x forward, y left, z up."""

from __future__ import annotations

import numpy as np


def about(axis: str, angle_rad) -> np.ndarray:
    """Rotations (..., 3, 3) about an axis, `x`, `y` or `z`, right-handed."""
    angle_rad = np.asarray(angle_rad, float)
    first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    turn = np.zeros(angle_rad.shape + (3, 3))
    turn[...] = np.eye(3)
    turn[..., first, first] = turn[..., second, second] = np.cos(angle_rad)
    turn[..., second, first] = np.sin(angle_rad)
    turn[..., first, second] = -turn[..., second, first]
    return turn


def turned(angles_rad: np.ndarray) -> np.ndarray:
    """Rotations (..., 3, 3) by angles (..., 3): about x first, then y, then z."""
    return about("z", angles_rad[..., 2]) @ about("y", angles_rad[..., 1]) @ about("x", angles_rad[..., 0])


def heading_of(angle_rad: np.ndarray) -> np.ndarray:
    """Horizontal unit vectors (..., 2) at angles (...), counter-clockwise from x."""
    return np.stack([np.cos(angle_rad), np.sin(angle_rad)], axis=-1)


def left_of(heading: np.ndarray) -> np.ndarray:
    """Horizontal vectors (..., 2) perpendicular to headings (..., 2), to their left and of the same length."""
    return np.stack([-heading[..., 1], heading[..., 0]], axis=-1)


def facing(heading: np.ndarray) -> np.ndarray:
    """Rotations (..., 3, 3) about z that turn x to unit headings (..., 2)."""
    turn = np.zeros(heading.shape[:-1] + (3, 3))
    turn[..., 0, 0] = turn[..., 1, 1] = heading[..., 0]
    turn[..., 1, 0] = heading[..., 1]
    turn[..., 0, 1] = -heading[..., 1]
    turn[..., 2, 2] = 1.0
    return turn


def frame(along: np.ndarray, hinge: np.ndarray) -> np.ndarray:
    """Rotations (..., 3, 3) whose columns are a unit vector, a perpendicular unit vector, and their cross product."""
    return np.stack([along, hinge, np.cross(along, hinge)], axis=-1)


def unit(vectors: np.ndarray) -> np.ndarray:
    """Unit vectors (..., 3) in the same directions; zero vectors stay zero."""
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)


def applied(rotation: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Vectors (..., 3), each rotated by its rotation (..., 3, 3)."""
    return (rotation @ np.asarray(vectors, float)[..., None])[..., 0]


def by_vector(vectors_rad: np.ndarray) -> np.ndarray:
    """Rotations (..., 3, 3) about vectors (..., 3) by their lengths, right-handed (Rodrigues)."""
    angle = np.linalg.norm(vectors_rad, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(vectors_rad, -1, 0)
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(vectors_rad.shape + (3,))
    # sin(a)/a and (1 - cos(a))/a^2, which are smooth at 0.
    half = np.sinc(angle / (2.0 * np.pi))
    return np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * half * half * (cross @ cross)
