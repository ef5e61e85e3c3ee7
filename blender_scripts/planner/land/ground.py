"""The ground's mesh, refined near the road and cut along the borders of its covers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.triangles import edges_of, split_edges
from ..seen_ground import Seen, everywhere, sampled
from .covers import Layer
from .roads import SHOULDER_M
from .terrain import Terrain

_BORDER_EDGE_M = 0.8  # triangles at a border are halved until their edges are about this short
_COARSE = 1.5  # tolerance on that length, for the diagonal of a square of 0.8 m
# Largest edge on the road and its shoulders. The curvature of a track's cross-section is at most 1.25 / m: the middle
# of an edge of 0.36 m is off by 1.25 x 0.36^2 / 8 = 2 cm.
_ROAD_EDGE_M, _SHOULDER_EDGE_M = 0.36, 0.8


@dataclass(frozen=True)
class GroundMesh:
    """points_m (n, 3); triangles (m, 3) counter-clockwise from above; cover (m,), indices into `materials`."""

    points_m: np.ndarray
    triangles: np.ndarray
    cover: np.ndarray
    materials: tuple[str, ...]


def build_ground(terrain: Terrain, layers: Sequence[Layer], bare: str, seen: Seen = everywhere) -> GroundMesh:
    """The terrain's mesh, cut along the borders of layers; ground outside all layers is `bare`.

    Its shape is exactly that of `Terrain.height_m`, except on the road, where flat triangles approximate the tracks.
    Triangles without a corner that is seen stay as large as the terrain's cells: borders are then straight within a
    cell, and the road has no tracks.
    """
    points, triangles = _grid_mesh(terrain)
    points, triangles = _with_road(terrain, points, triangles, seen)
    cover = np.zeros(len(triangles), np.int8)
    for number, layer in enumerate(layers, start=1):
        points, triangles, cover = _laid(terrain, layer, number, points, triangles, cover, seen)
    materials = (bare, *(layer.material for layer in layers))
    return GroundMesh(points, triangles, cover, materials)


def _grid_mesh(terrain: Terrain) -> tuple[np.ndarray, np.ndarray]:
    """Two triangles per cell, split along the diagonal that `Terrain.height_m` uses for interpolation."""
    lines = terrain.heights_m.shape[0]
    x_m, y_m = terrain.grid()
    heights_m = terrain.heights_m if terrain.road is None else terrain.road.cut(terrain.heights_m, x_m, y_m)
    points = np.stack([x_m, y_m, heights_m], axis=-1).reshape(-1, 3)
    corner = np.arange(lines * lines, dtype=np.int32).reshape(lines, lines)
    p00, p10, p01, p11 = (corner[:-1, :-1], corner[:-1, 1:], corner[1:, :-1], corner[1:, 1:])
    lower, upper = np.stack([p00, p10, p11], axis=-1), np.stack([p00, p11, p01], axis=-1)
    return points, np.concatenate([lower.reshape(-1, 3), upper.reshape(-1, 3)])


def _with_road(
    terrain: Terrain, points: np.ndarray, triangles: np.ndarray, seen: Seen
) -> tuple[np.ndarray, np.ndarray]:
    """The mesh with triangles on and beside the road halved until they are small enough, where they are seen."""
    if terrain.road is None:
        return points, triangles
    off_m = terrain.road_m(points[:, 0], points[:, 1])
    is_seen = seen(points[:, 0], points[:, 1])
    while True:
        chosen = _coarse_on_road(points, triangles, off_m)
        chosen = chosen[_any_corner(is_seen, triangles[chosen])]
        if len(chosen) == 0:
            return points, triangles
        edges = edges_of(triangles[chosen])
        middles = _on_ground(terrain, points[edges].mean(axis=1))
        triangles, _ = split_edges(triangles, edges, len(points))
        points = np.concatenate([points, middles])
        off_m = np.concatenate([off_m, terrain.road_m(middles[:, 0], middles[:, 1])])
        is_seen = np.concatenate([is_seen, seen(middles[:, 0], middles[:, 1])])


def _coarse_on_road(points: np.ndarray, triangles: np.ndarray, off_m: np.ndarray) -> np.ndarray:
    """Indices of triangles near the road that are too large; off_m (n,) is the distance of each point to the road."""
    a, b, c = _at_corners(off_m, triangles)
    nearest_m = np.minimum(np.minimum(a, b), c)
    about = np.flatnonzero(np.isfinite(nearest_m))
    edge_m, nearest_m = _longest_m(points, triangles[about]), nearest_m[about]
    on_road = (nearest_m < 0.5 * edge_m) & (edge_m > _ROAD_EDGE_M)
    beside = (nearest_m < SHOULDER_M + edge_m) & (edge_m > _SHOULDER_EDGE_M)
    return about[on_road | beside]


def _laid(
    terrain: Terrain,
    layer: Layer,
    number: int,
    points: np.ndarray,
    triangles: np.ndarray,
    cover: np.ndarray,
    seen: Seen,
):
    """Points, triangles and covers after adding a layer, as `number`, on bare ground."""
    values, is_seen = _values(terrain, layer, points, seen), seen(points[:, 0], points[:, 1])
    for _ in range(max(0, round(np.log2(terrain.cell_m / _BORDER_EDGE_M)))):
        cut = triangles[_is_cut(values, triangles, cover) & _any_corner(is_seen, triangles)]
        edges = edges_of(cut[_longest_m(points, cut) > _COARSE * _BORDER_EDGE_M])
        middles = _on_ground(terrain, points[edges].mean(axis=1))
        triangles, parent = split_edges(triangles, edges, len(points))
        points, cover = np.concatenate([points, middles]), cover[parent]
        values = np.concatenate([values, layer.value(middles[:, 0], middles[:, 1])])
        is_seen = np.concatenate([is_seen, seen(middles[:, 0], middles[:, 1])])
    edges = edges_of(triangles[_is_cut(values, triangles, cover)])
    edges = edges[(values[edges[:, 0]] > 0) != (values[edges[:, 1]] > 0)]
    triangles, parent = split_edges(triangles, edges, len(points))
    points = np.concatenate([points, _crossings(points, values, edges)])
    values, cover = np.concatenate([values, np.zeros(len(edges))]), cover[parent]
    # No bare triangle has corners on both sides any more, so its highest value decides.
    is_laid = (cover == 0) & _any_corner(values > 0, triangles)
    return points, triangles, np.where(is_laid, np.int8(number), cover)


def _values(terrain: Terrain, layer: Layer, points: np.ndarray, seen: Seen) -> np.ndarray:
    """Values (n,) of a layer at points, of which those of the terrain's grid come first."""
    on_grid = sampled(layer.value, points[: len(terrain.heights_m), 0], seen).ravel()
    others = points[len(on_grid) :]
    return np.concatenate([on_grid, layer.value(others[:, 0], others[:, 1])])


