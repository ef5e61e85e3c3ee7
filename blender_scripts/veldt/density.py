"""Which parts of the place are open plain, which are mid and which dense with plants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .noise import fractal_noise
from .terrain import Terrain

_OCTAVES = 3
_LOWLAND = 0.6  # how much lusher the lowest ground is than the highest, against the noise's about +-1
_BORDER = 0.12  # of lushness, over which one area gives way to the next
_GRID_M = 20.0


@dataclass(frozen=True)
class DensityMap:
    """Three areas of about a third of the place each, with soft borders: the lusher a place, the denser it is grown."""

    seed: int
    terrain: Terrain
    wavelength_m: float
    mid_from: float
    dense_from: float

    def shares(self, x_m, y_m) -> np.ndarray:
        """How much (n, 3) of each place (n,) is open, mid and dense; in sum 1."""
        lush = _lushness(self.seed, self.terrain, self.wavelength_m, x_m, y_m)
        dense, not_open = _rise(lush - self.dense_from), _rise(lush - self.mid_from)
        # Where two borders run into each other, dense wins.
        return np.stack(
            [1.0 - np.maximum(not_open, dense), np.maximum(not_open - dense, 0.0), dense], axis=-1
        )


def plan_density(terrain: Terrain, settings: dict, seed: int) -> DensityMap:
    """The areas of a place; where they lie depends on its seed and its hills."""
    wavelength_m = settings["area_wavelength_m"]
    lines = max(2, round(terrain.size_m / _GRID_M))
    middle_m = ((np.arange(lines) + 0.5) / lines - 0.5) * terrain.size_m
    x_m, y_m = (grid.ravel() for grid in np.meshgrid(middle_m, middle_m))
    lush = _lushness(seed, terrain, wavelength_m, x_m, y_m)
    mid_from, dense_from = np.quantile(lush, [1.0 / 3.0, 2.0 / 3.0])
    return DensityMap(seed, terrain, wavelength_m, float(mid_from), float(dense_from))


def _lushness(seed: int, terrain: Terrain, wavelength_m: float, x_m, y_m) -> np.ndarray:
    """Water gathers in low ground; the rest is up to chance."""
    low_m, high_m = terrain.smooth_m.min(), terrain.smooth_m.max()
    height = (terrain.smooth_surface_m(x_m, y_m) - low_m) / max(high_m - low_m, 1e-9)
    return fractal_noise(seed, "areas", x_m, y_m, wavelength_m, _OCTAVES) - _LOWLAND * height


def _rise(above: np.ndarray) -> np.ndarray:
    """From 0 to 1 across a border, smoothly."""
    t = np.clip(0.5 + above / _BORDER, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
