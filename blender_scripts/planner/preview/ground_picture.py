"""A picture of a scene's ground from above: shaded relief, water, road and vegetation density."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..land.terrain import Terrain
from ..plants.density import DensityMap
from .colours import surface_colour

_OPEN, _MID, _DENSE = (226, 213, 176), (196, 197, 150), (146, 164, 116)
_STEEPER = 3.0  # exaggeration of relief: the true slopes of a savanna are too flat to see
_LIGHT = np.array([-0.5, 0.5, 0.70710678])  # from the north-west, 45 degrees high
_LEAST_MARGIN_M, _MARGIN = 15.0, 0.12


@dataclass(frozen=True)
class Window:
    """A square of the scene: its south-west corner and its side."""

    west_m: float
    south_m: float
    side_m: float


def whole_place(terrain: Terrain) -> Window:
    """The window that covers exactly the scene."""
    return Window(-0.5 * terrain.size_m, -0.5 * terrain.size_m, terrain.size_m)


def window_round(points_m: np.ndarray) -> Window:
    """A window that contains points (n, 2) and some ground around them."""
    low, high = points_m.min(axis=0), points_m.max(axis=0)
    reach_m = 0.5 * float((high - low).max())
    reach_m += max(_LEAST_MARGIN_M, _MARGIN * reach_m)
    west_m, south_m = 0.5 * (low + high) - reach_m
    return Window(float(west_m), float(south_m), 2.0 * reach_m)


def draw_ground(terrain: Terrain, areas: DensityMap, window: Window, side_px: int) -> np.ndarray:
    """Colours (side_px, side_px, 3), 8 bits, north up, sampled at the centres of pixels."""
    along_m = (np.arange(side_px) + 0.5) / side_px * window.side_m
    x_m, y_m = (grid.ravel() for grid in np.meshgrid(window.west_m + along_m, window.south_m + along_m[::-1]))
    colour = areas.shares(x_m, y_m) @ np.array([_OPEN, _MID, _DENSE], float)
    if terrain.crag is not None:
        colour = _blended(colour, surface_colour("rock"), terrain.crag.share(x_m, y_m))
    colour = _blended(colour, surface_colour("road"), terrain.road_m(x_m, y_m) < 0)
    colour *= _shade(terrain, x_m, y_m, window.side_m / side_px)[:, None]
    colour = _blended(colour, surface_colour("water"), terrain.shore_m(x_m, y_m) < 0)
    return np.clip(np.rint(colour), 0, 255).astype(np.uint8).reshape(side_px, side_px, 3)


def _blended(below: np.ndarray, above: str, share: np.ndarray) -> np.ndarray:
    """Colours (n, 3) blended with a colour #rrggbb of opacities (n,)."""
    rgb = np.array([int(above[k : k + 2], 16) for k in (1, 3, 5)], float)
    share = np.asarray(share, float)[:, None]
    return below + share * (rgb - below)


def _shade(terrain: Terrain, x_m: np.ndarray, y_m: np.ndarray, pixel_m: float) -> np.ndarray:
    """Brightness (n,) of relief lit from the side, 1 on level ground; slopes span at least a cell to hide the grid."""
    step = max(pixel_m, terrain.cell_m)
    east, north = (
        _STEEPER
        * (terrain.height_m(x_m + dx, y_m + dy) - terrain.height_m(x_m - dx, y_m - dy))
        / (2.0 * step)
        for dx, dy in ((step, 0.0), (0.0, step))
    )
    lit = (_LIGHT[2] - east * _LIGHT[0] - north * _LIGHT[1]) / np.sqrt(1.0 + east**2 + north**2)
    return np.clip(0.55 + 0.45 * lit / _LIGHT[2], 0.35, 1.25)