def _is_cut(values: np.ndarray, triangles: np.ndarray, cover: np.ndarray) -> np.ndarray:
    """Which bare triangles a border runs through."""
    a, b, c = _at_corners(values > 0, triangles)
    return (cover == 0) & ((a != b) | (b != c))


def _any_corner(mask: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Which triangles (m,) have a corner of a mask (n,)."""
    a, b, c = _at_corners(mask, triangles)
    return a | b | c


def _longest_m(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Length (m,) of each triangle's longest edge, seen from above."""
    (ax, bx, cx), (ay, by, cy) = (_at_corners(along, triangles) for along in points.T[:2])
    sides = [(ax - cx, ay - cy), (bx - ax, by - ay), (cx - bx, cy - by)]
    return np.sqrt(np.maximum.reduce([dx**2 + dy**2 for dx, dy in sides]))


def _at_corners(values: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, ...]:
    """The values (n,) of points at the three corners (m,) of each triangle."""
    return tuple(values[corner] for corner in triangles.T)


def _on_ground(terrain: Terrain, points: np.ndarray) -> np.ndarray:
    """The points (n, 3) moved to the ground's height."""
    return np.column_stack([points[:, :2], terrain.height_m(points[:, 0], points[:, 1])])


def _crossings(points: np.ndarray, values: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Where the border crosses each edge, kept away from its ends so that no triangle degenerates."""
    start, end = values[edges[:, 0]], values[edges[:, 1]]
    share = np.clip(start / (start - end), 0.02, 0.98)[:, None]
    return points[edges[:, 0]] * (1 - share) + points[edges[:, 1]] * share
