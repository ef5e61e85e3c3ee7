"""Fine maps of the ground: the topmost cover, and shares of grass, ash and trodden ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..geometry.easing import smooth
from ..noise import fractal_noise
from .covers import GRASS, Layer, Value
from .fine_grid import FineGrid, blurred
from .shares import as_bytes
from .terrain import Terrain

BORDER_CELLS = 1.5  # largest known distance to a border

# Shares of grass over the value of its layer, whose unit is about a patch's size; estimates. Far from their borders,
# bare soil and grass are even.
_GRASS_AT, _GRASS_SHARES = (-0.5, -0.15, -0.07, 0.07, 0.15, 0.5), (0.0, 0.08, 0.22, 0.78, 0.92, 0.99)
_STEEP = 0.75  # a layer's border is searched where its value is below this share of the difference to its neighbours

_BURNT_M = 15.0  # size of burnt patches; estimate
_BURNT_GAIN = 0.6
_WIDE_OCTAVES, _FINE_OCTAVES = 3, 3  # evaluated on the lattice, and only where they matter
_BURNT_BORDER = 0.06  # of the noise, to each side of a patch's border: about half a metre
_HALVINGS = 24


@dataclass(frozen=True)
class FineCovers:
    """Maps (cells, cells) of bytes on the fine grid.

    kind: number of the topmost cover, 0 for soil, also where grass is on top. border: distance from a cell's middle to
    the border of its kind, of which 255 is BORDER_CELLS or more. grass, trodden, ash: shares, of which 255 is all;
    grass and ash are 0 where kind is not.
    """

    kind: np.ndarray
    border: np.ndarray
    grass: np.ndarray
    trodden: np.ndarray
    ash: np.ndarray


def lay_kinds(grid: FineGrid, layers: Sequence[Layer]) -> tuple[np.ndarray, np.ndarray]:
    """The number (cells, cells) of the first of the layers at the middle of each cell, from 1; 0 for soil and grass.
    Also the distance to the border of that kind, see FineCovers.
    """
    kinds = np.zeros((grid.cells, grid.cells), np.uint8)
    border = np.full_like(kinds, 255)
    for number, layer in reversed(list(enumerate(layers, start=1))):
        if layer.material != GRASS:
            _lay(kinds, border, number, grid, layer.value)
    return kinds, border


def lay_grass(grid: FineGrid, layers: Sequence[Layer], kinds: np.ndarray) -> np.ndarray:
    """Shares under grass: a ramp across the borders of the grass, averaged over some metres."""
    values = [layer.value for layer in layers if layer.material == GRASS]
    if not values:
        return np.zeros_like(kinds)
    value = np.maximum.reduce([grid.sampled(value) for value in values])
    share = np.interp(value, _GRASS_AT, _GRASS_SHARES)
    return refined_bytes(grid, blurred(share), kinds == 0)


def lay_ash(
    grid: FineGrid,
    terrain: Terrain,
    layers: Sequence[Layer],
    fraction: float,
    kinds: np.ndarray,
    seed: int,
) -> np.ndarray:
    """Shares under ash: patches with ragged borders on a fraction of the dry ground, off other covers."""
    x_m, y_m = terrain.samples()
    dry = terrain.shore_m(x_m, y_m, 0.0) > 0
    can_burn = dry.copy()
    for layer in layers:
        if layer.material != GRASS:
            can_burn &= layer.value(x_m, y_m) <= 0
    if fraction <= 0 or not can_burn.any():
        return np.zeros_like(kinds)
    wanted = fraction * np.count_nonzero(dry) / np.count_nonzero(can_burn)
    values = _wide(seed, x_m[can_burn], y_m[can_burn])
    threshold = _threshold(values + _fine(seed, x_m[can_burn], y_m[can_burn]), min(wanted, 1.0))
    wide = grid.sampled(partial(_wide, seed)) - threshold
    ash = np.zeros_like(kinds)
    for rows in grid.blocks():
        ash[rows] = as_bytes(_burnt(seed, grid, wide, rows))
    ash[kinds != 0] = 0
    return ash


def refined_bytes(grid: FineGrid, share: np.ndarray, where: np.ndarray) -> np.ndarray:
    """Shares (lines, lines) of the lattice as bytes on the fine grid, 0 except `where` (cells, cells)."""
    fine = np.zeros((grid.cells, grid.cells), np.uint8)
    for rows in grid.blocks():
        fine[rows] = as_bytes(grid.refined(share, rows)) * where[rows]
    return fine


def _lay(kinds: np.ndarray, border: np.ndarray, number: int, grid: FineGrid, value: Value) -> None:
    """Set the cells in which a layer's value is positive; far from its borders, its sign on the lattice decides."""
    at_lattice = grid.sampled(value)
    low, _ = grid.below
    inside, unsure = at_lattice > 0, _near_border(at_lattice) & grid.seen_squares
    around = np.full((grid.cells + 2, grid.cells + 2), np.nan, np.float32)  # with a rim
    fine = around[1:-1, 1:-1]
    for rows in grid.blocks():
        row, column = np.nonzero(unsure[low[rows]][:, low])
        fine[rows][row, column] = value(grid.middles_m[column], grid.middles_m[rows][row])
    for rows in grid.blocks():
        laid = inside[low[rows]][:, low]
        row, column = np.nonzero(np.isfinite(fine[rows]))
        laid[row, column] = fine[rows][row, column] > 0
        kinds[rows][laid] = number
        border[rows][laid] = 255
        off = as_bytes(_cells_off(around, rows.start + row + 1, column + 1) / BORDER_CELLS)
        border[rows][row, column] = np.minimum(border[rows][row, column], off)


