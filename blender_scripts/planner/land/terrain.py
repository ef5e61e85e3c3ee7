"""The terrain: hills, hollows, gullies and a crag on a square grid, still water, and a road cut in.

Axes: x east, y north, z up, in metres, with the origin in the centre of the scene at height 0 of the datum.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .drainage import carve, plan_drainage
from .grey_images import read_height_shares, sample
from .relief import Crag, hills_m, hollows_m, plan_crag
from .roads import Road
from .waters import REACH, Basin, Water, lay_water, nearest_shore_m, surface_m

_SMOOTHING_M = 40.0  # smoothing that separates high land from low land
_PAN_APART = 5.0  # least distance of the pan from the middle, in radii of both waters
_PAN_GRID_M = 25.0
_SLOPE_STEP_M = 1.0
_SAMPLES = 400  # along a side: a share of them has a standard error below 0.0013


@dataclass(frozen=True)
class Terrain:
    """Heights on a square grid, [row of y, column of x], from -size/2 to size/2, interpolated on the mesh's triangles.

    The road is finer than the grid and cut in afterwards; on it, heights are those of the road.
    """

    seed: int
    size_m: float
    cell_m: float
    heights_m: np.ndarray
    smooth_m: np.ndarray
    waters: tuple[Water, ...]
    crag: Crag | None
    road: Road | None = None

    @cached_property
    def range_m(self) -> tuple[float, float]:
        """Minimum and maximum height of the ground, up to rounding; with the road's bounds."""
        heights = [self.heights_m, *([] if self.road is None else self.road.heights_m)]
        return min(float(h.min()) for h in heights), max(float(h.max()) for h in heights)

    def grid(self) -> tuple[np.ndarray, np.ndarray]:
        """x_m and y_m (n + 1, n + 1) where the lines of the grid cross."""
        return _grid(self.size_m, self.heights_m.shape[0] - 1)

    def samples(self) -> tuple[np.ndarray, np.ndarray]:
        """x_m and y_m (n, n) of points of the grid, evenly chosen: enough to find shares and thresholds."""
        step = int(np.ceil(self.heights_m.shape[0] / _SAMPLES))
        return tuple(along_m[::step, ::step] for along_m in self.grid())

    def height_m(self, x_m, y_m) -> np.ndarray:
        """Height of the ground at (x, y); positions beyond the border are clamped to it.

        Exactly the height of the ground's mesh, and within 3 cm of it on the road.
        """
        height = self._triangle_height(self.heights_m, x_m, y_m)
        return height if self.road is None else self.road.cut(height, x_m, y_m)

    def surface_m(self, x_m, y_m) -> np.ndarray:
        """Height of ground or water, whichever is higher."""
        return surface_m(self.height_m(x_m, y_m), self.waters, x_m, y_m)

    def smooth_surface_m(self, x_m, y_m) -> np.ndarray:
        """The surface smoothed by a Gaussian of 40 m, which separates low land from high land."""
        return self._triangle_height(self.smooth_m, x_m, y_m)

    def shore_m(self, x_m, y_m, within_m: float = np.inf) -> np.ndarray:
        """Approximate distance to the nearest shoreline, negative in the water; infinite if there is none within_m."""
        return nearest_shore_m(self.waters, x_m, y_m, within_m)

    def road_m(self, x_m, y_m) -> np.ndarray:
        """Distance (n,) to the road's border, negative on it; infinite far from it, or if there is no road."""
        return np.full(np.shape(x_m), np.inf) if self.road is None else self.road.distance_m(x_m, y_m)

    def with_road(self, road: Road | None) -> Terrain:
        """The terrain with a road cut in."""
        return replace(self, road=road)

    def _triangle_height(self, heights_m: np.ndarray, x_m, y_m) -> np.ndarray:
        cells = heights_m.shape[0] - 1
        column, u = _cell(np.asarray(x_m, float), self.size_m, cells)
        row, v = _cell(np.asarray(y_m, float), self.size_m, cells)
        flat_m, place = heights_m.ravel(), row * (cells + 1) + column
        h00, h10 = flat_m.take(place), flat_m.take(place + 1)
        h01, h11 = flat_m.take(place + cells + 1), flat_m.take(place + cells + 2)
        return np.where(
            u >= v, h00 + u * (h10 - h00) + v * (h11 - h10), h00 + v * (h01 - h00) + u * (h11 - h01)
        )


def build_terrain(settings: dict, seed: int) -> Terrain:
    """The terrain of `scene.terrain`, without its road; cells are stretched slightly so that a whole number fits."""
    size_m = settings["size_m"]
    cells = max(1, round(size_m / settings["cell_m"]))
    x_m, y_m = _grid(size_m, cells)
    crag, land_m = _land(settings, seed, x_m, y_m)
    is_crag = np.zeros(land_m.shape, bool) if crag is None else crag.share(x_m, y_m) > 0
    basins = _plan_basins(settings, seed, np.where(is_crag, np.inf, land_m), x_m, y_m)
    land_m = _drained(settings, seed, land_m, basins, x_m, y_m)
    waters = []
    for basin in basins:
        water, land_m = lay_water(basin, land_m, x_m, y_m)
        waters.append(water)
    surface = surface_m(land_m, tuple(waters), x_m, y_m)
    smooth_m = np.ascontiguousarray(_smoothed(surface, _SMOOTHING_M / (size_m / cells)))
    return Terrain(seed, size_m, size_m / cells, np.ascontiguousarray(land_m), smooth_m, tuple(waters), crag)


