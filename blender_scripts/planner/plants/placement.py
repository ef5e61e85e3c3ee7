"""Placement of plants and other objects with the density of each area, off water, the road and the actors' paths."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .. import assets
from ..geometry.neighbours import pairs_within
from ..geometry.poisson import fullest_per_m2, poisson_points
from ..land.corridors import Corridors
from ..land.terrain import Terrain, slope_deg
from ..noise import fractal_noise, lattice_uniform

AREAS = 3  # open, mid, dense
_PATCHINESS = 0.6  # relative variation of a species' density between patches
_CLUMPS_M = 70.0  # side of a square with the middle of one clump, at which all species gather
_GATHERED = 0.75  # share of the plants in clumps; estimate
_CLUMP_SIZES = (0.4, 1.6)  # least and largest number of plants in a clump, relative to the mean; estimates
_MOST_TAKEN = 0.5  # largest share of a scene taken by the footprints of other species
_SHORE_M = 1.5
_M2_PER_HA = 1e4


@dataclass(frozen=True)
class Planting:
    """Plants of one species: points_m (n, 3), yaw_rad (n,), scale (n,) of the drawn size, variant (n,)."""

    points_m: np.ndarray
    yaw_rad: np.ndarray
    scale: np.ndarray
    variant: np.ndarray


# Shares (n, 3) of open, mid and dense ground at positions (x_m, y_m).
Shares = Callable[[np.ndarray, np.ndarray], np.ndarray]


def _even_shares(x_m: np.ndarray, _) -> np.ndarray:
    """Shares of a scene that is a third of each area everywhere."""
    return np.full((len(x_m), AREAS), 1.0 / AREAS)


def _no_road(x_m: np.ndarray, _) -> np.ndarray:
    return np.full(len(x_m), np.inf)


@dataclass(frozen=True)
class Site:
    """The ground for plants, its areas, and reserved parts.

    shares(x_m, y_m) gives the shares (n, 3) of open, mid and dense, which sum to 1; road_m(x_m, y_m) the distance (n,)
    to the road's border, negative on it.
    """

    terrain: Terrain
    shares: Shares = _even_shares
    road_m: Callable[[np.ndarray, np.ndarray], np.ndarray] = _no_road
    corridors: Corridors = Corridors()


@dataclass(frozen=True)
class _Species:
    """A species and its wanted number per square metre in each area (3,)."""

    name: str
    data: dict
    per_m2: np.ndarray


def by_area(per_ha: float | Sequence[float]) -> list[float]:
    """Number per hectare in the open, mid and dense areas; a single number applies to all three."""
    return list(per_ha) if isinstance(per_ha, Sequence) else [per_ha] * AREAS


def place_plants(plants: Mapping[str, dict], site: Site, seed: int) -> dict[str, Planting]:
    """Plants of all species of `scene.plants`, by name in alphabetical order.

    The species with the widest footprint is placed first; the others keep off it, and their density is raised to
    compensate. Plants in the way of water, road and walkers are removed last, so that a new path moves no plant.
    """
    kinds = [
        _Species(name, assets.load("plants", name), np.array(by_area(wanted["per_ha"]), float) / _M2_PER_HA)
        for name, wanted in plants.items()
    ]
    standing: list[tuple[_Species, np.ndarray]] = []
    plantings: dict[str, Planting] = {}
    for kind in sorted(kinds, key=lambda kind: (-kind.data["foot_m"], kind.name)):
        cells, points_m = _spaced(kind, standing, site, seed)
        standing.append((kind, points_m))
        free = _is_free(points_m, kind.data, site)
        plantings[kind.name] = _planting(kind, cells[free], points_m[free], site.terrain, seed)
    return {name: plantings[name] for name in sorted(plants)}


def with_more(plantings: Mapping[str, Planting], more: Mapping[str, Planting]) -> dict[str, Planting]:
    """Plants and other things of both, by name in alphabetical order."""

    def both(name: str) -> Planting:
        found = [some[name] for some in (plantings, more) if name in some]
        return Planting(*(np.concatenate(values) for values in zip(*(vars(each).values() for each in found))))

    return {name: both(name) for name in sorted({**plantings, **more})}


def _spaced(kind: _Species, standing: Sequence[tuple[_Species, np.ndarray]], site: Site, seed: int):
    """Lattice cells (n, 2) and points (n, 2) of plants that keep off each other and off plants already placed."""

    def wanted(x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
        shares = site.shares(x_m, y_m)
        free = np.ones(len(x_m))
        for other, _ in standing:
            taken = shares @ other.per_m2 * np.pi * _apart_m(kind, other) ** 2
            free *= 1.0 - np.minimum(taken, _MOST_TAKEN)
        even = shares @ kind.per_m2 * _liking(kind, site.terrain, seed, x_m, y_m) / free
        return even if clump_m == 0.0 else even * _clumping(seed, clump_m, most_per_m2, even, x_m, y_m)

    clump_m = kind.data.get("clump_m", 0.0)
    most_per_m2 = kind.per_m2.max() * (1.0 + _PATCHINESS) * 1.2  # 1.2: for losses to others in dense areas
    if clump_m > 0.0:
        most_per_m2 = max(most_per_m2, min(10.0 * most_per_m2, fullest_per_m2(kind.data["spacing_m"])))
    cells, points_m = poisson_points(
        seed, kind.name, site.terrain.size_m, kind.data["spacing_m"], most_per_m2, wanted
    )
    stays = np.ones(len(points_m), bool)
    for other, others_m in standing:
        taken, _ = pairs_within(points_m, others_m, _apart_m(kind, other))
        stays[taken] = False
    return cells[stays], points_m[stays]


def _apart_m(one: _Species, other: _Species) -> float:
    """Minimum distance between plants of two species, such that their footprints do not overlap."""
    return one.data["foot_m"] + other.data["foot_m"]


def _liking(kind: _Species, terrain: Terrain, seed: int, x_m, y_m) -> np.ndarray:
    """Density of a species relative to its area's mean: it grows in patches, and less on slopes."""
    patches = fractal_noise(seed, f"{kind.name}/patches", x_m, y_m, kind.data["patch_m"], octaves=2)
    rich = 1.0 + np.clip(2.0 * patches, -_PATCHINESS, _PATCHINESS)
    gentle, steep = kind.data["slope_deg"]
    return rich * np.clip((steep - slope_deg(terrain, x_m, y_m)) / (steep - gentle), 0.0, 1.0)


