"""Plants as real geometry: stems, and leaf sprays as ragged facets with daylight between them."""

from __future__ import annotations

import numpy as np

from .noise import stream
from .shapes import Mesh, facets, joined

_SPRAY_CORNERS = 5


def build_variants(name: str, data: dict, seed: int) -> list[Mesh]:
    """Meshes of a plant's variants at its drawn size, standing at the origin, z up."""
    return [_plant(data, stream(seed, f"plant/{name}", k)) for k in range(data["variants"])]


def _plant(data: dict, rng: np.random.Generator) -> Mesh:
    clumps_m = _clump_centres(data, rng)
    stems = _umbrella_stems if data["form"] == "umbrella" else _bush_stems
    return joined([*stems(data, clumps_m, rng), _leaves(data, clumps_m, rng)])


def _clump_centres(data: dict, rng: np.random.Generator) -> np.ndarray:
    """Centres (n, 3) of the leafy clumps, spread evenly over a disc by the golden angle and shaken."""
    count = data["clumps"]
    k = np.arange(count)
    reach = 0.5 * data["crown_diameter_m"] - _clump_radius(data)
    radius = reach * np.sqrt((k + 0.5) / count) * rng.uniform(0.8, 1.12, count)
    angle = 2.399963 * k + rng.uniform(-0.35, 0.35, count) + rng.uniform(0.0, 2.0 * np.pi)
    # Both forms are highest in the middle; an umbrella only a little.
    droop = 0.35 * data["crown_thickness_m"] * (radius / max(reach, 1e-9)) ** 2
    z = (
        data["height_m"]
        - 0.45 * data["crown_thickness_m"]
        - droop
        + rng.uniform(-0.1, 0.1, count) * data["crown_thickness_m"]
    )
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1)


def _clump_radius(data: dict) -> float:
    """Clumps overlap by about half, and still leave gaps."""
    return 0.62 * data["crown_diameter_m"] / np.sqrt(data["clumps"])


def _leaves(data: dict, clumps_m: np.ndarray, rng: np.random.Generator) -> Mesh:
    """Leaf sprays scattered through the clumps, each an irregular polygon turned mostly skyward."""
    count = data["leaves"]
    clump = rng.integers(0, len(clumps_m), count)
    direction = _directions(rng, count)
    radius_m = _clump_radius(data) * rng.uniform(0.3, 1.0, count) ** 0.6
    flat = np.array([1.0, 1.0, 0.4 * data["crown_thickness_m"] / _clump_radius(data)])
    centres = clumps_m[clump] + direction * radius_m[:, None] * flat
    centres[:, 2] = np.maximum(centres[:, 2], data["leaf_m"])
    normal = _directions(rng, count) * 0.8 + np.array([0.0, 0.0, 1.0])
    return _polygons(centres, normal, data["leaf_m"] * rng.uniform(0.6, 1.4, count), rng)


def _polygons(
    centres: np.ndarray, normals: np.ndarray, radii_m: np.ndarray, rng: np.random.Generator
) -> Mesh:
    """Irregular flat polygons (n of them) as triangle fans."""
    count, corners = len(centres), _SPRAY_CORNERS
    normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    u = np.cross(normals, _directions(rng, count))
    u /= np.maximum(np.linalg.norm(u, axis=1, keepdims=True), 1e-9)
    v = np.cross(normals, u)
    angle = 2.0 * np.pi * (np.arange(corners) + rng.uniform(-0.3, 0.3, (count, corners))) / corners
    reach = radii_m[:, None] * rng.uniform(0.55, 1.0, (count, corners))
    rim = (reach * np.cos(angle))[..., None] * u[:, None] + (reach * np.sin(angle))[..., None] * v[:, None]
    fan = np.array([[0, k, k + 1] for k in range(1, corners - 1)])
    triangles = fan[None] + corners * np.arange(count)[:, None, None]
    return facets((centres[:, None] + rim).reshape(-1, 3), triangles.reshape(-1, 3))


def _umbrella_stems(data: dict, clumps_m: np.ndarray, rng: np.random.Generator) -> list[Mesh]:
    """A trunk that forks low, main branches that rise and spread, and a twig to each clump."""
    radius_m = data["trunk_radius_m"]
    fork = np.array([*rng.uniform(-0.3, 0.3, 2), data["height_m"] * rng.uniform(0.28, 0.4)])
    mains = 4
    knees = np.array([clumps_m[k::mains].mean(axis=0) * 0.55 + fork * 0.45 for k in range(mains)])
    stems = [_stem(np.zeros(3), fork, radius_m, 0.8 * radius_m)]
    stems += [_stem(fork, knee, 0.6 * radius_m, 0.4 * radius_m) for knee in knees]
    return stems + [
        _stem(knees[k % mains], tip, 0.35 * radius_m, 0.1 * radius_m) for k, tip in enumerate(clumps_m)
    ]


def _bush_stems(data: dict, clumps_m: np.ndarray, rng: np.random.Generator) -> list[Mesh]:
    """Several stems from about one root, one to each clump."""
    radius_m = data["trunk_radius_m"]
    roots = np.column_stack([rng.uniform(-2.0, 2.0, (len(clumps_m), 2)) * radius_m, np.zeros(len(clumps_m))])
    return [_stem(root, tip, radius_m, 0.4 * radius_m) for root, tip in zip(roots, clumps_m)]


def _stem(start: np.ndarray, end: np.ndarray, radius0_m: float, radius1_m: float, sides: int = 4) -> Mesh:
    """An open tapered prism; its ends are out of sight."""
    along = (end - start) / np.linalg.norm(end - start)
    u = np.cross(along, [1.0, 0.0, 0.0] if abs(along[0]) < 0.7 else [0.0, 1.0, 0.0])
    u /= np.linalg.norm(u)
    v = np.cross(along, u)
    angle = 2.0 * np.pi * np.arange(sides)[:, None] / sides
    rim = np.cos(angle) * u + np.sin(angle) * v
    k = np.arange(sides)
    n = (k + 1) % sides
    sides_of = np.concatenate(
        [np.stack([k, n, n + sides], axis=1), np.stack([k, n + sides, k + sides], axis=1)]
    )
    return facets(np.concatenate([start + radius0_m * rim, end + radius1_m * rim]), sides_of)


def _directions(rng: np.random.Generator, count: int) -> np.ndarray:
    """Uniform unit vectors (count, 3)."""
    z = rng.uniform(-1.0, 1.0, count)
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    ring = np.sqrt(1.0 - z * z)
    return np.stack([ring * np.cos(angle), ring * np.sin(angle), z], axis=1)
