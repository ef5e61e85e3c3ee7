"""A dirt road: a loop with a fork, cut into the ground, with a level cross-section and two wheel tracks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..geometry.easing import smooth
from ..geometry.neighbours import Neighbours
from ..geometry.splines import Line, Loop

SHOULDER_M = 2.5  # width of the shoulder that blends the road into the land
TRACK_M = 0.75  # distance of each wheel track from the middle: a lorry's gauge is about 1.5 m; estimate
_CUT_M = 0.12  # below the land; estimate
_TRACK_DEPTH_M = 0.05  # estimate
_TRACK_SIGMA_M = 0.2
_STEP_M = 2.0  # a chord of this length is 2 cm off the tightest curve, of radius 30 m
_SMOOTHING_M = 12.0  # smoothing along the road, which does not follow every bump
_JOINING_M = 25.0  # length along the spur over which its height departs from the loop's
_RASTER_M = 8.0

Heights = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Road:
    """A road width_m wide along a loop and, where it forks, a spur; bed_m: heights at points_m of each of them.

    Distances to the road are known up to reach_m from its centre line.
    """

    loop: Loop
    spur: Line | None
    width_m: float
    size_m: float
    reach_m: float
    points_m: tuple[np.ndarray, ...]
    bed_m: tuple[np.ndarray, ...]

    @property
    def lines(self) -> tuple[Loop | Line, ...]:
        """The loop, and the spur if there is one."""
        return (self.loop,) if self.spur is None else (self.loop, self.spur)

    @property
    def heights_m(self) -> list[np.ndarray]:
        """Heights between which all of the road lies: along each line, its borders and the bottom of its tracks."""
        return [bed - depth for bed in self.bed_m for depth in (_CUT_M, _CUT_M + _TRACK_DEPTH_M)]

    def distance_m(self, x_m, y_m) -> np.ndarray:
        """Distance (n,) to the road's border, negative on it; infinite beyond reach_m from its centre line."""
        distance = np.full(np.shape(x_m), np.inf)
        flat = distance.reshape(-1)
        about, places = self._about(x_m, y_m)
        for line in range(len(self.lines)):
            k, off_m, _ = self._nearest(line, places)
            near = about[k]
            flat[near] = np.minimum(flat[near], off_m - 0.5 * self.width_m)
        return distance

    def cut(self, height_m: np.ndarray, x_m, y_m) -> np.ndarray:
        """Heights (n,) of the land with the road cut into it; at the fork, both branches blend into each other."""
        height = np.array(height_m, float)
        flat = height.reshape(-1)
        about, places = self._about(x_m, y_m)
        if len(about) == 0:
            return height
        most, total, weighted = (np.zeros(len(about)) for _ in range(3))
        for line in range(len(self.lines)):
            k, off_m, bed_m = self._nearest(line, places)
            share = 1.0 - smooth((off_m - 0.5 * self.width_m) / SHOULDER_M)
            most[k] = np.maximum(most[k], share)
            total[k] += share
            weighted[k] += share * (bed_m - _CUT_M - _tracks_m(off_m))
        on = total > 0
        cut = about[on]
        flat[cut] += most[on] * (weighted[on] / total[on] - flat[cut])
        return height

    def _about(self, x_m, y_m) -> tuple[np.ndarray, np.ndarray]:
        """Flat indices (n,) of the positions that may be within reach_m of the road, and these positions (n, 2)."""
        x_m, y_m = (np.asarray(v, float).ravel() for v in np.broadcast_arrays(x_m, y_m))
        column, row = self._square(x_m, y_m)
        about = np.flatnonzero(self._raster[row, column])
        return about, np.column_stack([x_m[about], y_m[about]])

    def _nearest(self, line: int, places: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Indices (k,) of points (n, 2) within reach_m of a line, their distances, and the heights of its bed."""
        if len(places) == 0:
            return np.zeros(0, np.int64), np.zeros(0), np.zeros(0)
        start, along, low, high = self._segments[line]
        i, j = self._middles[line].pairs(places)
        along_x, along_y = along.T[:, j]
        from_x, from_y = (of[i] - begin[j] for of, begin in zip(places.T, start.T))
        length2 = along_x**2 + along_y**2
        share = np.clip((from_x * along_x + from_y * along_y) / length2, 0.0, 1.0)
        off = np.sqrt((from_x - share * along_x) ** 2 + (from_y - share * along_y) ** 2)
        best = _least_of_each(i, off)
        best = best[off[best] < self.reach_m]
        bed_m = low[j[best]] + share[best] * (high[j[best]] - low[j[best]])
        return i[best], off[best], bed_m

    @cached_property
    def _segments(self) -> list[tuple[np.ndarray, ...]]:
        """For each line: starts of its segments (k, 2), their vectors (k, 2), and bed heights at both ends (k,)."""
        return [
            (points[:-1], np.diff(points, axis=0), bed[:-1], bed[1:])
            for points, bed in zip(self.points_m, self.bed_m)
        ]

    @cached_property
    def _middles(self) -> list[Neighbours]:
        """For each line: the middles of its segments."""
        return [
            Neighbours(start + 0.5 * along, self.reach_m + _STEP_M) for start, along, _, _ in self._segments
        ]

    @cached_property
    def _raster(self) -> np.ndarray:
        """Mask of the squares of _RASTER_M [row, column] that may contain a point within reach_m of the road."""
        cells = int(np.ceil(self.size_m / _RASTER_M))
        marked = np.zeros((cells, cells), bool)
        points = np.concatenate(self.points_m)
        reach_m = self.reach_m + _STEP_M
        steps = np.linspace(-reach_m, reach_m, int(2 * reach_m / _RASTER_M) + 2)
        for dx in steps:
            for dy in steps:
                column, row = self._square(points[:, 0] + dx, points[:, 1] + dy)
                marked[row, column] = True
        return marked

    def _square(self, x_m, y_m) -> tuple[np.ndarray, np.ndarray]:
        """Column and row of the square of each position; positions outside the scene are clamped to its border."""
        last = int(np.ceil(self.size_m / _RASTER_M)) - 1
        column, row = (
            np.clip(((v + 0.5 * self.size_m) / _RASTER_M).astype(np.int64), 0, last) for v in (x_m, y_m)
        )
        return column, row


def lay_road(
    loop: Loop, spur: Line | None, width_m: float, size_m: float, cell_m: float, land_m: Heights
) -> Road:
    """A road along lines over land with heights (x_m, y_m), which it follows smoothly.

    Its reach extends beyond its shoulders far enough to include a corner of each triangle, of cells of cell_m, that it
    crosses.
    """
    reach_m = 0.5 * width_m + SHOULDER_M + 1.5 * cell_m
    points = loop.points_m(_STEP_M)
    bed = _smoothed(land_m(*points.T), loop.length_m / (len(points) - 1), closed=True)
    if spur is None:
        return Road(loop, None, width_m, size_m, reach_m, (points,), (bed,))
    spur_points = spur.points_m(_STEP_M)
    spur_bed = _smoothed(land_m(*spur_points.T), spur.length_m / (len(spur_points) - 1), closed=False)
    joint = np.linalg.norm(points - spur_points[0], axis=1).argmin()
    joined = smooth(np.linspace(0.0, spur.length_m, len(spur_bed)) / _JOINING_M)
    spur_bed += (1.0 - joined) * (bed[joint] - spur_bed)
    return Road(loop, spur, width_m, size_m, reach_m, (points, spur_points), (bed, spur_bed))


def _least_of_each(number: np.ndarray, value: np.ndarray) -> np.ndarray:
    """Positions (k,) of the smallest value, the first if several, for each distinct number, ascending."""
    order = np.argsort(number, kind="stable")
    if len(order) == 0:
        return order
    first = _starts(number[order])
    count = np.diff(first, append=len(order))
    ordered = value[order]
    least = np.flatnonzero(ordered == np.repeat(np.minimum.reduceat(ordered, first), count))
    return order[least[_starts(number[order[least]])]]


def _starts(ordered: np.ndarray) -> np.ndarray:
    """Index of the first occurrence of each distinct number of an ascending array."""
    return np.flatnonzero(np.diff(ordered, prepend=ordered[0] - 1))


def _tracks_m(off_m: np.ndarray) -> np.ndarray:
    """Depth of the wheel tracks at distances from the centre line."""
    return _TRACK_DEPTH_M * np.exp(-0.5 * ((off_m - TRACK_M) / _TRACK_SIGMA_M) ** 2)


def _smoothed(height_m: np.ndarray, step_m: float, closed: bool) -> np.ndarray:
    """Heights along a line, smoothed by a Gaussian; a closed line's last height is its first one."""
    sigma = _SMOOTHING_M / step_m
    reach = min(int(3 * sigma) + 1, len(height_m) - 1)
    taps = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    inner = height_m[:-1] if closed else height_m
    padded = np.pad(inner, reach, mode="wrap" if closed else "edge")
    smooth = np.convolve(padded, taps / taps.sum(), mode="valid")
    return np.append(smooth, smooth[0]) if closed else smooth
