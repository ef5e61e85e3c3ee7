"""Maps of the ground on the terrain's own grid: its height, its covers, and the distance to water."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..seen_ground import Seen, everywhere
from .covers import SOIL, Layer
from .fine_covers import FineCovers
from .ground import GroundMesh, build_ground
from .shares import as_bytes
from .terrain import Terrain


@dataclass(frozen=True)
class Ground:
    """The ground's mesh and its maps [row of y, column of x], from south and west, of n x n cells.

    height_m, shore_m (n + 1, n + 1): at the grid's lines; shore_m is the approximate distance to the nearest shoreline,
    negative in the water, or None without water. cover (materials, n, n): shares of each cell, of which 255 is all.
    fine: maps of a finer grid, once they are laid.
    """

    mesh: GroundMesh
    height_m: np.ndarray
    cover: np.ndarray
    shore_m: np.ndarray | None
    fine: FineCovers | None = None


def lay_ground(terrain: Terrain, layers: Sequence[Layer], seen: Seen = everywhere) -> Ground:
    """The ground of a terrain with its covers, fine where it is seen."""
    x_m, y_m = terrain.grid()
    mesh = build_ground(terrain, layers, SOIL, seen)
    return Ground(
        mesh=mesh,
        height_m=terrain.height_m(x_m, y_m).astype("<f4"),
        cover=_cover(terrain, mesh),
        shore_m=terrain.shore_m(x_m, y_m).astype("<f4") if terrain.waters else None,
    )


def _cover(terrain: Terrain, mesh: GroundMesh) -> np.ndarray:
    """Exact up to rounding: no triangle of the ground reaches beyond its cell."""
    cells = terrain.heights_m.shape[0] - 1
    (ax, bx, cx), (ay, by, cy) = (
        [along[corner] for corner in mesh.triangles.T] for along in mesh.points_m.T[:2]
    )
    area_m2 = 0.5 * np.abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
    column, row = (
        np.clip(((a + b + c) / (3.0 * terrain.cell_m) + 0.5 * cells).astype(np.int64), 0, cells - 1)
        for a, b, c in ((ax, bx, cx), (ay, by, cy))
    )
    count = len(mesh.materials)
    place = (mesh.cover.astype(np.int64) * cells + row) * cells + column
    sums = np.bincount(place, area_m2, minlength=count * cells * cells)
    return as_bytes(np.reshape(sums, (count, cells, cells)) / terrain.cell_m**2)
