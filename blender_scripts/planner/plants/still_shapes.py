"""Objects other than plants: termite mounds, rocks, fallen logs. Lengths in m."""

from __future__ import annotations

import numpy as np

from ..geometry.shapes import Mesh, facets, joined
from .branch_shapes import directions, limb, loft_triangles


def mound(data: dict, rng: np.random.Generator) -> Mesh:
    """A termite mound: a bumpy spire on a broad foot, with a lower spire or two at its side."""
    height, radius = data["height_m"], 0.5 * data["crown_diameter_m"]
    spires = [_spire(np.zeros(2), radius, height, 9, rng)]
    for _ in range(rng.integers(1, 3)):
        aside = directions(rng, 1)[0, :2]
        aside *= 0.4 * radius / np.linalg.norm(aside)
        spires.append(_spire(aside, 0.5 * radius, height * rng.uniform(0.45, 0.75), 6, rng))
    return joined(spires)


def rock(data: dict, rng: np.random.Generator) -> Mesh:
    """A boulder: a sphere with many flat cuts, a quarter of its height below the ground."""
    rings, sides = 7, 10
    polar = np.pi * (np.arange(rings) + 0.02) / (rings - 0.96)
    angle = 2.0 * np.pi * np.arange(sides) / sides
    ray = np.stack(
        [
            np.outer(-np.sin(polar), np.cos(angle)),
            np.outer(-np.sin(polar), -np.sin(angle)),
            np.outer(-np.cos(polar), np.ones(sides)),
        ],
        axis=-1,
    ).reshape(-1, 3)
    cuts = directions(rng, data["limbs"])
    depth = rng.uniform(0.6, 1.0, data["limbs"])
    facing = np.maximum(ray @ cuts.T, 1e-3)
    reach = np.minimum((depth / facing).min(axis=1), 1.0)
    half = 0.5 * np.array([data["crown_diameter_m"], data["crown_diameter_m"] * rng.uniform(0.6, 0.9), 0.0])
    half[2] = data["height_m"] / 1.5  # three quarters of its full height are above ground
    points = ray * reach[:, None] * half + [0.0, 0.0, 0.5 * half[2]]
    return facets(points, loft_triangles(rings, sides))


def log(data: dict, rng: np.random.Generator) -> Mesh:
    """A fallen trunk along x, a little crooked, tapering, with the stubs of broken limbs."""
    length, radius = data["crown_diameter_m"], data["trunk_radius_m"]
    x = np.linspace(-0.5, 0.5, 5) * length
    path = np.stack([x, rng.uniform(-0.03, 0.03, 5) * length, np.full(5, 0.35 * radius)], axis=1)
    parts = [limb(path, radius * np.array([1.15, 1.0, 0.9, 0.75, 0.6]), 7, closed=True)]
    for k in range(data["limbs"]):
        # The first snag stands up, the others lie to either side.
        snag = np.array([0.8, [0.3, 1.6, -1.6][k % 3], 2.6 if k == 0 else 0.6]) * radius
        snag = path[1 + k % 3] + np.array([np.zeros(3), snag * rng.uniform(0.9, 1.5, 3)])
        parts.append(limb(snag, radius * np.array([0.45, 0.2]), 4, closed=True))
    return joined(parts)


def _spire(at_m: np.ndarray, radius_m: float, height_m: float, sides: int, rng: np.random.Generator) -> Mesh:
    z = np.array([-0.25, 0.0, 0.12, 0.4, 0.75, 0.95, 1.0])
    swell = np.array([1.1, 1.0, 0.72, 0.52, 0.34, 0.2, 0.01])
    angle = 2.0 * np.pi * np.arange(sides) / sides
    r = radius_m * swell[:, None] * rng.uniform(0.8, 1.2, (len(z), sides))
    lean = np.outer(z, rng.uniform(-0.15, 0.15, 2)) * height_m
    x = at_m[0] + lean[:, :1] + r * np.cos(angle)
    y = at_m[1] + lean[:, 1:] + r * np.sin(angle)
    points = np.stack([x, y, np.repeat(height_m * z[:, None], sides, axis=1)], axis=-1)
    return facets(points.reshape(-1, 3), loft_triangles(len(z), sides))
