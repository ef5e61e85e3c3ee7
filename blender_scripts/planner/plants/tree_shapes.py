"""Trees, bushes and grass by form: wood, and leaves at the ends of its twigs. Lengths in m."""

from __future__ import annotations

import numpy as np

from ..geometry.shapes import Mesh, facets, joined
from .branch_shapes import GOLDEN_ANGLE_RAD, branches, curve, directions, limb, loft_triangles
from .leaf_shapes import blades, leafy_twigs

_LOBED = 0.45  # of a crown's reach; estimate
_ROOT_M = -0.3  # depth of trunks below the ground, which may slope
# Material slots; branches and the stems of bushes, which follow the air as leaves do, use that of leaves.
LEAVES, WOOD = range(2)


def umbrella(data: dict, rng: np.random.Generator) -> Mesh:
    """A trunk that forks low, limbs that rise and spread, and a wide flat crown of leafy pads."""
    height, radius, thick = data["height_m"], data["trunk_radius_m"], data["crown_thickness_m"]
    pads = _on_disc(data, rng)
    pads[:, 2] += height - 0.5 * thick
    fork = np.array([*rng.uniform(-0.05, 0.05, 2) * height, height * rng.uniform(0.24, 0.36)])
    trunk = limb([[0.0, 0.0, _ROOT_M], [*0.2 * fork[:2], 0.4], fork], radius * np.array([1.3, 1.0, 0.85]), 6)
    limbs = [_spreading(fork, pads[k :: data["limbs"]].mean(axis=0), thick) for k in range(data["limbs"])]
    wood = [limb(path, radius * np.array([0.62, 0.5, 0.34]), 4) for path in limbs]
    reach = _clump_reach(data) * np.array([1.0, 1.0, 0.0]) + [0.0, 0.0, 0.32 * thick]
    leaves = leafy_twigs(pads, reach, data["leaves"], data["leaf_m"], rng)
    return joined([joined([trunk, *wood]).with_slot(WOOD), branches(limbs, pads, 0.24 * radius), leaves])


def many_stemmed(data: dict, rng: np.random.Generator) -> Mesh:
    """Stems that part at the ground and arch outward into a wide crown, leafy almost down to the ground."""
    clumps = _on_dome(data, rng)
    radius, reach = data["trunk_radius_m"], 0.5 * data["crown_diameter_m"]
    paths = []
    for k in range(data["limbs"]):
        angle = GOLDEN_ANGLE_RAD * k + rng.uniform(-0.4, 0.4)
        out = np.array([np.cos(angle), np.sin(angle), 0.0]) * reach * rng.uniform(0.4, 0.65)
        top = out + [0.0, 0.0, data["height_m"] * rng.uniform(0.6, 0.75)]
        paths.append(curve(0.18 * out + [0.0, 0.0, _ROOT_M], 0.8 * out + 0.45 * (top - out), top, 3))
    wood = [limb(path, radius * np.array([1.0, 0.85, 0.65, 0.4]), 4) for path in paths]
    leaves = leafy_twigs(clumps, np.full(3, _clump_reach(data)), data["leaves"], data["leaf_m"], rng)
    return joined([joined(wood).with_slot(WOOD), branches(paths, clumps, 0.35 * radius), leaves])


def bush(data: dict, rng: np.random.Generator) -> Mesh:
    """A stem to each leafy clump, all from nearly one root."""
    clumps = _on_dome(data, rng)
    radius = data["trunk_radius_m"]
    wood = [limb([[*0.1 * tip[:2], -0.1], tip], [radius, 0.4 * radius], 3) for tip in clumps]
    leaves = leafy_twigs(clumps, np.full(3, _clump_reach(data)), data["leaves"], data["leaf_m"], rng)
    return joined([*wood, leaves])


def bottle(data: dict, rng: np.random.Generator) -> Mesh:
    """A baobab: a fluted barrel of a trunk, and on its shoulder stubby bare limbs that fork and fork again."""
    height, radius = data["height_m"], data["trunk_radius_m"]
    shoulder = data["trunk_height_m"]
    wood = [_barrel(radius, shoulder, rng)]
    for k in range(data["limbs"]):
        angle = GOLDEN_ANGLE_RAD * k + rng.uniform(-0.3, 0.3)
        out = np.array([np.cos(angle), np.sin(angle), 0.0])
        tilt = 0.35 + 0.65 * np.sqrt((k + 0.5) / data["limbs"])  # the first ones rise steeply from the middle
        start = out * 0.55 * radius * tilt + [0.0, 0.0, shoulder * (1.0 - 0.16 * tilt)]
        heading = out * tilt + [0.0, 0.0, 1.0 - 0.45 * tilt]
        wood += _forking(start, heading, 0.52 * (height - shoulder), 0.34 * radius, 3, rng)
    return joined(wood)


def tussock(data: dict, rng: np.random.Generator) -> Mesh:
    """A clump of tall grass: blades from a small foot, the outer ones leaning out and bending over."""
    count, height = data["leaves"], data["height_m"]
    angle = GOLDEN_ANGLE_RAD * np.arange(count) + rng.uniform(-0.4, 0.4, count)
    out = np.sqrt((np.arange(count) + 0.5) / count)
    ray = np.stack([np.cos(angle), np.sin(angle), np.zeros(count)], axis=1) * out[:, None]
    lean = rng.uniform(0.5, 1.1, count)
    tips = 0.5 * data["crown_diameter_m"] * lean[:, None] * ray
    tips[:, 2] = height * (1.0 - 0.55 * (out * lean) ** 2) * rng.uniform(0.7, 1.0, count)
    roots = data["trunk_radius_m"] * ray * rng.uniform(0.5, 1.0, (count, 1)) + [0.0, 0.0, -0.1]
    return blades(roots, tips, data["leaf_m"] * rng.uniform(0.7, 1.3, count), rng)


