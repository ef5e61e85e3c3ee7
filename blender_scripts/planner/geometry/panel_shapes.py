"""Panels: side views of hoods, cabins and beds, extruded across a vehicle, with rounded edges. Lengths in m."""

from __future__ import annotations

import numpy as np

from .rotations import left_of
from .shapes import Mesh, facets

_EDGE_RAD = np.radians([0.0, 45.0, 90.0])  # segments of the rounded edge from a panel's side to its rim
_CHAMFERED_M = 0.05  # edges up to this radius are flat
_WHEEL_CORNERS = 18
_SHARPEST = 0.3  # 1 + cosine of the sharpest turn whose edges keep their distance from the corner


def panel(outline_m: np.ndarray, bevel_m: float, corner_m: float = 0.0, y_m: float = 0.0) -> Mesh:
    """A solid whose side view is a simple polygon, convex or concave, centred on y_m.

    outline_m (n, 3): x, z and half width at each corner. bevel_m: radius of the edges between sides and rim, less than
    what fits inside the outline; corner_m: approximate radius of the outline's own corners.
    """
    outline = _counter_clockwise(np.asarray(outline_m, float))
    edge = _EDGE_RAD if bevel_m > _CHAMFERED_M else _EDGE_RAD[[0, -1]]
    right = [
        _layer(outline, corner_m, bevel_m * (1 - np.sin(angle)), bevel_m * (1 - np.cos(angle)))
        for angle in edge
    ]
    left = [layer * [1.0, -1.0, 1.0] for layer in right[::-1]]
    layers, corners, cap = len(right) + len(left), len(right[0]), _ears(right[0][:, [0, 2]])
    triangles = np.concatenate([_rim(layers, corners), cap, cap[:, ::-1] + (layers - 1) * corners])
    return facets(np.concatenate(right + left) + [0.0, y_m, 0.0], triangles)


def wheel(centre_m, radius_m: float, half_width_m: float, bevel_m: float) -> Mesh:
    """A disc with its axle across the vehicle."""
    angle = 2.0 * np.pi * np.arange(_WHEEL_CORNERS) / _WHEEL_CORNERS
    x, y, z = centre_m
    rim = [x + radius_m * np.cos(angle), z + radius_m * np.sin(angle), np.full(_WHEEL_CORNERS, half_width_m)]
    return panel(np.stack(rim, axis=1), bevel_m, y_m=y)


def _counter_clockwise(outline: np.ndarray) -> np.ndarray:
    """The same corners, ordered from x towards z."""
    x, z = outline[:, 0], outline[:, 1]
    area = (x * np.roll(z, -1) - z * np.roll(x, -1)).sum()
    return outline if area > 0.0 else outline[::-1]


def _rounded(outline: np.ndarray, corner_m: float) -> np.ndarray:
    """Each corner replaced by three points of a curve that begins corner_m before it, or less at short edges."""
    before, after = np.roll(outline, 1, axis=0) - outline, np.roll(outline, -1, axis=0) - outline
    start, end = (
        outline + edge * np.minimum(corner_m / np.linalg.norm(edge[:, :2], axis=1), 0.4)[:, None]
        for edge in (before, after)
    )
    return np.stack([start, 0.25 * start + 0.5 * outline + 0.25 * end, end], axis=1).reshape(-1, 3)


def _inward(points: np.ndarray) -> np.ndarray:
    """Vectors (n, 2) by which corners move when all edges move inward by 1."""
    along = np.roll(points, -1, axis=0) - points
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    after = left_of(along)
    before = np.roll(after, 1, axis=0)
    return (before + after) / np.maximum(1.0 + (before * after).sum(axis=1, keepdims=True), _SHARPEST)


def _layer(outline: np.ndarray, corner_m: float, inset_m: float, drop_m: float) -> np.ndarray:
    """The outline (n, 3) in space, on the right side: moved inward by inset_m and towards the middle by drop_m."""
    inset = outline + inset_m * np.insert(_inward(outline[:, :2]), 2, 0.0, axis=1)
    x, z, half_width = (_rounded(inset, corner_m) if corner_m > 0.0 else inset).T
    return np.stack([x, drop_m - half_width, z], axis=1)


def _rim(layers: int, corners: int) -> np.ndarray:
    """Faces between outlines stacked from right to left."""
    here = np.arange(layers * corners).reshape(layers, corners)
    following = np.roll(here, -1, axis=1)
    a, b, c, d = here[:-1].ravel(), following[:-1].ravel(), following[1:].ravel(), here[1:].ravel()
    return np.concatenate([np.stack([a, d, c], axis=1), np.stack([a, c, b], axis=1)])


def _ears(points: np.ndarray) -> np.ndarray:
    """Triangles (n - 2, 3) of a simple polygon (n, 2) by ear clipping; the ear of greatest height is clipped first."""
    left, triangles = list(range(len(points))), []
    while len(left) > 3:
        corners = [(left[k - 1], left[k], left[(k + 1) % len(left)]) for k in range(len(left))]
        worth = [_ear_height(points, corner, left) for corner in corners]
        best = int(np.argmax(worth))
        triangles.append(corners[best])
        del left[best]
    return np.array(triangles + [tuple(left)])


def _ear_height(points: np.ndarray, corner: tuple[int, int, int], left: list[int]) -> float:
    """Smallest height of a corner's triangle; -1 if it is not an ear: reflex, or with other corners inside."""
    a, b, c = points[list(corner)]
    area = _cross(b - a, c - a)
    others = points[[k for k in left if k not in corner]]
    inside = (
        (_cross(b - a, others - a) >= 0) & (_cross(c - b, others - b) >= 0) & (_cross(a - c, others - c) >= 0)
    )
    if area <= 0.0 or inside.any():
        return -1.0
    return float(area / max(np.linalg.norm(edge) for edge in (b - a, c - b, a - c)))


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
