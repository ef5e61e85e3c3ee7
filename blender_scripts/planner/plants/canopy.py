"""Share of the ground below the crowns of plants."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from .. import assets
from ..land.shares import as_bytes
from ..land.terrain import Terrain
from .placement import Planting

_DOTS_M = 1.0  # largest distance between sample points of crowns


def canopy(terrain: Terrain, plantings: Mapping[str, Planting]) -> np.ndarray:
    """Shares (n, n) of the cells of a terrain's grid below crowns, of which 255 is all."""
    cells = terrain.heights_m.shape[0] - 1
    per_cell = int(np.ceil(terrain.cell_m / _DOTS_M))
    dot_m = terrain.cell_m / per_cell
    shaded = np.zeros((cells * per_cell, cells * per_cell), bool)
    for name, planting in plantings.items():
        radius_m = planting.scale * np.sqrt(assets.standing(name)["cover_m2"] / np.pi)
        _mark_discs(shaded, planting.points_m[:, :2] / dot_m + 0.5 * len(shaded), radius_m / dot_m)
    return as_bytes(np.reshape(shaded, (cells, per_cell, cells, per_cell)).mean(axis=(1, 3)))


def _mark_discs(marked: np.ndarray, centres: np.ndarray, radii: np.ndarray) -> None:
    """Mark the squares whose middles lie in discs; all in squares' sides, centres (n, 2) from the grid's corner."""
    reach = int(np.ceil(radii.max(initial=0.0))) + 1
    first = np.floor(centres).astype(np.int64)
    steps = range(-reach, reach + 1)
    for dx, dy in [(dx, dy) for dx in steps for dy in steps if np.hypot(dx, dy) < reach + 1]:
        column, row = first[:, 0] + dx, first[:, 1] + dy
        inside = (column + 0.5 - centres[:, 0]) ** 2 + (row + 0.5 - centres[:, 1]) ** 2 < radii**2
        inside &= (np.minimum(column, row) >= 0) & (np.maximum(column, row) < len(marked))
        marked[row[inside], column[inside]] = True
