"""Headings and rotation matrices, one after the other. Axes: x forward, y left, z up."""

from __future__ import annotations

import numpy as np


def heading_of(angle_rad: np.ndarray) -> np.ndarray:
    """Horizontal unit vectors (..., 2) at angles (...), counter-clockwise from x."""
    return np.stack([np.cos(angle_rad), np.sin(angle_rad)], axis=-1)


def any_heading(rng: np.random.Generator) -> np.ndarray:
    """A horizontal unit vector (2,) in any direction."""
    return heading_of(2.0 * np.pi * rng.uniform())


def left_of(heading: np.ndarray) -> np.ndarray:
    """Horizontal vectors (..., 2) perpendicular to headings (..., 2), to their left and of the same length."""
    return np.stack([-heading[..., 1], heading[..., 0]], axis=-1)


def by_vector(vectors_rad: np.ndarray) -> np.ndarray:
    """Rotations (..., 3, 3) about vectors (..., 3) by their lengths, right-handed (Rodrigues)."""
    angle = np.linalg.norm(vectors_rad, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(vectors_rad, -1, 0)
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(vectors_rad.shape + (3,))
    # sin(a)/a and (1 - cos(a))/a^2, which are smooth at 0.
    half = np.sinc(angle / (2.0 * np.pi))
    return np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * half * half * (cross @ cross)
