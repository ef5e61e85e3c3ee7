"""All fine maps of a scene, and the one of trodden ground: trails, paths, wheel tracks, trampled halos, and pans."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..geometry.easing import smooth
from ..noise import fractal_noise
from ..seen_ground import Seen, everywhere
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
_PAN_M, _PAN_SHARE = 25.0, 0.95  # size of pans, and share deep in them; estimates
_PAN_BORDER = 0.06  # of their noise, to each side of a pan's border: about a metre
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
    settings: dict,
    hearths: Sequence[Halo],
    seed: int,
    seen: Seen = everywhere,
) -> FineCovers:
    """The fine maps of a terrain of `scene.terrain` with its covers, with ash about hearths too; in detail where they
    are seen.
    """
    grid = FineGrid(terrain.size_m, seen)
    kind, border = lay_kinds(grid, layers)
    ash = lay_ash(grid, terrain, layers, settings["burnt_fraction"], kind, seed)
    lay_halos(ash, grid, hearths, seed)
    ash[kind != 0] = 0
    trodden = np.maximum(
        lay_trodden(grid, terrain, treads, seed),
        lay_pans(grid, terrain, settings["pan_fraction"], kind, seed),
    )
    for number, layer in enumerate(layers, start=1):
        if layer.material in _HARD:
            trodden[kind == number] = 0
    return FineCovers(kind, border, lay_grass(grid, layers, kind), trodden, ash)


def lay_trodden(grid: FineGrid, terrain: Terrain, treads: Treads, seed: int) -> np.ndarray:
    """Shares of bare, packed ground."""
    share = grid.sampled(partial(_about_water, terrain, seed))
    trodden = refined_bytes(grid, share, np.ones((grid.cells, grid.cells), bool))
    lay_halos(trodden, grid, treads.halos, seed)
    ways = plan_trails(terrain, treads.sources_m, treads.places, seed)
    lay_strands(trodden, grid, [*treads.strands, *ways], seed)
    if terrain.road is not None:
        lay_strands(trodden, grid, wheel_tracks(terrain.road), seed)
    return trodden


def lay_pans(grid: FineGrid, terrain: Terrain, fraction: float, kinds: np.ndarray, seed: int) -> np.ndarray:
    """Shares of even, packed ground in pans of several sizes, with soft borders, on a fraction of the dry ground, off
    other covers.
    """
    x_m, y_m = terrain.samples()
    dry = terrain.shore_m(x_m, y_m, 0.0) > 0
    if fraction <= 0 or not dry.any():
        return np.zeros_like(kinds)
    pans = partial(fractal_noise, seed, "pans", wavelength_m=4.0 * _PAN_M, octaves=5, gain=0.6)
    above = grid.sampled(pans) - np.quantile(pans(x_m[dry], y_m[dry]), 1.0 - min(fraction, 1.0))
    return refined_bytes(grid, _PAN_SHARE * smooth(0.5 + 0.5 * above / _PAN_BORDER), kinds == 0)


def wheel_tracks(road: Road) -> list[Strand]:
    """Both tracks of each line of a road, where they are deepest."""
    return [
        Strand(line, f"wheels/{k}", [_WHEEL_M] * len(shares), shares, 0.08, 60.0, side * TRACK_M, frays=0.25)
        for k, (line, shares) in enumerate(zip(road.lines, _WHEEL_SHARES))
        for side in (-1.0, 1.0)
    ]


def _about_water(terrain: Terrain, seed: int, x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
    """Shares of trampled ground that rise towards the shore of each water, unevenly."""
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
    return share
