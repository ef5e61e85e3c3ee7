"""A pinhole camera: intrinsics, poses and projection.

Camera axes as OpenCV's: x right, y down, z forward. The centre of the top left pixel is at (0.5, 0.5).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .faults import ConfigError


@dataclass(frozen=True)
class Intrinsics:
    """Size and focal lengths in pixels; the principal point is the middle of the picture."""

    width_px: int
    height_px: int
    f_px: float

    @property
    def centre_px(self) -> tuple[float, float]:
        return self.width_px / 2, self.height_px / 2


def intrinsics_of(settings: dict) -> Intrinsics:
    """Intrinsics of the config's `camera`: f_px = focal length / pixel pitch."""
    f_px = settings["focal_length_m"] / (settings["pixel_pitch_um"] * 1e-6)
    return Intrinsics(settings["width_px"], settings["height_px"], f_px)


def overscan_of(config: dict) -> int:
    """How many px a config's passes reach beyond the picture on every side, for the lens to draw on.

    ConfigError if the lens distorts and nobody has worked it out: `veldt` does, before it starts Blender.
    """
    given_px = config["render"].get("overscan_px")
    if given_px is None and any(config["camera"]["distortion"].values()):
        raise ConfigError(
            "render.overscan_px is missing; expected what camera.distortion needs, which veldt fills in"
        )
    return given_px or 0


def widened(intrinsics: Intrinsics, overscan_px: int) -> Intrinsics:
    """The same camera with so many pixels more on every side."""
    return Intrinsics(
        intrinsics.width_px + 2 * overscan_px, intrinsics.height_px + 2 * overscan_px, intrinsics.f_px
    )


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

    Points with depth <= 0 lie behind the camera; their picture points mean nothing.
    """
    rotation, position_m = camera_to_world[..., :3, :3], camera_to_world[..., None, :3, 3]
    local = (points_m - position_m) @ rotation
    depth_m = local[..., 2]
    safe_m = np.where(depth_m > 0, depth_m, 1.0)
    scaled = local[..., :2] * (intrinsics.f_px / safe_m)[..., None]
    return scaled + np.array(intrinsics.centre_px), depth_m
