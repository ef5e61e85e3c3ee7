"""Wood: tapered limbs along curved lines, and forks. Lengths in m."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..geometry.shapes import Mesh, facets, joined

GOLDEN_ANGLE_RAD = 2.399963  # successive directions are never aligned


def limb(path_m: np.ndarray, radii_m: Sequence[float], sides: int, closed: bool = False) -> Mesh:
    """A tapered tube through the points (n, 3), n >= 2, of a line; its ends stay open unless closed."""
    path_m, radii_m = np.asarray(path_m, float), np.asarray(radii_m, float)
    u, v = _ring_axes(path_m)
    angle = 2.0 * np.pi * np.arange(sides) / sides
    rim = np.cos(angle)[:, None] * u[:, None] + np.sin(angle)[:, None] * v[:, None]
    points = path_m[:, None] + radii_m[:, None, None] * rim
    triangles = loft_triangles(len(path_m), sides)
    if closed:
        fan = np.array([[0, k + 1, k] for k in range(1, sides - 1)])
        triangles = np.concatenate([triangles, fan, fan[:, ::-1] + (len(path_m) - 1) * sides])
    return facets(points.reshape(-1, 3), triangles)


def loft_triangles(rings: int, sides: int) -> np.ndarray:
    """Triangles (m, 3) between rings that run counter-clockwise as seen from the last one."""
    here = np.arange(rings * sides).reshape(rings, sides)
    right = np.roll(here, -1, axis=1)
    a, b, c, d = here[:-1].ravel(), right[:-1].ravel(), right[1:].ravel(), here[1:].ravel()
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def curve(start, knee, end, steps: int) -> np.ndarray:
    """Points (steps + 1, 3) of a curve from start to end with tangents towards and from the knee."""
    t = np.linspace(0.0, 1.0, steps + 1)[:, None]
    return (1 - t) ** 2 * np.asarray(start) + 2 * t * (1 - t) * np.asarray(knee) + t**2 * np.asarray(end)


def branches(limbs_m: Sequence[np.ndarray], clumps_m: np.ndarray, radius_m: float) -> Mesh:
    """A thin branch to each clump (n, 3), from the middle or the end of the limb with the nearest end."""
    ends = np.array([path[-1] for path in limbs_m])
    meshes = []
    for k, clump in enumerate(clumps_m):
        path = limbs_m[int(np.argmin(((ends - clump) ** 2).sum(axis=1)))]
        start = path[-1] if k % 2 else path[len(path) // 2]
        meshes.append(limb([start, clump], [radius_m, 0.4 * radius_m], 3))
    return joined(meshes)


def directions(rng: np.random.Generator, count: int) -> np.ndarray:
    """Uniform unit vectors (count, 3)."""
    z = rng.uniform(-1.0, 1.0, count)
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    ring = np.sqrt(1.0 - z * z)
    return np.stack([ring * np.cos(angle), ring * np.sin(angle), z], axis=1)


def _ring_axes(path_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors (n, 3) across a line at each point, which form a right-handed frame with its direction."""
    along = np.gradient(path_m, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    chord = np.abs(path_m[-1] - path_m[0])
    aside = np.eye(3)[np.argmin(chord)]  # the axis least aligned with the line
    u = aside - (along @ aside)[:, None] * along
    u /= np.maximum(np.linalg.norm(u, axis=1, keepdims=True), 1e-9)
    return u, np.cross(along, u)