def _clumping(seed: int, clump_m: float, most_per_m2: float, even_per_m2: np.ndarray, x_m, y_m) -> np.ndarray:
    """Density in and between clumps, relative to an even one, with mean 1; less uneven where it would be above most."""
    ix, iy = (np.floor(along_m / _CLUMPS_M - 0.5).astype(np.int64) for along_m in (x_m, y_m))
    per_clump = _CLUMPS_M**2 / (np.pi * clump_m**2)
    clumps = np.zeros(len(x_m))
    for cell in ((ix, iy), (ix + 1, iy), (ix, iy + 1), (ix + 1, iy + 1)):
        u, v, long, size = (lattice_uniform(seed, f"clumps/{name}", *cell) for name in "xyls")
        off_x_m, off_y_m = x_m - _CLUMPS_M * (cell[0] + u), y_m - _CLUMPS_M * (cell[1] + v)
        stretch = 0.7 + 0.7 * long
        along_m, across_m = 0.8 * off_x_m + 0.6 * off_y_m, 0.8 * off_y_m - 0.6 * off_x_m
        inside = (along_m * stretch) ** 2 + (across_m / stretch) ** 2 < clump_m**2
        low, high = _CLUMP_SIZES
        clumps += inside * per_clump * (low + (high - low) * size)
    room = most_per_m2 / np.maximum(even_per_m2, 1e-12) - 1.0
    gathered = np.clip(room / (_CLUMP_SIZES[1] * per_clump - 1.0), 0.0, _GATHERED)
    return 1.0 + gathered * (clumps - 1.0)


def _is_free(points_m: np.ndarray, data: dict, site: Site) -> np.ndarray:
    """Mask of points (n, 2) on dry ground, off the road and clear of corridors."""
    x_m, y_m = points_m.T
    free = site.terrain.shore_m(x_m, y_m) > _SHORE_M + data["foot_m"]
    free &= site.road_m(x_m, y_m) > data["foot_m"]
    return free & ~site.corridors.taken(points_m, data["clearance_m"])


def _planting(
    kind: _Species, cells: np.ndarray, points_m: np.ndarray, terrain: Terrain, seed: int
) -> Planting:
    """The plants at these points; the appearance of each is a function of its cell."""
    low, high = kind.data["scale_range"]
    variant = kind.data["variants"] * lattice_uniform(seed, f"{kind.name}/variant", *cells.T)
    return Planting(
        points_m=np.column_stack([points_m, terrain.height_m(*points_m.T)]),
        yaw_rad=2.0 * np.pi * lattice_uniform(seed, f"{kind.name}/yaw", *cells.T),
        scale=low + (high - low) * lattice_uniform(seed, f"{kind.name}/scale", *cells.T),
        variant=variant.astype(np.int64),
    )
