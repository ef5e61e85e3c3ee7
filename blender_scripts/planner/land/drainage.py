"""Drainage: a network of gullies on a grid, cut into the land."""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np

from ..geometry.splines import Line
from ..noise import lattice_uniform

_LEAST_CELL_M = 16.0
_MOST_LINES = 160  # nodes per side
_JITTER = 0.35  # of a cell: displacement of nodes, so that gullies do not follow the grid
_HEAD_M2 = 9000.0  # of land that drains into the smallest gully
_FULL_M2 = 250000.0  # of land that drains into a gully of full depth
_SAMPLE_M = 3.0
_SIDE_REACH = 1.8  # half widths of a gully beyond which land is unchanged
_BLEND_M = 0.4
_FALL = 1e-3  # slope per metre across filled hollows, so that water flows
_NEIGHBOURS = [(dx, dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if (dx, dy) != (0, 0)]


@dataclass(frozen=True)
class Drainage:
    """Flow over a coarse grid of nodes.

    points_m (n, 2); level_m (n,), height of the land with its hollows filled; area_m2 (n,), drainage area; receiver
    (n,), the node that water flows to, itself at outlets; order (n,) of visits from the outlets upstream.
    """

    lines: int
    points_m: np.ndarray
    level_m: np.ndarray
    area_m2: np.ndarray
    receiver: np.ndarray

    def wetness(self) -> np.ndarray:
        """Relative flow through each node [row of y, column of x]: 0 on divides, 1 in the largest gullies."""
        own_m2 = self.area_m2.min()
        wet = np.log(self.area_m2 / own_m2) / np.log(max(_FULL_M2 / own_m2, 2.0))
        return np.clip(wet, 0.0, 1.0).reshape(self.lines, self.lines)


def plan_drainage(land_m: np.ndarray, size_m: float, is_sink: np.ndarray, seed: int) -> Drainage:
    """Drainage of land_m, a square grid [row of y, column of x] of side size_m, to its borders and to sinks."""
    lines = int(np.clip(size_m / _LEAST_CELL_M, 2, min(_MOST_LINES, land_m.shape[0] - 1))) + 1
    row, column, points_m = _nodes(lines, land_m.shape[0], size_m, seed)
    outlet = is_sink[row, column].reshape(lines, lines)
    outlet[[0, -1]], outlet[:, [0, -1]] = True, True
    level_m, receiver, order = _flooded(land_m[row, column], outlet, _FALL * size_m / (lines - 1))
    area_m2 = np.full(lines * lines, (size_m / (lines - 1)) ** 2)
    for node in reversed(order):
        if receiver[node] != node:
            area_m2[receiver[node]] += area_m2[node]
    return Drainage(lines, points_m, level_m, area_m2, receiver)


def carve(land_m: np.ndarray, size_m: float, drainage: Drainage, depth_m: float) -> np.ndarray:
    """The land with gullies of up to depth_m carved along the larger flows."""
    cell_m = size_m / (land_m.shape[0] - 1)
    samples = [_sampled(drainage, course, depth_m) for course in _courses(drainage)]
    if not samples:
        return land_m
    points_m, bed_m, depths_m = (np.concatenate(part) for part in zip(*samples))
    half_width_m = 1.5 + 3.0 * depths_m
    reach = int(np.ceil(_SIDE_REACH * half_width_m.max() / cell_m))
    middle = np.round((points_m / size_m + 0.5) * (land_m.shape[0] - 1)).astype(np.int64)
    carved_m = np.full(land_m.size, np.inf)
    for step in [np.array([dx, dy]) for dx in range(-reach, reach + 1) for dy in range(-reach, reach + 1)]:
        node = middle + step
        off = np.linalg.norm((node / (land_m.shape[0] - 1) - 0.5) * size_m - points_m, axis=1) / half_width_m
        hit = (off < _SIDE_REACH) & (node >= 0).all(axis=1) & (node < land_m.shape[0]).all(axis=1)
        flat = node[hit, 1] * land_m.shape[0] + node[hit, 0]
        np.minimum.at(carved_m, flat, bed_m[hit] + depths_m[hit] * off[hit] ** 2)
    return _soft_minimum(land_m, carved_m.reshape(land_m.shape))


def _nodes(lines: int, grid_lines: int, size_m: float, seed: int):
    """Rows and columns in the land's grid, and points, of nodes jittered about a coarser grid."""
    iy, ix = (index.ravel() for index in np.indices((lines, lines)))
    inner = ((ix > 0) & (ix < lines - 1)) & ((iy > 0) & (iy < lines - 1))
    place = []
    for name, index in (("x", ix), ("y", iy)):
        shift = _JITTER * (2.0 * lattice_uniform(seed, f"drainage/{name}", ix, iy) - 1.0)
        place.append(np.round((index + inner * shift) / (lines - 1) * (grid_lines - 1)).astype(np.int64))
    column, row = place
    return row, column, (np.column_stack([column, row]) / (grid_lines - 1) - 0.5) * size_m


def _flooded(land_m: np.ndarray, outlet: np.ndarray, fall_m: float):
    """Filled heights, receivers and the order of visits: priority flood (Barnes, Lehman & Mulla 2014) from outlets."""
    lines = outlet.shape[0]
    level_m, receiver, order = land_m.tolist(), list(range(lines * lines)), []
    seen = outlet.ravel().tolist()
    heap = [(level_m[node], node) for node in np.flatnonzero(outlet).tolist()]
    heapq.heapify(heap)
    while heap:
        level, node = heapq.heappop(heap)
        order.append(node)
        y, x = divmod(node, lines)
        for dx, dy in _NEIGHBOURS:
            if not (0 <= x + dx < lines and 0 <= y + dy < lines):
                continue
            other = node + dx + dy * lines
            if not seen[other]:
                seen[other], receiver[other] = True, node
                level_m[other] = max(level_m[other], level + fall_m)
                heapq.heappush(heap, (level_m[other], other))
    return np.array(level_m), np.array(receiver), order


def _courses(drainage: Drainage) -> list[list[int]]:
    """Nodes of each gully, from its head to where it joins a longer one or ends."""
    is_gully = (drainage.area_m2 >= _HEAD_M2) & (drainage.receiver != np.arange(len(drainage.receiver)))
    fed = np.zeros(len(is_gully), bool)
    fed[drainage.receiver[is_gully]] = True
    courses, done = [], np.zeros(len(is_gully), bool)
    for head in np.flatnonzero(is_gully & ~fed):
        course = [int(head)]
        while is_gully[course[-1]] and not done[course[-1]]:
            done[course[-1]] = True
            course.append(int(drainage.receiver[course[-1]]))
        courses.append(course)
    return courses


def _sampled(drainage: Drainage, course: list[int], depth_m: float):
    """Points (n, 2), bed heights (n,) and depths (n,) along a gully."""
    line = Line(drainage.points_m[course])
    depths_m = depth_m * np.clip(drainage.area_m2[course] / _FULL_M2, 0.02, 1.0) ** 0.35
    along_m = np.linspace(0.0, line.length_m, int(line.length_m / _SAMPLE_M) + 2)
    corners_m = line.corners_at_m
    bed_m = np.interp(along_m, corners_m, drainage.level_m[course] - depths_m)
    return line.at(along_m)[0], bed_m, np.interp(along_m, corners_m, depths_m)


def _soft_minimum(a_m: np.ndarray, b_m: np.ndarray) -> np.ndarray:
    """A smooth minimum of two heights, blended over _BLEND_M; never above either."""
    near = np.clip(1.0 - np.abs(a_m - b_m) / _BLEND_M, 0.0, 1.0)
    return np.minimum(a_m, b_m) - 0.25 * _BLEND_M * near * near
