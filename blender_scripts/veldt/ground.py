"""The ground's mesh, cut into soil and grass along smooth borders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .noise import fractal_noise
from .terrain import Terrain, grid_axis

SOIL, GRASS = 0, 1

_COVER_OCTAVES = 5
_WET_MARGIN_M = 5.0  # of bare soil round the water
_BORDER_EDGE_M = 0.8  # triangles at a border are halved until their edges are about this short


@dataclass(frozen=True)
class Cover:
    """What grows on the ground: grass where `value` is positive, soil elsewhere."""

    seed: int
    patch_m: float
    threshold: float

    def value(self, terrain: Terrain, x_m, y_m) -> np.ndarray:
        """Signed and continuous; zero on the borders between grass and soil."""
        patches = _patches(self.seed, self.patch_m, x_m, y_m) - self.threshold
        return np.minimum(patches, (terrain.shore_m(x_m, y_m) - _WET_MARGIN_M) / self.patch_m)


@dataclass(frozen=True)
class GroundMesh:
    """points_m (n, 3), triangles (m, 3) counter-clockwise from above, cover (m,) of SOIL or GRASS."""

    points_m: np.ndarray
    triangles: np.ndarray
    cover: np.ndarray


def plan_cover(terrain: Terrain, settings: dict, seed: int) -> Cover:
    """The threshold that leaves grass on grass_fraction of the grid's dry ground, as far as the wet margin lets it."""
    axis_m = grid_axis(terrain.size_m, terrain.heights_m.shape[0] - 1)
    x_m, y_m = np.meshgrid(axis_m, axis_m)
    patch_m = settings["grass_patch_m"]
    shore_m = terrain.shore_m(x_m, y_m)
    can_grow = shore_m > _WET_MARGIN_M
    if not can_grow.any():
        return Cover(seed, patch_m, np.inf)
    share = settings["grass_fraction"] * np.count_nonzero(shore_m > 0) / np.count_nonzero(can_grow)
    values = _patches(seed, patch_m, x_m[can_grow], y_m[can_grow])
    if share >= 1.0:
        return Cover(seed, patch_m, -np.inf)
    return Cover(seed, patch_m, float(np.quantile(values, 1.0 - share)) if share > 0 else np.inf)


def build_ground(terrain: Terrain, cover: Cover) -> GroundMesh:
    """The heightfield's triangles, refined near borders and cut along them; the shape of the ground stays exact."""
    points, triangles = _grid_mesh(terrain)
    values = cover.value(terrain, points[:, 0], points[:, 1])
    for _ in range(max(0, round(np.log2(terrain.cell_m / _BORDER_EDGE_M)))):
        edges = _edges_of(triangles[_is_mixed(values, triangles)])
        middles = points[edges].mean(axis=1)
        triangles = split_edges(triangles, edges, len(points))
        points = np.concatenate([points, middles])
        values = np.concatenate([values, cover.value(terrain, middles[:, 0], middles[:, 1])])
    edges = _edges_of(triangles[_is_mixed(values, triangles)])
    edges = edges[(values[edges[:, 0]] > 0) != (values[edges[:, 1]] > 0)]
    triangles = split_edges(triangles, edges, len(points))
    points = np.concatenate([points, _crossings(points, values, edges)])
    values = np.concatenate([values, np.zeros(len(edges))])
    # No triangle has corners on both sides any more, so its highest value tells.
    return GroundMesh(points, triangles, np.where(values[triangles].max(axis=1) > 0, GRASS, SOIL))


def split_edges(triangles: np.ndarray, edges: np.ndarray, first_new: int) -> np.ndarray:
    """Triangles (m, 3) after putting one new vertex on each of `edges` (e, 2), numbered from `first_new`.

    Edges are unique pairs, lower vertex first, in ascending order. Triangles with one, two or three such edges become
    two, three or four, turning the same way; neighbours share the new vertices, so no crack opens.
    """
    if len(edges) == 0:
        return triangles
    middle = _new_vertices(triangles, edges, first_new)
    has = middle >= 0
    count = has.sum(axis=1)
    # Turn each triangle so that its single split edge, or the first of two that meet, comes first.
    first = np.where(count == 1, has.argmax(axis=1), np.where(count == 2, (has.argmin(axis=1) + 1) % 3, 0))
    turn = (first[:, None] + np.arange(3)) % 3
    corner = np.take_along_axis(triangles, turn, axis=1)
    middle = np.take_along_axis(middle, turn, axis=1)
    parts = [triangles[count == 0]]
    for number, pattern in _PATTERNS.items():
        six = np.concatenate([corner[count == number], middle[count == number]], axis=1)
        parts += [six[:, part] for part in pattern]
    return np.concatenate(parts)


# Corners 0 1 2, and 3 4 5 the new vertices on edges 0-1, 1-2, 2-0.
_PATTERNS = {
    1: ([0, 3, 2], [3, 1, 2]),
    2: ([3, 1, 4], [0, 3, 4], [0, 4, 2]),
    3: ([0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]),
}


def _patches(seed: int, patch_m: float, x_m, y_m) -> np.ndarray:
    return fractal_noise(seed, "cover", x_m, y_m, 2.0 * patch_m, _COVER_OCTAVES, gain=0.5)


def _grid_mesh(terrain: Terrain) -> tuple[np.ndarray, np.ndarray]:
    """Two triangles a cell, split along the diagonal that `Terrain.height_m` interpolates across."""
    lines = terrain.heights_m.shape[0]
    axis_m = grid_axis(terrain.size_m, lines - 1)
    x_m, y_m = np.meshgrid(axis_m, axis_m)
    points = np.stack([x_m, y_m, terrain.heights_m], axis=-1).reshape(-1, 3)
    corner = np.arange(lines * lines).reshape(lines, lines)
    p00, p10, p01, p11 = (corner[:-1, :-1], corner[:-1, 1:], corner[1:, :-1], corner[1:, 1:])
    lower, upper = np.stack([p00, p10, p11], axis=-1), np.stack([p00, p11, p01], axis=-1)
    return points, np.concatenate([lower.reshape(-1, 3), upper.reshape(-1, 3)])


def _is_mixed(values: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    grass = values[triangles] > 0
    return grass.any(axis=1) & ~grass.all(axis=1)


def _edges_of(triangles: np.ndarray) -> np.ndarray:
    """Unique edges (e, 2) of triangles, lower vertex first, ascending."""
    pairs = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    return _unpacked(np.unique(_packed(pairs)))


def _new_vertices(triangles: np.ndarray, edges: np.ndarray, first_new: int) -> np.ndarray:
    """For each triangle's edges 0-1, 1-2, 2-0 the number of the new vertex on it, or -1."""
    wanted = _packed(edges)
    keys = _packed(np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2))
    place = np.minimum(np.searchsorted(wanted, keys), len(wanted) - 1)
    return np.where(wanted[place] == keys, place + first_new, -1)


def _packed(pairs: np.ndarray) -> np.ndarray:
    return pairs[..., 0].astype(np.int64) << 32 | pairs[..., 1]


def _unpacked(keys: np.ndarray) -> np.ndarray:
    return np.stack([keys >> 32, keys & 0xFFFFFFFF], axis=-1)


def _crossings(points: np.ndarray, values: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Where the border crosses each edge, kept off its ends so that no triangle loses its area."""
    start, end = values[edges[:, 0]], values[edges[:, 1]]
    share = np.clip(start / (start - end), 0.02, 0.98)[:, None]
    return points[edges[:, 0]] * (1 - share) + points[edges[:, 1]] * share
