"""Smooth curves parametrised by arc length."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .components import length, unit
from .neighbours import pairs_within

_SAMPLES = 64  # chords per segment, to measure its length


class _Curve:
    """A curve of cubic segments, parametrised by the distance along it."""

    def __init__(self, segments: np.ndarray):
        self._coefficients = np.ascontiguousarray(np.moveaxis(segments, 0, -1))
        t = np.linspace(0.0, len(segments), _SAMPLES * len(segments) + 1)
        steps_m = length(np.diff(self._at(t)[0]))
        self._parameters = t
        self._distances_m = np.concatenate([[0.0], np.cumsum(steps_m)])

    @property
    def length_m(self) -> float:
        return float(self._distances_m[-1])

    @property
    def corners_at_m(self) -> np.ndarray:
        """Distances of the corners along the curve; a loop's first corner appears again as its last."""
        return self._distances_m[::_SAMPLES]

    def points_m(self, step_m: float) -> np.ndarray:
        """Points (n, 2) from the beginning of the curve to its end, evenly spaced at most step_m apart."""
        return self._walked(np.linspace(0.0, self.length_m, int(np.ceil(self.length_m / step_m)) + 1))[0]

    def _walked(self, distance_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        points, slopes = self._at(np.interp(distance_m, self._distances_m, self._parameters))
        return np.moveaxis(points, 0, -1), np.moveaxis(unit(slopes), 0, -1)

    def _at(self, t) -> tuple[np.ndarray, np.ndarray]:
        """Points and slopes (2, ...): components come first, so that NumPy works along the others."""
        segment = np.minimum(np.asarray(t).astype(np.int64), self._coefficients.shape[-1] - 1)
        u = t - segment
        a, b, c, d = self._coefficients.take(segment, axis=-1)
        return a + u * (b + u * (c + u * d)), b + u * (2 * c + u * 3 * d)


class Loop(_Curve):
    """A closed curve through `corners_m` (n, 2), n >= 3, parametrised by the distance along it.

    Each segment is a centripetal Catmull-Rom curve (Yuksel, Schaefer & Keyser 2011): it passes through its corners,
    has no cusp or loop inside a segment, and its direction is continuous. Distances are sums of 64 chords per segment:
    too short by a fraction of about (turn of a segment in radians / 64)^2 / 24, less than 1e-4 for a quarter turn.
    """

    def __init__(self, corners_m):
        corners = np.asarray(corners_m, float)
        super().__init__(_coefficients(*(np.roll(corners, k, axis=0) for k in (1, 0, -1, -2))))

    def at(self, distance_m) -> tuple[np.ndarray, np.ndarray]:
        """Points (..., 2) and unit tangents (..., 2) at distances along the loop, modulo its length."""
        return self._walked(np.mod(np.asarray(distance_m, float), self.length_m))


class Line(_Curve):
    """An open curve of the same kind through `corners_m` (n, 2), n >= 2; it is extrapolated with straight ends."""

    def __init__(self, corners_m):
        corners = np.asarray(corners_m, float)
        ends = 2.0 * corners[[0, -1]] - corners[[1, -2]]
        longer = np.concatenate([ends[:1], corners, ends[1:]])
        count = len(corners) - 1
        super().__init__(_coefficients(*(longer[k : k + count] for k in range(4))))

    def at(self, distance_m) -> tuple[np.ndarray, np.ndarray]:
        """Points (..., 2) and unit tangents (..., 2) at distances along the line, clamped to its ends."""
        return self._walked(np.clip(np.asarray(distance_m, float), 0.0, self.length_m))


@dataclass(frozen=True)
class Spot:
    """A position to stay at, with the interface of a path: point_m (2,), heading (2,)."""

    point_m: np.ndarray
    heading: np.ndarray

    length_m = 0.0

    def at(self, distance_m) -> tuple[np.ndarray, np.ndarray]:
        """The point and heading (..., 2), which are the same at all distances."""
        shape = np.shape(distance_m) + (2,)
        return np.broadcast_to(self.point_m, shape), np.broadcast_to(self.heading, shape)


def self_crossing(points_m: np.ndarray) -> np.ndarray | None:
    """A point (x, y) where the polyline through points_m (n, 2) crosses itself, or None.

    A polyline that ends where it begins is closed. Its segments should be of similar length.
    """
    start, end = points_m[:-1], points_m[1:]
    longest_m = np.linalg.norm(end - start, axis=1).max()
    middle = 0.5 * (start + end)
    i, j = pairs_within(middle, middle, 1.001 * longest_m + 1e-9)
    closed = np.array_equal(points_m[0], points_m[-1])
    apart = (j > i + 1) & ~(
        closed & (i == 0) & (j == len(start) - 1)
    )  # neighbouring segments share a point without crossing
    i, j = i[apart], j[apart]
    sides = [_side(start[i], end[i], p) * _side(start[i], end[i], q) for p, q in ((start[j], end[j]),)]
    sides += [_side(start[j], end[j], p) * _side(start[j], end[j], q) for p, q in ((start[i], end[i]),)]
    crossed = np.flatnonzero((sides[0] <= 0) & (sides[1] <= 0))
    return middle[i[crossed[0]]] if len(crossed) else None


def _side(start: np.ndarray, end: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Positive for points to the left of lines, negative to the right."""
    along, off = end - start, point - start
    return along[:, 0] * off[:, 1] - along[:, 1] * off[:, 0]


def _coefficients(before: np.ndarray, start: np.ndarray, end: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Cubic coefficients (n, 4, 2), lowest power first, of segments from start (n, 2) to end (n, 2)."""
    d0, d1, d2 = (_knot_step(p, q) for p, q in ((before, start), (start, end), (end, after)))
    slope0 = d1 * ((start - before) / d0 - (end - before) / (d0 + d1) + (end - start) / d1)
    slope1 = d1 * ((end - start) / d1 - (after - start) / (d1 + d2) + (after - end) / d2)
    rise = end - start
    return np.stack([start, slope0, 3 * rise - 2 * slope0 - slope1, slope0 + slope1 - 2 * rise], axis=1)


def _knot_step(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Square root of a chord, with a small lower bound for coincident corners."""
    return np.sqrt(np.maximum(np.linalg.norm(q - p, axis=1, keepdims=True), 1e-9))
