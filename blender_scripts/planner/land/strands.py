"""Narrow strips of trodden ground and bare halos, laid on the fine grid. Lengths in m."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.easing import smooth
from ..geometry.rotations import left_of
from ..geometry.splines import Line, Loop
from ..noise import fractal_noise
from .fine_grid import FineGrid
from .shares import as_bytes, raise_to

_STEP_CELLS = 0.8  # between the points of a strand
_OCTAVES = 3  # of a strand's winding
_FRAYED_M = 45.0  # along a strand, from where it is bare to where plants close in
_RAGGED = 0.6  # of a halo's reach: how uneven its border is


@dataclass(frozen=True)
class Strand:
    """A strip along a curve that winds by up to about wander_m to each side of it, aside_m to its left.

    half_width_m and share are at its corners, evenly along the curve, and interpolated between them; share is of bare
    ground, where the strand is not frayed. `name` keys its winding, which is the same at the same point for all strands
    of that name.
    """

    curve: Line | Loop
    name: str
    half_width_m: Sequence[float]
    share: Sequence[float]
    wander_m: float = 0.0
    wavelength_m: float = 20.0
    aside_m: float = 0.0
    frays: float = 0.6


@dataclass(frozen=True)
class Halo:
    """Bare ground about a point: a share up to bare_m from it, which falls to 0 at reach_m; its border is uneven."""

    middle_m: Sequence[float]
    bare_m: float
    reach_m: float
    share: float


def lay_strands(trodden: np.ndarray, grid: FineGrid, strands: Sequence[Strand], seed: int) -> None:
    """Raise the shares (cells, cells) of trodden ground along strands by the share of each cell that they cover."""
    for strand in strands:
        _lay_strand(trodden, grid, strand, seed)


def lay_halos(trodden: np.ndarray, grid: FineGrid, halos: Sequence[Halo], seed: int) -> None:
    """Raise the shares (cells, cells) of trodden ground in halos."""
    for halo in halos:
        (west, east), (south, north) = (_window(grid, at_m, halo.reach_m) for at_m in halo.middle_m)
        x_m, y_m = np.meshgrid(grid.middles_m[west:east], grid.middles_m[south:north])
        off_m = np.sqrt((x_m - halo.middle_m[0]) ** 2 + (y_m - halo.middle_m[1]) ** 2)
        off_m += _RAGGED * halo.reach_m * fractal_noise(seed, "halo", x_m, y_m, 1.2 * halo.reach_m, octaves=3)
        share = 1.0 - smooth((off_m - halo.bare_m) / (halo.reach_m - halo.bare_m))
        part = trodden[south:north, west:east]
        np.maximum(part, as_bytes(halo.share * share), out=part)


def _window(grid: FineGrid, at_m: float, reach_m: float) -> tuple[int, int]:
    """The first cell and the one after the last that a halo may reach along an axis."""
    reach_m *= 1.0 + _RAGGED
    low, high = ((at_m + side * reach_m) / grid.cell_m + 0.5 * grid.cells for side in (-1.0, 1.0))
    return max(0, int(np.floor(low))), max(0, min(grid.cells, int(np.ceil(high))))


def _lay_strand(trodden: np.ndarray, grid: FineGrid, strand: Strand, seed: int) -> None:
    step_m = _STEP_CELLS * grid.cell_m
    count = int(np.ceil(strand.curve.length_m / step_m)) + 1
    along = np.linspace(0.0, 1.0, count)
    at_m, heading = _wound(strand, along, seed)
    corners = np.linspace(0.0, 1.0, len(strand.share))
    half_m, share = (np.interp(along, corners, values) for values in (strand.half_width_m, strand.share))
    fray = fractal_noise(seed, f"{strand.name}/frayed", *at_m.T, _FRAYED_M, octaves=3)
    share = share * np.clip(1.0 - strand.frays * (0.3 - fray), 0.0, 1.0)
    _raster(trodden, grid, at_m, heading, half_m, share)


def _wound(strand: Strand, along: np.ndarray, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) of a strand and its headings (n, 2) there."""
    at_m, heading = strand.curve.at(along * strand.curve.length_m)
    if strand.wander_m > 0:
        noise = fractal_noise(seed, strand.name, *at_m.T, strand.wavelength_m, _OCTAVES)
        at_m = at_m + (strand.aside_m + strand.wander_m * noise)[:, None] * left_of(heading)
        step = (
            at_m[np.minimum(np.arange(len(at_m)) + 1, len(at_m) - 1)]
            - at_m[np.maximum(np.arange(len(at_m)) - 1, 0)]
        )
        length_m = np.sqrt(step[:, 0] * step[:, 0] + step[:, 1] * step[:, 1])
        return at_m, step / np.maximum(length_m, 1e-9)[:, None]
    return at_m + strand.aside_m * left_of(heading), heading


def _raster(
    trodden: np.ndarray,
    grid: FineGrid,
    at_m: np.ndarray,
    heading: np.ndarray,
    half_m: np.ndarray,
    share: np.ndarray,
) -> None:
    """Raise cells near points (n, 2) of a strip by the share of them that it covers, as if it ran along their sides."""
    first = np.floor(at_m / grid.cell_m + 0.5 * grid.cells).astype(np.int64)
    reach = int(np.ceil(half_m.max(initial=0.0) / grid.cell_m))
    half_cell_m = 0.5 * grid.cell_m
    for dx, dy in [(dx, dy) for dx in range(-reach, reach + 1) for dy in range(-reach, reach + 1)]:
        cell = first + (dx, dy)
        off_x, off_y = ((cell + 0.5 - 0.5 * grid.cells) * grid.cell_m - at_m).T
        ahead_m = np.abs(off_x * heading[:, 0] + off_y * heading[:, 1])
        aside_m = np.abs(off_x * heading[:, 1] - off_y * heading[:, 0])
        covered_m = np.minimum(aside_m + half_cell_m, half_m) - np.maximum(aside_m - half_cell_m, -half_m)
        near = (covered_m > 0) & (ahead_m < grid.cell_m)
        near &= ((cell >= 0) & (cell < grid.cells)).all(axis=1)
        place = cell[near, 1] * grid.cells + cell[near, 0]
        raise_to(trodden, place, as_bytes(share[near] * covered_m[near] / grid.cell_m))
