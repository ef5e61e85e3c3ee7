"""The ground's shape: a square heightfield of hills with a water hole in the middle.

Axes: x east, y north, z up, metres, origin in the middle of the place at height 0 of the datum.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .noise import fractal_noise

_HILL_OCTAVES = 5
_SHORE_RAGGEDNESS = 0.45  # of the water radius: how far the shoreline wanders
_BASIN_REACH = 2.5  # water radii over which hills give way to the basin
_BANK_M = 0.4  # the basin's rim stands this much above the water
_SMOOTHING_M = 40.0  # of the ground a drone's height is kept above


@dataclass(frozen=True)
class Water:
    """A still sheet: the height of its surface, and a disc that holds all of it and no other ground as low."""

    level_m: float
    disc_radius_m: float


@dataclass(frozen=True)
class Terrain:
    """Heights on a square grid, [row of y, column of x], from -size/2 to size/2; between them the mesh's triangles."""

    seed: int
    size_m: float
    cell_m: float
    heights_m: np.ndarray
    smooth_m: np.ndarray
    water_radius_m: float
    water: Water | None

    def height_m(self, x_m, y_m) -> np.ndarray:
        """Height of the ground mesh at (x, y), exactly; past the border the border's height goes on."""
        return self._triangle_height(self.heights_m, x_m, y_m)

    def surface_m(self, x_m, y_m) -> np.ndarray:
        """Height of ground or water, whichever is on top."""
        return _surface(self.height_m(x_m, y_m), self.shore_m(x_m, y_m), self.water)

    def smooth_surface_m(self, x_m, y_m) -> np.ndarray:
        """Surface smoothed by a Gaussian of 40 m: what a drone that holds its height above ground follows."""
        return self._triangle_height(self.smooth_m, x_m, y_m)

    def shore_m(self, x_m, y_m) -> np.ndarray:
        """About the distance to the shoreline, negative in the water; infinite where there is none."""
        return _shore(self.seed, self.water_radius_m, x_m, y_m)

    def _triangle_height(self, heights_m: np.ndarray, x_m, y_m) -> np.ndarray:
        cells = heights_m.shape[0] - 1
        column, u = _cell(np.asarray(x_m, float), self.size_m, cells)
        row, v = _cell(np.asarray(y_m, float), self.size_m, cells)
        h00, h10 = heights_m[row, column], heights_m[row, column + 1]
        h01, h11 = heights_m[row + 1, column], heights_m[row + 1, column + 1]
        return np.where(
            u >= v, h00 + u * (h10 - h00) + v * (h11 - h10), h00 + v * (h01 - h00) + u * (h11 - h01)
        )


def build_terrain(settings: dict, seed: int) -> Terrain:
    """The terrain of `scene.terrain`; cells are stretched a little so that a whole number fits."""
    size_m = settings["size_m"]
    cells = max(1, round(size_m / settings["cell_m"]))
    x_m, y_m = np.meshgrid(grid_axis(size_m, cells), grid_axis(size_m, cells))
    hills_m = _hills(settings, seed, x_m, y_m)
    radius_m = settings["water_radius_m"]
    shore_m = _shore(seed, radius_m, x_m, y_m)
    water = _water(hills_m, shore_m, radius_m)
    heights_m = _with_basin(hills_m, shore_m, radius_m, water)
    smooth_m = _smoothed(_surface(heights_m, shore_m, water), _SMOOTHING_M / (size_m / cells))
    return Terrain(seed, size_m, size_m / cells, heights_m, smooth_m, radius_m, water)


def grid_axis(size_m: float, cells: int) -> np.ndarray:
    """Coordinates of the grid lines, shape (cells + 1,)."""
    return (np.arange(cells + 1) / cells - 0.5) * size_m


def _cell(along_m: np.ndarray, size_m: float, cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Cell number and place in it, 0..1, clamped to the grid."""
    place = np.clip((along_m / size_m + 0.5) * cells, 0.0, cells)
    cell = np.minimum(place.astype(np.int64), cells - 1)
    return cell, place - cell


def _hills(settings: dict, seed: int, x_m, y_m) -> np.ndarray:
    """Fractal hills whose lowest and highest points are relief_m apart, with mean height 0."""
    raw = fractal_noise(seed, "hills", x_m, y_m, settings["hill_wavelength_m"], _HILL_OCTAVES, gain=0.42)
    span = raw.max() - raw.min()
    return (raw - raw.mean()) * (settings["relief_m"] / span if span > 0 else 0.0)


def _shore(seed: int, radius_m: float, x_m, y_m) -> np.ndarray:
    x_m, y_m = np.asarray(x_m, float), np.asarray(y_m, float)
    if radius_m <= 0:
        return np.full(np.broadcast(x_m, y_m).shape, np.inf)
    wander = fractal_noise(seed, "shore", x_m, y_m, 1.3 * radius_m, octaves=3)
    return np.sqrt(x_m**2 + y_m**2) + _SHORE_RAGGEDNESS * radius_m * wander - radius_m


def _water(hills_m: np.ndarray, shore_m: np.ndarray, radius_m: float) -> Water | None:
    """A level under all the ground that the basin blends into, so that beyond the shoreline no ground lies below it."""
    if radius_m <= 0:
        return None
    # On a coarse grid the basin may lie between all vertices; then the nearest ones stand for it.
    around = shore_m <= max((_BASIN_REACH - 1) * radius_m, shore_m.min())
    return Water(float(hills_m[around].min()) - _BANK_M, (1 + 1.2 * _SHORE_RAGGEDNESS) * radius_m)


def _with_basin(hills_m, shore_m, radius_m: float, water: Water | None) -> np.ndarray:
    """Hills, blended within _BASIN_REACH radii into a bowl that crosses the water level at the shoreline."""
    if water is None:
        return hills_m
    out = shore_m / radius_m
    depth_m = min(4.0, 0.1 * radius_m)
    bowl_m = water.level_m + depth_m * np.clip(out, -1.0, 1.0) * (1.0 + 0.5 * np.clip(out, 0.0, 1.0))
    t = np.clip(out / (_BASIN_REACH - 1), 0.0, 1.0)
    return bowl_m + t * t * (3.0 - 2.0 * t) * (hills_m - bowl_m)


def _surface(heights_m, shore_m, water: Water | None) -> np.ndarray:
    """Water covers ground lower than its level, but only inside its own basin."""
    if water is None:
        return heights_m
    return np.where(shore_m < 0, np.maximum(heights_m, water.level_m), heights_m)


def _smoothed(heights_m: np.ndarray, sigma_cells: float) -> np.ndarray:
    """Separable Gaussian, truncated at 3 sigma or the grid's own size, borders extended."""
    reach = min(int(3 * sigma_cells) + 1, heights_m.shape[0])
    taps = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma_cells) ** 2)
    taps /= taps.sum()
    for _ in range(2):  # the second turn transposes back
        padded = np.pad(heights_m, ((reach, reach), (0, 0)), mode="edge")
        rows = heights_m.shape[0]
        heights_m = sum(tap * padded[k : k + rows] for k, tap in enumerate(taps)).T
    return heights_m
