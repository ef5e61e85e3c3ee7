"""Flat shapes of a map: bands, discs and boxes in the plane z = 0, facing up. Lengths in m."""

from __future__ import annotations

import numpy as np

from ..geometry.rotations import left_of
from ..geometry.shapes import Mesh, facets

_DISC_CORNERS = 24


def band(points_m: np.ndarray, width_m: float) -> Mesh:
    """A band along points (n, 2), n >= 2; closed if it ends where it begins."""
    along = np.diff(points_m, axis=0)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    closed = np.array_equal(points_m[0], points_m[-1])
    before = np.concatenate([along[-1:] if closed else along[:1], along])
    after = np.concatenate([along, along[:1] if closed else along[-1:]])
    direction = before + after
    direction /= np.maximum(np.linalg.norm(direction, axis=1, keepdims=True), 1e-12)
    side = 0.5 * width_m * left_of(direction)
    count = len(points_m)
    k = np.arange(count - 1)
    right, left = k, k + count
    triangles = np.concatenate(
        [np.stack([right, right + 1, left + 1], axis=1), np.stack([right, left + 1, left], axis=1)]
    )
    return facets(_lifted(np.concatenate([points_m - side, points_m + side])), triangles)


def disc(centre_m, radius_m: float) -> Mesh:
    """A disc around a point (x, y)."""
    angle = 2.0 * np.pi * np.arange(_DISC_CORNERS) / _DISC_CORNERS
    rim = np.asarray(centre_m) + radius_m * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    fan = [[0, k, k + 1] for k in range(1, _DISC_CORNERS - 1)]
    return facets(_lifted(rim), np.array(fan))


def polygon(corners_m) -> Mesh:
    """A convex polygon with corners (n, 2), counter-clockwise."""
    corners_m = np.asarray(corners_m, float)
    return facets(_lifted(corners_m), np.array([[0, k, k + 1] for k in range(1, len(corners_m) - 1)]))


def box(x0_m: float, y0_m: float, x1_m: float, y1_m: float) -> Mesh:
    """An upright rectangle."""
    return polygon([[x0_m, y0_m], [x1_m, y0_m], [x1_m, y1_m], [x0_m, y1_m]])


def boxes(lower_m: np.ndarray, upper_m: np.ndarray) -> Mesh:
    """Upright rectangles by their lower left and upper right corners (n, 2)."""
    (x0, y0), (x1, y1) = lower_m.T, upper_m.T
    corners = [np.stack(corner, axis=1) for corner in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
    first = 4 * np.arange(len(lower_m))[:, None]
    return facets(
        _lifted(np.stack(corners, axis=1).reshape(-1, 2)),
        np.concatenate([first + [0, 1, 2], first + [0, 2, 3]]),
    )


def filled(cells: np.ndarray, origin_m: float, side_m: float) -> Mesh:
    """Boxes for the true cells of a grid [row of y, column of x], one for each run in a row.

    The grid begins at origin_m in x and y.
    """
    edges = np.diff(np.pad(cells.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    row, begin = np.nonzero(edges == 1)
    end = np.nonzero(edges == -1)[1]  # in the same order: row by row, run by run
    lower, upper = np.stack([begin, row], axis=1), np.stack([end, row + 1], axis=1)
    return boxes(origin_m + side_m * lower, origin_m + side_m * upper)


def _lifted(points_m: np.ndarray) -> np.ndarray:
    return np.column_stack([points_m, np.zeros(len(points_m))])