def _lobed(angle: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Angles (n,) gathered in three lobes, and the relative reach of a crown there, as wide in all directions."""
    phase_rad = rng.uniform(0.0, 2.0 * np.pi, 2)
    aside = 3.0 * angle + phase_rad[0]
    reach = 1.0 + _LOBED * (np.cos(aside) / 3.0 + np.cos(angle + phase_rad[1]) / 6.0)
    return angle - 0.8 * _LOBED * np.sin(aside), reach


def _on_disc(data: dict, rng: np.random.Generator) -> np.ndarray:
    """Centres (n, 3) of leafy pads, spread evenly over a horizontal disc with jitter, slightly lower at its rim."""
    count = data["clumps"]
    # A third of them lie on the rim: with only the last three there, the crown would be a triangle.
    out = np.minimum(1.2 * np.sqrt((np.arange(count) + 0.5) / count), 1.0) * rng.uniform(0.88, 1.06, count)
    angle = GOLDEN_ANGLE_RAD * np.arange(count) + rng.uniform(-0.25, 0.25, count)
    angle, lobes = _lobed(angle, rng)
    reach = (0.5 * data["crown_diameter_m"] - _clump_reach(data)) * lobes
    z = data["crown_thickness_m"] * (rng.uniform(-0.15, 0.15, count) - 0.3 * out**2)
    return np.stack([reach * out * np.cos(angle), reach * out * np.sin(angle), z], axis=1)


def _on_dome(data: dict, rng: np.random.Generator) -> np.ndarray:
    """Centres (n, 3) of leafy clumps on and in an ellipsoid that ends crown_thickness_m below the top."""
    count = data["clumps"]
    ray = directions(rng, count)
    # The golden angle, unlike random angles, keeps the clumps apart; heights go from low to high and back.
    angle, lobes = _lobed(GOLDEN_ANGLE_RAD * np.arange(count), rng)
    up = np.linspace(-0.75, 0.95, count)
    ring = np.sqrt(1.0 - up * up)
    ray = 0.25 * ray + np.stack([ring * np.cos(angle), ring * np.sin(angle), up], axis=1)
    half = 0.5 * np.array([data["crown_diameter_m"], data["crown_diameter_m"], data["crown_thickness_m"]])
    inset = np.maximum(half - _clump_reach(data), 0.3 * half)
    ray[:, :2] *= lobes[:, None]
    return ray * inset * rng.uniform(0.7, 1.05, (count, 1)) + [0.0, 0.0, data["height_m"] - half[2]]


def _clump_reach(data: dict) -> float:
    """Radius of clumps: they overlap by about half and still leave gaps."""
    return 0.68 * data["crown_diameter_m"] / np.sqrt(data["clumps"])


def _spreading(fork: np.ndarray, end: np.ndarray, crown_thickness_m: float) -> np.ndarray:
    """A limb's line from the fork: outward and up, then flatter under the crown."""
    end = end * [0.85, 0.85, 1.0] - [0.0, 0.0, 0.35 * crown_thickness_m]
    knee = fork + (end - fork) * [0.45, 0.45, 0.75]
    return curve(fork, knee, end, 2)


def _barrel(radius_m: float, shoulder_m: float, rng: np.random.Generator) -> Mesh:
    """A baobab's trunk: flared foot, long belly, rounded shoulder, with folds down its sides."""
    sides = 14
    z = np.array([-0.14, 0.0, 0.12, 0.5, 0.78, 0.93, 1.0]) * shoulder_m
    swell = np.array([1.25, 1.14, 1.0, 0.97, 0.84, 0.58, 0.02])
    angle = 2.0 * np.pi * np.arange(sides) / sides
    folds = 0.05 * np.cos(5 * angle + rng.uniform(0, 6.3)) + 0.05 * np.cos(3 * angle + rng.uniform(0, 6.3))
    r = radius_m * swell[:, None] * (1.0 + folds)
    points = np.stack([r * np.cos(angle), r * np.sin(angle), np.repeat(z[:, None], sides, axis=1)], axis=-1)
    return facets(points.reshape(-1, 3), loft_triangles(len(z), sides))


def _forking(start, heading, length_m, radius_m, order: int, rng: np.random.Generator) -> list[Mesh]:
    """A crooked limb and, recursively, `order` - 1 generations of shorter and thinner ones from its end."""
    heading = heading / np.linalg.norm(heading)
    end = start + heading * length_m
    knee = start + 0.5 * (end - start) + directions(rng, 1)[0] * 0.16 * length_m
    if order == 1:
        return [limb([start, end], radius_m * np.array([1.0, 0.5]), 3)]
    meshes = [limb([start, knee, end], radius_m * np.array([1.0, 0.72, 0.5]), order + 2)]
    for _ in range(3):
        aside = heading + directions(rng, 1)[0] * 0.85 + [0.0, 0.0, 0.12]
        meshes += _forking(end, aside, length_m * rng.uniform(0.5, 0.68), 0.5 * radius_m, order - 1, rng)
    return meshes