def _grid(size_m: float, cells: int) -> tuple[np.ndarray, np.ndarray]:
    axis_m = (np.arange(cells + 1) / cells - 0.5) * size_m
    return tuple(np.meshgrid(axis_m, axis_m))


def slope_deg(terrain: Terrain, x_m, y_m, step: float = _SLOPE_STEP_M) -> np.ndarray:
    """Slope of the ground at a position, from central differences over `step` metres to each side."""
    dx = terrain.height_m(x_m + step, y_m) - terrain.height_m(x_m - step, y_m)
    dy = terrain.height_m(x_m, y_m + step) - terrain.height_m(x_m, y_m - step)
    return np.degrees(np.arctan(np.sqrt(dx * dx + dy * dy) / (2.0 * step)))


def _cell(along_m: np.ndarray, size_m: float, cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Cell index and position in the cell, 0..1, clamped to the grid."""
    place = np.clip((along_m / size_m + 0.5) * cells, 0.0, cells)
    cell = np.minimum(place.astype(np.int64), cells - 1)
    return cell, place - cell


def _land(settings: dict, seed: int, x_m, y_m) -> tuple[Crag | None, np.ndarray]:
    """The crag, and the land's heights before water is added: from the user's map or from the seed."""
    if "heightmap" in settings:
        share = read_height_shares(settings["heightmap"], "scene.terrain.heightmap")
        low_m, high_m = settings["heightmap"]["height_m"]
        return None, low_m + (high_m - low_m) * sample(share, settings["size_m"], x_m, y_m)
    crag = plan_crag(settings, seed, x_m, y_m)
    land_m = hills_m(settings, seed, x_m, y_m) + hollows_m(settings["hollow_depth_m"], seed, x_m, y_m)
    return crag, land_m if crag is None else land_m + crag.height_m(x_m, y_m)


def _plan_basins(settings: dict, seed: int, land_m: np.ndarray, x_m, y_m) -> list[Basin]:
    """The water hole in the centre, and the pan; land_m is infinite where a pan is not allowed."""
    radius_m, pan_m = settings["water_radius_m"], settings["pan_radius_m"]
    basins = [Basin(seed, "shore", (0.0, 0.0), radius_m)] if radius_m > 0 else []
    if pan_m > 0:
        centre_m = _lowest_place(settings, land_m, x_m, y_m)
        basins += [Basin(seed, "pan", centre_m, pan_m)] if centre_m is not None else []
    return basins


def _lowest_place(settings: dict, land_m: np.ndarray, x_m, y_m) -> tuple[float, float] | None:
    """The position of the pan: low ground, well inside the scene and well away from the centre."""
    reach_m = REACH * settings["pan_radius_m"]
    step = max(1, round(_PAN_GRID_M / (x_m[0, 1] - x_m[0, 0])))
    x_m, y_m, land_m = (grid[::step, ::step] for grid in (x_m, y_m, land_m))
    inside = np.maximum(np.abs(x_m), np.abs(y_m)) < 0.5 * settings["size_m"] - reach_m
    apart_m = _PAN_APART * (settings["pan_radius_m"] + settings["water_radius_m"])
    fit = inside & (np.hypot(x_m, y_m) > apart_m)
    fit &= np.isfinite(land_m)
    if not fit.any():
        return None
    place = np.where(fit, land_m, np.inf).argmin()
    return float(x_m.ravel()[place]), float(y_m.ravel()[place])


def _drained(settings: dict, seed: int, land_m: np.ndarray, basins: Sequence[Basin], x_m, y_m) -> np.ndarray:
    """The land with gullies that drain to the waters and the borders."""
    if settings["gully_depth_m"] <= 0:
        return land_m
    is_sink = np.zeros(land_m.shape, bool)
    for basin in basins:
        is_sink |= basin.is_wet(x_m, y_m)
    return carve(
        land_m,
        settings["size_m"],
        plan_drainage(land_m, settings["size_m"], is_sink, seed),
        settings["gully_depth_m"],
    )


def _smoothed(heights_m: np.ndarray, sigma_cells: float) -> np.ndarray:
    """Separable Gaussian filter, truncated at 3 sigma or the size of the grid, with borders extended."""
    reach = min(int(3 * sigma_cells) + 1, heights_m.shape[0])
    taps = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma_cells) ** 2)
    taps /= taps.sum()
    for _ in range(2):  # the second turn transposes back
        padded = np.pad(heights_m, ((reach, reach), (0, 0)), mode="edge")
        rows = heights_m.shape[0]
        heights_m = sum(tap * padded[k : k + rows] for k, tap in enumerate(taps)).T
    return heights_m
