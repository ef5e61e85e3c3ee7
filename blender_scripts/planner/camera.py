"""A pinhole camera: intrinsics, poses and projection.

Camera axes as OpenCV's: x right, y down, z forward. The centre of the top left pixel is at (0.5, 0.5).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

DEPTH_RANGE_M = (0.1, 20000.0)  # along the axis: surfaces outside this range are not rendered


@dataclass(frozen=True)
class Intrinsics:
    """Size, focal lengths along x and y, and principal point, all in pixels."""

    width_px: int
    height_px: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]


def centred(width_px: int, height_px: int, f_px: float) -> Intrinsics:
    """A camera with square pixels and the principal point in the middle of the picture."""
    return Intrinsics(width_px, height_px, (f_px, f_px), (width_px / 2, height_px / 2))


def intrinsics_of(camera: dict) -> Intrinsics:
    """Intrinsics from the keys of a manifest's or a plan's `camera`."""
    return Intrinsics(
        camera["width_px"],
        camera["height_px"],
        (camera["fx_px"], camera["fy_px"]),
        (camera["cx_px"], camera["cy_px"]),
    )


def camera_of(entry: dict, usual: Intrinsics) -> Intrinsics:
    """Intrinsics of a clip or flight: its own, or the default."""
    return intrinsics_of(entry["camera"]) if "camera" in entry else usual


def widened(intrinsics: Intrinsics, margin_px: int) -> Intrinsics:
    """The same camera with additional pixels on every side."""
    cx_px, cy_px = intrinsics.centre_px
    return Intrinsics(
        intrinsics.width_px + 2 * margin_px,
        intrinsics.height_px + 2 * margin_px,
        intrinsics.focal_px,
        (cx_px + margin_px, cy_px + margin_px),
    )


def edge_tangents(intrinsics: Intrinsics) -> tuple[tuple[float, float], tuple[float, float]]:
    """Tangents of the angles from the axis outwards to the picture's edges: (left, top), (right, bottom)."""
    (fx_px, fy_px), (cx_px, cy_px) = intrinsics.focal_px, intrinsics.centre_px
    left, top = cx_px / fx_px, cy_px / fy_px
    return (left, top), ((intrinsics.width_px - cx_px) / fx_px, (intrinsics.height_px - cy_px) / fy_px)


def lens_shift(intrinsics: Intrinsics) -> tuple[float, float]:
    """Blender's shift_x and shift_y: offset of the picture's centre right of and above the axis, over its width."""
    (fx_px, fy_px), (cx_px, cy_px) = intrinsics.focal_px, intrinsics.centre_px
    width_px, height_px = intrinsics.width_px, intrinsics.height_px
    # Blender expresses both shifts in widths; pixels are fx / fy as high as they are wide.
    return (0.5 * width_px - cx_px) / width_px, (cy_px - 0.5 * height_px) * (fx_px / fy_px) / width_px


def pixel_aspect(intrinsics: Intrinsics) -> tuple[float, float]:
    """Blender's pixel_aspect_x and pixel_aspect_y, which are at least 1: a pixel is 1 / fx wide and 1 / fy high."""
    fx_px, fy_px = intrinsics.focal_px
    return max(fy_px / fx_px, 1.0), max(fx_px / fy_px, 1.0)


def look(position_m: np.ndarray, bearing: np.ndarray, depression_rad: np.ndarray) -> np.ndarray:
    """Camera-to-world poses (n, 4, 4) without roll.

    position_m (n, 3); bearing (n, 2) unit vectors of the horizontal direction that points up in the picture;
    depression_rad (n,) below the horizon, pi/2 straight down.
    """
    cos, sin = np.cos(depression_rad), np.sin(depression_rad)
    bx, by = bearing[:, 0], bearing[:, 1]
    pose = np.zeros((len(position_m), 4, 4))
    pose[:, :3, 0] = np.stack([by, -bx, np.zeros_like(bx)], axis=1)
    pose[:, :3, 1] = np.stack([-sin * bx, -sin * by, -cos], axis=1)
    pose[:, :3, 2] = np.stack([cos * bx, cos * by, -sin], axis=1)
    pose[:, :3, 3] = position_m
    pose[:, 3, 3] = 1.0
    return pose


def project(
    intrinsics: Intrinsics, camera_to_world: np.ndarray, points_m: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Picture points (..., n, 2) in px and depths (..., n) in m of world points (..., n, 3) for poses (..., 4, 4).

    Points with depth <= 0 lie behind the camera; their picture points are undefined.
    """
    rotation, position_m = camera_to_world[..., :3, :3], camera_to_world[..., None, :3, 3]
    local = (points_m - position_m) @ rotation
    depth_m = local[..., 2]
    safe_m = np.where(depth_m > 0, depth_m, 1.0)
    scaled = local[..., :2] * (np.array(intrinsics.focal_px) / safe_m[..., None])
    return scaled + np.array(intrinsics.centre_px), depth_m
