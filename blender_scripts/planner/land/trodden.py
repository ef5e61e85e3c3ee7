"""All fine maps of a scene, and the one of trodden ground: trails, paths, wheel tracks, and trampled halos."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..noise import fractal_noise
from .fine_covers import FineCovers, lay_ash, lay_grass, lay_kinds, refined_bytes
from .covers import Layer
from .fine_grid import FineGrid
from .roads import TRACK_M, Road
from .strands import Halo, Strand, lay_halos, lay_strands
from .terrain import Terrain
from .trails import Place, plan_trails

_HARD = ("rock", "concrete")  # no traces of feet
_WHEEL_M = 0.2  # half of a wheel track's width; estimate
_WHEEL_SHARES = [0.95] * 2, [0.95] * 9 + [0.0]  # on the loop; on the spur, whose end fades
_SHORE_SHARE, _SHORE_RAGGED = 0.85, 0.5
_SHORE_REACH = 1.3  # of the water's radius: reach of its halo, at least _SHORE_LEAST_M; estimates
_SHORE_LEAST_M = 12.0


@dataclass(frozen=True)
class Treads:
    """Traces on the ground: strands, halos, points (2,) from which trails lead to the water, and places that foot paths
    lead to.
    """

    strands: list[Strand]
    halos: list[Halo]
    sources_m: list[np.ndarray]
    places: Sequence[Place] = ()


def lay_fine_covers(
    terrain: Terrain,
    layers: Sequence[Layer],
    treads: Treads,
    burnt_fraction: float,
    hearths: Sequence[Halo],
    seed: int,
) -> FineCovers:
    """The fine maps of a terrain with its covers, with ash on burnt_fraction of its dry ground and about hearths."""
    grid = FineGrid(terrain.size_m)
    kind, border = lay_kinds(grid, layers)
    ash = lay_ash(grid, terrain, burnt_fraction, kind, seed)
    lay_halos(ash, grid, hearths, seed)
    ash[kind != 0] = 0
    trodden = lay_trodden(grid, terrain, treads, seed)
    for number, layer in enumerate(layers, start=1):
        if layer.material in _HARD:
            trodden[kind == number] = 0
    return FineCovers(kind, border, lay_grass(grid, layers, kind), trodden, ash)


def lay_trodden(grid: FineGrid, terrain: Terrain, treads: Treads, seed: int) -> np.ndarray:
    """Shares of bare, packed ground."""
    trodden = _about_water(grid, terrain, seed)
    lay_halos(trodden, grid, treads.halos, seed)
    ways = plan_trails(terrain, treads.sources_m, treads.places, seed)
    lay_strands(trodden, grid, [*treads.strands, *ways], seed)
    if terrain.road is not None:
        lay_strands(trodden, grid, wheel_tracks(terrain.road), seed)
    return trodden


def wheel_tracks(road: Road) -> list[Strand]:
    """Both tracks of each line of a road, where they are deepest."""
    return [
        Strand(line, f"wheels/{k}", [_WHEEL_M] * len(shares), shares, 0.08, 60.0, side * TRACK_M, frays=0.25)
        for k, (line, shares) in enumerate(zip(road.lines, _WHEEL_SHARES))
        for side in (-1.0, 1.0)
    ]


def _about_water(grid: FineGrid, terrain: Terrain, seed: int) -> np.ndarray:
    """Shares of trampled ground that rise towards the shore of each water, unevenly."""
    x_m, y_m = grid.lattice()
    share = np.zeros(x_m.shape)
    for water in terrain.waters:
        reach_m = max(_SHORE_LEAST_M, _SHORE_REACH * water.basin.radius_m)
        shore_m = water.basin.near_shore_m(x_m, y_m, 2.0 * reach_m)
        near = np.isfinite(shore_m)
        at_m = (x_m[near], y_m[near])
        wide = fractal_noise(seed, "shore/trampled", *at_m, 0.8 * reach_m, octaves=4)
        out = np.clip(shore_m[near] / reach_m * (1.0 + _SHORE_RAGGED * wide), 0.0, 1.0)
        patchy = np.clip(1.0 + 0.8 * fractal_noise(seed, "shore/patches", *at_m, 9.0, octaves=2), 0.0, 1.2)
        share[near] = np.maximum(share[near], _SHORE_SHARE * (1.0 - out) ** 2 * patchy)
    return refined_bytes(grid, share, np.ones((grid.cells, grid.cells), bool))