def _cells_off(value: np.ndarray, row: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Distance (n,) of cells to the zero crossing of a value: the value over its gradient to their neighbours, some of
    which may be unknown, NaN.
    """
    at = value[row, column]
    square = np.zeros_like(at)
    for down, right in ((1, 0), (0, 1)):
        before, after = value[row - down, column - right], value[row + down, column + right]
        known = np.isfinite(before).astype(np.float32) + np.isfinite(after)
        step = np.where(np.isfinite(after), after, at) - np.where(np.isfinite(before), before, at)
        square += (step / np.maximum(known, 1.0)) ** 2
    return np.abs(at) / np.sqrt(np.maximum(square, 1e-12))


def _near_border(value: np.ndarray) -> np.ndarray:
    """Mask (lines - 1, lines - 1) of the lattice's squares that a border may cross: those around points at which the
    value is small against its change to the neighbours, and adjacent ones.
    """
    step = np.zeros(value.shape)
    for axis in (0, 1):
        change = np.abs(np.diff(value, axis=axis))
        before, after = [(0, 0), (0, 0)], [(0, 0), (0, 0)]
        before[axis], after[axis] = (1, 0), (0, 1)
        step = np.maximum(step, np.maximum(np.pad(change, before), np.pad(change, after)))
    small = np.pad(np.abs(value) < _STEEP * step, 1)
    count = len(value) - 1
    near = np.zeros((count, count), bool)
    for row in range(4):
        for column in range(4):
            near |= small[row : row + count, column : column + count]
    return near


def _wide(seed: int, x_m, y_m) -> np.ndarray:
    """The noise of burnt patches without its finest octaves; scars are clustered."""
    return 1.6 * fractal_noise(seed, "burnt/area", x_m, y_m, 20.0 * _BURNT_M, 2) + fractal_noise(
        seed, "burnt", x_m, y_m, 4.0 * _BURNT_M, _WIDE_OCTAVES, _BURNT_GAIN
    )


def _fine(seed: int, x_m, y_m) -> np.ndarray:
    wavelength_m = 4.0 * _BURNT_M / 2**_WIDE_OCTAVES
    return _BURNT_GAIN**_WIDE_OCTAVES * fractal_noise(
        seed, "burnt/fine", x_m, y_m, wavelength_m, _FINE_OCTAVES, _BURNT_GAIN
    )


def _threshold(values: np.ndarray, wanted: float) -> float:
    """The threshold that gives the wanted mean share of ash."""
    low, high = float(values.min()) - _BURNT_BORDER, float(values.max()) + _BURNT_BORDER
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _ash_share(values - middle).mean() > wanted else (low, middle)
    return 0.5 * (low + high)


def _ash_share(above: np.ndarray) -> np.ndarray:
    return smooth(0.5 + 0.5 * above / _BURNT_BORDER)


def _burnt(seed: int, grid: FineGrid, wide: np.ndarray, rows: slice) -> np.ndarray:
    """Shares of some rows; the finest octaves are added where they matter."""
    above = grid.refined(wide, rows)
    most = _BURNT_GAIN**_WIDE_OCTAVES * sum(_BURNT_GAIN**k for k in range(_FINE_OCTAVES))
    low, _ = grid.below
    is_seen = grid.seen_squares[low[rows]][:, low]
    row, column = np.nonzero((np.abs(above) < most + _BURNT_BORDER) & is_seen)
    above[row, column] += _fine(seed, grid.middles_m[column], grid.middles_m[rows][row])
    return _ash_share(above)
