"""Closed smooth curves that know how long they are."""

from __future__ import annotations

import numpy as np

_SAMPLES = 64  # of a segment, for its length


class Loop:
    """A closed curve through `corners_m` (n, 2), n >= 3, told by the distance walked along it.

    Each segment is a centripetal Catmull-Rom curve (Yuksel, Schaefer & Keyser 2011): it passes through its corners,
    has no cusp or loop inside a segment, and its direction is continuous. Distances come from 64 chords a segment:
    too short by a share of about (turn of a segment in radians / 64)^2 / 24, under 1e-4 for a quarter turn.
    """

    def __init__(self, corners_m):
        corners = np.asarray(corners_m, float)
        self._segments = _coefficients(corners)
        t = np.linspace(0.0, len(corners), _SAMPLES * len(corners) + 1)
        steps_m = np.linalg.norm(np.diff(self._at(t)[0], axis=0), axis=1)
        self._parameters = t
        self._distances_m = np.concatenate([[0.0], np.cumsum(steps_m)])

    @property
    def length_m(self) -> float:
        return float(self._distances_m[-1])

    def at(self, distance_m) -> tuple[np.ndarray, np.ndarray]:
        """Points (..., 2) and unit tangents (..., 2) at distances along the loop, of any sign and size."""
        wrapped = np.mod(np.asarray(distance_m, float), self.length_m)
        points, slopes = self._at(np.interp(wrapped, self._distances_m, self._parameters))
        return points, slopes / np.maximum(np.linalg.norm(slopes, axis=-1, keepdims=True), 1e-12)

    def _at(self, t) -> tuple[np.ndarray, np.ndarray]:
        count = len(self._segments)
        segment = np.minimum(np.asarray(t).astype(np.int64), count - 1)
        u = (t - segment)[..., None]
        a, b, c, d = np.moveaxis(self._segments[segment], -2, 0)
        return a + u * (b + u * (c + u * d)), b + u * (2 * c + u * 3 * d)


def _coefficients(corners: np.ndarray) -> np.ndarray:
    """Cubic coefficients (n, 4, 2), lowest power first, of the segment from each corner to the next."""
    before, start, end, after = (np.roll(corners, k, axis=0) for k in (1, 0, -1, -2))
    d0, d1, d2 = (_knot_step(p, q) for p, q in ((before, start), (start, end), (end, after)))
    slope0 = d1 * ((start - before) / d0 - (end - before) / (d0 + d1) + (end - start) / d1)
    slope1 = d1 * ((end - start) / d1 - (after - start) / (d1 + d2) + (after - end) / d2)
    rise = end - start
    return np.stack([start, slope0, 3 * rise - 2 * slope0 - slope1, slope0 + slope1 - 2 * rise], axis=1)


def _knot_step(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Square root of a chord; corners that coincide are kept a hair apart."""
    return np.sqrt(np.maximum(np.linalg.norm(q - p, axis=1, keepdims=True), 1e-9))
