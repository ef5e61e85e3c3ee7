"""The ground that the clips of a config may show, in squares."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from .camera import Intrinsics
from .flight.poses import Flight
from .frusta import frusta_of
from .land.terrain import Terrain

_SQUARE_M = 16.0
_HEIGHTS_M = 4.0  # apart, from which the range of heights in a square is taken
_APART_S = 0.2  # moments of a flight that are looked at
# Beyond the picture: what comes into it between two of these moments, and into that of a wide lens; estimate.
_MARGIN_M = 24.0
_COARSE = 4  # lines of a grid, of which one is evaluated where nothing is seen
_MOMENTS_AT_ONCE = 64  # so that arrays take a few megabytes for any clip

# Mask (n,) of positions (x_m, y_m).
Seen = Callable[[np.ndarray, np.ndarray], np.ndarray]


def everywhere(x_m: np.ndarray, _) -> np.ndarray:
    """All of the ground."""
    return np.ones(len(x_m), bool)


def sampled(
    value: Callable[[np.ndarray, np.ndarray], np.ndarray], axis_m: np.ndarray, seen: Seen
) -> np.ndarray:
    """Values (n, n) of a function of (x_m, y_m) where lines at axis_m (n,) cross, [row of y, column of x].

    Where nothing is seen, they are interpolated from every fourth line.
    """
    x_m, y_m = np.meshgrid(axis_m, axis_m)
    is_seen = seen(x_m.ravel(), y_m.ravel()).reshape(x_m.shape)
    if is_seen.all():
        return value(x_m, y_m)
    lines = np.unique(np.append(np.arange(0, len(axis_m), _COARSE), len(axis_m) - 1))
    values = value(*np.meshgrid(axis_m[lines], axis_m[lines]))
    place = np.interp(np.arange(len(axis_m)), lines, np.arange(len(lines)))
    low = np.minimum(place.astype(np.int64), max(0, len(lines) - 2))
    high, share = np.minimum(low + 1, len(lines) - 1), place - low
    values = values[low] + share[:, None] * (values[high] - values[low])
    values = values[:, low] + share * (values[:, high] - values[:, low])
    values[is_seen] = value(x_m[is_seen], y_m[is_seen])
    return values


@dataclass(frozen=True)
class SeenGround:
    """Squares [row of y, column of x] of a scene of size_m, from south and west, that some picture may show."""

    size_m: float
    squares: np.ndarray

    def __call__(self, x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
        """Mask (n,) of positions in such squares; positions outside the scene are moved to its border."""
        count = len(self.squares)
        column, row = (
            np.clip(((along + 0.5 * self.size_m) * (count / self.size_m)).astype(np.int64), 0, count - 1)
            for along in (x_m, y_m)
        )
        return self.squares[row, column]


def seen_ground(terrain: Terrain, views: Iterable[tuple[Intrinsics, Flight]]) -> SeenGround:
    """The ground in the pictures of flights, a few metres more rather than less. Occlusion and mirrors are ignored."""
    count = max(1, round(terrain.size_m / _SQUARE_M))
    side_m = terrain.size_m / count
    middles_m = ((np.arange(count) + 0.5) / count - 0.5) * terrain.size_m
    x_m, y_m = (along.reshape(-1, 1) for along in np.meshgrid(middles_m, middles_m))
    low_m, high_m = (heights.reshape(-1, 1) for heights in _height_ranges(terrain, count))
    radius_m = side_m / np.sqrt(2.0) + _MARGIN_M
    seen = np.zeros(count * count, bool)
    for intrinsics, flight in views:
        frusta, moments = frusta_of(intrinsics, flight.camera_to_world), _moments(flight.time_s)
        for first in range(0, len(moments), _MOMENTS_AT_ONCE):
            at = frusta.at(moments[first : first + _MOMENTS_AT_ONCE])
            left = np.flatnonzero(~seen)
            shown = at.may_show(x_m[left], y_m[left], (low_m[left], high_m[left]), radius_m)
            seen[left] = shown.any(axis=-1)
    return SeenGround(terrain.size_m, seen.reshape(count, count))


def _moments(time_s: np.ndarray) -> np.ndarray:
    """Indices of frames about _APART_S apart, the first and the last among them."""
    wanted_s = np.arange(time_s[0], time_s[-1], _APART_S)
    return np.unique(np.append(np.searchsorted(time_s, wanted_s), len(time_s) - 1))


def _height_ranges(terrain: Terrain, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Minimum and maximum (count, count) of the land's heights in each square."""
    steps = max(1, round(terrain.size_m / count / _HEIGHTS_M))
    axis_m = (np.arange(count * steps + 1) / (count * steps) - 0.5) * terrain.size_m
    heights_m = terrain.with_road(None).height_m(*np.meshgrid(axis_m, axis_m))
    squares = np.lib.stride_tricks.sliding_window_view(heights_m, (steps + 1, steps + 1))[::steps, ::steps]
    return squares.min(axis=(2, 3)), squares.max(axis=(2, 3))
