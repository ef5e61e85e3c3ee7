"""Vegetation density: open plain, mid and dense areas."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..geometry.easing import smooth
from ..land.grey_images import read_density, sample
from ..land.terrain import Terrain
from ..noise import fractal_noise

_OCTAVES = 3
_LOWLAND = 0.6  # difference in lushness between lowest and highest ground; the noise is about +-1
_BORDER = 0.12  # of lushness, over which one area blends into the next
_GRID_M = 20.0
_MAP_BORDERS = 0.25, 0.75, 0.25  # start of mid, start of dense, width: black is open, grey mid, white dense


Lush = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class DensityMap:
    """Three areas with soft borders, defined by lushness, `lush` (x_m, y_m)."""

    lush: Lush
    mid_from: float
    dense_from: float
    border: float

    def shares(self, x_m, y_m) -> np.ndarray:
        """Shares (n, 3) of open, mid and dense at each position (n,); they sum to 1."""
        lush = self.lush(x_m, y_m)
        dense, not_open = (_rise((lush - least) / self.border) for least in (self.dense_from, self.mid_from))
        # Where two borders overlap, dense wins.
        return np.stack(
            [1.0 - np.maximum(not_open, dense), np.maximum(not_open - dense, 0.0), dense], axis=-1
        )


def plan_density(terrain: Terrain, settings: dict, seed: int) -> DensityMap:
    """The areas of a scene: from the user's map, or a third of the scene each, from its seed and its hills."""
    if "density_map" in settings:
        values = read_density(settings["density_map"], "scene.terrain.density_map")
        return DensityMap(lambda x_m, y_m: sample(values, terrain.size_m, x_m, y_m), *_MAP_BORDERS)
    wavelength_m = settings["area_wavelength_m"]

    def lush(x_m, y_m) -> np.ndarray:
        return _lushness(seed, terrain, wavelength_m, x_m, y_m)

    lines = max(2, round(terrain.size_m / _GRID_M))
    middle_m = ((np.arange(lines) + 0.5) / lines - 0.5) * terrain.size_m
    x_m, y_m = (grid.ravel() for grid in np.meshgrid(middle_m, middle_m))
    mid_from, dense_from = np.quantile(lush(x_m, y_m), [1.0 / 3.0, 2.0 / 3.0])
    return DensityMap(lush, float(mid_from), float(dense_from), _BORDER)


def _lushness(seed: int, terrain: Terrain, wavelength_m: float, x_m, y_m) -> np.ndarray:
    """Lushness: higher on low ground, where water gathers, plus noise."""
    low_m, high_m = terrain.smooth_m.min(), terrain.smooth_m.max()
    height = (terrain.smooth_surface_m(x_m, y_m) - low_m) / max(high_m - low_m, 1e-9)
    return fractal_noise(seed, "areas", x_m, y_m, wavelength_m, _OCTAVES) - _LOWLAND * height


def _rise(above: np.ndarray) -> np.ndarray:
    """A smooth step from 0 to 1 across a border; `above` is in widths of the border."""
    return smooth(0.5 + above)
