"""Leaves as separate facets with gaps between them: sprays of small leaves, and blades of grass. Lengths in m."""

from __future__ import annotations

import numpy as np

from ..geometry.shapes import Mesh, facets
from .branch_shapes import directions

_SPRAY_CORNERS = 3


def clumped_sprays(
    clumps_m: np.ndarray, reach_m: np.ndarray, count: int, leaf_m: float, rng: np.random.Generator
) -> Mesh:
    """`count` sprays, each of radius about leaf_m, scattered in flattened balls with half axes reach_m (3,)."""
    clump = np.arange(count) % len(clumps_m)
    out = rng.uniform(0.2, 1.0, count)[:, None] ** 0.6
    centres = clumps_m[clump] + directions(rng, count) * out * reach_m
    centres[:, 2] = np.maximum(centres[:, 2], leaf_m)
    skyward = directions(rng, count) * 0.8 + np.array([0.0, 0.0, 1.0])
    return _sprays(centres, skyward, leaf_m * rng.uniform(0.6, 1.4, count), rng)


def blades(roots_m: np.ndarray, tips_m: np.ndarray, widths_m: np.ndarray, rng: np.random.Generator) -> Mesh:
    """Grass: from each root (n, 3), a pointed strip that rises steeply and bends over at its tip."""
    knee = roots_m + (tips_m - roots_m) * [0.45, 0.45, 0.78]
    across = directions(rng, len(roots_m)) * [1.0, 1.0, 0.0]
    across *= (0.5 * widths_m / np.maximum(np.linalg.norm(across, axis=1), 1e-9))[:, None]
    corners = np.stack([roots_m - across, roots_m + across, knee + across, knee - across, tips_m], axis=1)
    strip = np.array([[0, 1, 2], [0, 2, 3], [3, 2, 4]])
    triangles = strip + 5 * np.arange(len(roots_m))[:, None, None]
    return facets(corners.reshape(-1, 3), triangles.reshape(-1, 3))


def _sprays(centres: np.ndarray, normals: np.ndarray, radii_m: np.ndarray, rng: np.random.Generator) -> Mesh:
    """Irregular flat polygons as triangle fans."""
    count, corners = len(centres), _SPRAY_CORNERS
    normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    u = np.cross(normals, directions(rng, count))
    u /= np.maximum(np.linalg.norm(u, axis=1, keepdims=True), 1e-9)
    v = np.cross(normals, u)
    angle = 2.0 * np.pi * (np.arange(corners) + rng.uniform(-0.3, 0.3, (count, corners))) / corners
    reach = radii_m[:, None] * rng.uniform(0.55, 1.2, (count, corners))
    rim = (reach * np.cos(angle))[..., None] * u[:, None] + (reach * np.sin(angle))[..., None] * v[:, None]
    fan = np.array([[0, k, k + 1] for k in range(1, corners - 1)])
    triangles = fan[None] + corners * np.arange(count)[:, None, None]
    return facets((centres[:, None] + rim).reshape(-1, 3), triangles.reshape(-1, 3))
