"""The ground that a camera may see, as circles, frame by frame."""

from __future__ import annotations

import numpy as np

from ..camera import Intrinsics, edge_tangents

_GROWTH = 1.25  # a larger value means more plants in each frame, a smaller one more frequent updates
_LEAST_FALL = 0.05  # vertical share of a ray's length; flatter rays are assumed to see everything


def circles_seen(
    intrinsics: Intrinsics, camera_to_world: np.ndarray, low_m: float, high_m: float
) -> tuple[np.ndarray, np.ndarray]:
    """Centres (n, 2) and radii (n,) of circles that contain the views of poses (n, 4, 4) between two heights, seen from
    above.

    A radius is infinite if the picture reaches the horizon, or nearly.
    """
    rays = _corner_rays(intrinsics, camera_to_world)
    fall = -rays[..., 2] / np.linalg.norm(rays, axis=-1)
    position_m = camera_to_world[:, None, :3, 3]
    drop_m = np.stack(
        [np.maximum(position_m[..., 2] - height_m, 0.0) for height_m in (low_m, high_m)], axis=-1
    )
    level = rays[..., :2] / np.maximum(-rays[..., 2:], 1e-9)
    corners_m = (position_m[..., None, :2] + drop_m[..., None] * level[:, :, None]).reshape(len(rays), -1, 2)
    centres_m = 0.5 * (corners_m.min(axis=1) + corners_m.max(axis=1))
    radii_m = np.linalg.norm(corners_m - centres_m[:, None], axis=-1).max(axis=1)
    endless = fall.min(axis=1) < _LEAST_FALL
    return np.where(endless[:, None], position_m[:, 0, :2], centres_m), np.where(endless, np.inf, radii_m)


def held_circles(centres_m: np.ndarray, radii_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Circles (n, 2) and (n,) that contain the given ones, each reused for as many consecutive frames as possible.

    A circle is kept while it is at most _GROWTH times as large as the smallest one it contains.
    """
    centres_held_m, radii_held_m = np.empty_like(centres_m), np.empty_like(radii_m)
    first = 0
    for k in range(len(radii_m)):
        circle = _around(centres_m[first : k + 1], radii_m[first : k + 1])
        if circle[1] > _GROWTH * radii_m[first : k + 1].min():
            first, circle = k, (centres_m[k], radii_m[k])
        centres_held_m[first : k + 1], radii_held_m[first : k + 1] = circle
    return centres_held_m, radii_held_m


def _around(centres_m: np.ndarray, radii_m: np.ndarray) -> tuple[np.ndarray, float]:
    """A circle around all of some circles."""
    middle_m = 0.5 * (centres_m.min(axis=0) + centres_m.max(axis=0))
    return middle_m, float((np.linalg.norm(centres_m - middle_m, axis=1) + radii_m).max())


def _corner_rays(intrinsics: Intrinsics, camera_to_world: np.ndarray) -> np.ndarray:
    """World directions (n, 4, 3) through the corners of the picture."""
    (left, top), (right, bottom) = edge_tangents(intrinsics)
    corners = np.array([[-left, -top, 1.0], [right, -top, 1.0], [right, bottom, 1.0], [-left, bottom, 1.0]])
    return corners @ camera_to_world[:, :3, :3].transpose(0, 2, 1)
