"""Leaves as separate facets with gaps between them: clusters of small leaves, and blades of grass. Lengths in m."""

from __future__ import annotations

import numpy as np

from ..geometry.shapes import Mesh, facets
from .branch_shapes import directions

_CLUSTER_CORNERS = 3
_TWIGS = 36  # of a clump
_BESIDE_TWIG = 3.0  # farthest centre of a cluster from its twig, in radii of a cluster
_LEAFINESS = 0.3, 1.7  # range over clumps; the barest show their branches


def leafy_twigs(
    clumps_m: np.ndarray, reach_m: np.ndarray, count: int, leaf_m: float, rng: np.random.Generator
) -> Mesh:
    """`count` clusters of leaves, each of radius about leaf_m, along twigs that are too thin to draw.

    Twigs start in the centre of each clump (n, 3) and end in an ellipsoid with half axes reach_m (3,). The clusters of
    a crown have the leaf area and the gaps of `heat.leaves` of its material.
    """
    twigs = len(clumps_m) * _TWIGS
    out_m = directions(rng, twigs) * rng.uniform(0.6, 1.1, (twigs, 1)) * reach_m
    leafy = np.cumsum(rng.uniform(*_LEAFINESS, len(clumps_m)))
    clump = np.searchsorted(leafy / leafy[-1], (np.arange(count) + 0.5) / count)
    along = rng.uniform(0.0, 1.0, (count, 1)) ** 0.5
    aside_m = directions(rng, count) * (_BESIDE_TWIG * leaf_m * rng.uniform(0.0, 1.0, (count, 1)))
    centres = clumps_m[clump] + along * out_m[clump * _TWIGS + np.arange(count) % _TWIGS] + aside_m
    centres[:, 2] = np.maximum(centres[:, 2], leaf_m)
    skyward = directions(rng, count) * 0.8 + np.array([0.0, 0.0, 1.0])
    return _clusters(centres, skyward, leaf_m * rng.uniform(0.7, 1.3, count), rng)


def blades(roots_m: np.ndarray, tips_m: np.ndarray, widths_m: np.ndarray, rng: np.random.Generator) -> Mesh:
    """Grass: from each root (n, 3), a pointed strip that rises steeply and bends over at its tip."""
    knee = roots_m + (tips_m - roots_m) * [0.45, 0.45, 0.78]
    across = directions(rng, len(roots_m)) * [1.0, 1.0, 0.0]
    across *= (0.5 * widths_m / np.maximum(np.linalg.norm(across, axis=1), 1e-9))[:, None]
    corners = np.stack([roots_m - across, roots_m + across, knee + across, knee - across, tips_m], axis=1)
    strip = np.array([[0, 1, 2], [0, 2, 3], [3, 2, 4]])
    triangles = strip + 5 * np.arange(len(roots_m))[:, None, None]
    return facets(corners.reshape(-1, 3), triangles.reshape(-1, 3))


def _clusters(
    centres: np.ndarray, normals: np.ndarray, radii_m: np.ndarray, rng: np.random.Generator
) -> Mesh:
    """Irregular flat polygons as triangle fans."""
    count, corners = len(centres), _CLUSTER_CORNERS
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
