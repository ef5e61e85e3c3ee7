"""Which part of the place a camera may see: circles of ground, frame by frame."""

from __future__ import annotations

import numpy as np

from ..camera import Intrinsics

_LEAST_FALL = 0.05  # of a ray's length; flatter rays are taken to see everything


def circles_seen(
    intrinsics: Intrinsics, camera_to_world: np.ndarray, low_m: float, high_m: float
) -> tuple[np.ndarray, np.ndarray]:
    """Centres (n, 2) and radii (n,) of circles above or below whatever poses (n, 4, 4) see between two heights.

    A radius is infinite if the picture reaches up to the horizon, or nearly.
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


def _corner_rays(intrinsics: Intrinsics, camera_to_world: np.ndarray) -> np.ndarray:
    """Directions (n, 4, 3) in the world through the corners of the picture."""
    x, y = np.array(intrinsics.centre_px) / intrinsics.f_px
    corners = np.array([[-x, -y, 1.0], [x, -y, 1.0], [x, y, 1.0], [-x, y, 1.0]])
    return corners @ camera_to_world[:, :3, :3].transpose(0, 2, 1)
