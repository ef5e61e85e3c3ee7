"""Where plants stand: evenly shaken grid points, thinned into clumps, off the water and the actors' paths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .noise import fractal_noise, lattice_uniform
from .terrain import Terrain

_KEPT = 0.45  # mean share of grid points that get a plant; the rest are the gaps between clumps
_SHAKE = 0.7  # of a grid cell; two plants stand at least 0.3 cells apart
_CLUMP_M = 70.0
_OVER_WATER_M = 0.3
_CHUNK = 2048


@dataclass(frozen=True)
class Planting:
    """Plants of one species: points_m (n, 3), yaw_rad (n,), scale (n,) of the drawn size, variant (n,)."""

    points_m: np.ndarray
    yaw_rad: np.ndarray
    scale: np.ndarray
    variant: np.ndarray


@dataclass(frozen=True)
class Corridor:
    """A walked line, points_m (n, 2) at most a metre apart, and how far from it walkers come."""

    points_m: np.ndarray
    half_width_m: float


def place_plants(
    name: str, data: dict, per_ha: float, terrain: Terrain, corridors: Sequence[Corridor], seed: int
) -> Planting:
    """Plants of one species over the whole terrain, per_ha of them on average where nothing forbids them.

    What stands at a place depends on the seed and the place alone; the corridors only take plants away.
    """
    ix, iy, x_m, y_m, kept = _candidates(name, per_ha, terrain.size_m, seed)
    kept &= terrain.shore_m(x_m, y_m) > 0
    if terrain.water is not None:
        near = terrain.shore_m(x_m, y_m) < terrain.water.disc_radius_m
        kept &= ~near | (terrain.height_m(x_m, y_m) > terrain.water.level_m + _OVER_WATER_M)
    ix, iy, x_m, y_m = (values[kept] for values in (ix, iy, x_m, y_m))
    free = _is_clear(np.column_stack([x_m, y_m]), corridors, data["clearance_m"])
    ix, iy, x_m, y_m = (values[free] for values in (ix, iy, x_m, y_m))
    low, high = data["scale_range"]
    return Planting(
        points_m=np.column_stack([x_m, y_m, terrain.height_m(x_m, y_m)]),
        yaw_rad=2.0 * np.pi * lattice_uniform(seed, f"{name}/yaw", ix, iy),
        scale=low + (high - low) * lattice_uniform(seed, f"{name}/scale", ix, iy),
        variant=(data["variants"] * lattice_uniform(seed, f"{name}/variant", ix, iy)).astype(np.int64),
    )


def _candidates(name: str, per_ha: float, size_m: float, seed: int):
    """Grid numbers, shaken positions, and which of them the density field keeps."""
    cell_m = np.sqrt(1e4 * _KEPT / per_ha) if per_ha > 0 else np.inf
    reach = int(0.5 * size_m / cell_m) + 1 if per_ha > 0 else 0
    ix, iy = (grid.ravel() for grid in np.meshgrid(*[np.arange(-reach, reach)] * 2))
    x_m = cell_m * (ix + 0.5 + _SHAKE * (lattice_uniform(seed, f"{name}/x", ix, iy) - 0.5))
    y_m = cell_m * (iy + 0.5 + _SHAKE * (lattice_uniform(seed, f"{name}/y", ix, iy) - 0.5))
    wealth = np.clip(
        0.5 + 1.2 * fractal_noise(seed, f"{name}/clumps", x_m, y_m, _CLUMP_M, octaves=3), 0.02, 1.0
    )
    share = 2.0 * _KEPT * wealth  # wealth is 0.5 on average, clipped alike on both sides
    inside = (np.abs(x_m) < 0.5 * size_m) & (np.abs(y_m) < 0.5 * size_m)
    return ix, iy, x_m, y_m, inside & (lattice_uniform(seed, f"{name}/kept", ix, iy) < share)


def _is_clear(points_m: np.ndarray, corridors: Sequence[Corridor], clearance_m: float) -> np.ndarray:
    """Which points (n, 2) are at least clearance_m from every walker on every corridor."""
    clear = np.ones(len(points_m), bool)
    for corridor in corridors:
        least_m = clearance_m + corridor.half_width_m
        low, high = corridor.points_m.min(axis=0) - least_m, corridor.points_m.max(axis=0) + least_m
        near = np.flatnonzero(((points_m > low) & (points_m < high)).all(axis=1))
        for chunk in np.array_split(near, len(near) // _CHUNK + 1):
            gap = points_m[chunk, None, :] - corridor.points_m[None, :, :]
            clear[chunk] &= (gap[..., 0] ** 2 + gap[..., 1] ** 2).min(axis=1) >= least_m**2
    return clear
