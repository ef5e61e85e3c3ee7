# SPDX-License-Identifier: GPL-3.0-or-later
"""The manifest of a clip, which describes its passes for `veldt convert`. No bpy."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass

LAYER = "Scene"
Matrix = Sequence[Sequence[float]]  # 4 rows of 4


@dataclass(frozen=True)
class Lens:
    """Parameters of Blender's perspective camera: focal length, sensor, shift in sizes of the picture's fitted side."""

    focal_mm: float
    sensor_width_mm: float
    sensor_height_mm: float
    sensor_fit: str  # AUTO, HORIZONTAL or VERTICAL
    shift_x: float = 0
    shift_y: float = 0


@dataclass(frozen=True)
class Intrinsics:
    """A pinhole camera's picture in OpenCV's axes; the centre of the top left pixel is at (0.5, 0.5)."""

    width_px: int
    height_px: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float


@dataclass(frozen=True)
class Frame:
    """One frame: its file, the moment in s, Blender's camera matrix in m, and the root matrix of each actor."""

    file: str
    time_s: float
    camera: Matrix
    actors: dict[int, Matrix]  # by object index


def intrinsics_of(lens: Lens, width_px: int, height_px: int) -> Intrinsics:
    """The intrinsics of Blender's camera for square pixels, by the rules of its manual: exact but for rounding.

    The sensor's width spans the picture's width if fitted horizontally, its height the height if fitted vertically;
    AUTO is the sensor's width along the longer side.
    """
    is_wide = lens.sensor_fit == "HORIZONTAL" or (lens.sensor_fit == "AUTO" and width_px >= height_px)
    side_px = width_px if is_wide else height_px
    sensor_mm = lens.sensor_height_mm if lens.sensor_fit == "VERTICAL" else lens.sensor_width_mm
    focal_px = lens.focal_mm * side_px / sensor_mm
    centre_px = (width_px / 2 - lens.shift_x * side_px, height_px / 2 + lens.shift_y * side_px)
    return Intrinsics(width_px, height_px, focal_px, focal_px, *centre_px)


def camera_to_world(matrix: Matrix) -> list[float]:
    """Row-major 4 x 4 for OpenCV's axes (y down, z forward) of Blender's camera matrix (y up, z back)."""
    return [value * sign for row in matrix for value, sign in zip(row, (1.0, -1.0, -1.0, 1.0))]


def clip_name(text: str) -> str:
    """A valid clip name from any text: letters, digits, _ and -, at most 200, not beginning with -."""
    return re.sub(r"[^A-Za-z0-9_-]", "_", text).lstrip("-")[:200] or "clip"


def frame_file(number: int) -> str:
    """The file name of a frame, counted from 0."""
    return f"{number:06d}.exr"


def build_manifest(
    clip: str,
    frame_rate_hz: float,
    supersample: int,
    intrinsics: Intrinsics,
    objects: list[dict],
    frames: Sequence[Frame],
) -> dict:
    """The manifest of a clip, by configs/schema/manifest.schema.json."""
    return {
        "format": "veldt-passes",
        "version": 1,
        "clip": clip,
        "frame_rate_hz": frame_rate_hz,
        "layer": LAYER,
        "supersample": supersample,
        "camera": asdict(intrinsics),
        "objects": objects,
        "materials": [],
        "frames": [_frame(frame) for frame in frames],
    }


def _frame(frame: Frame) -> dict:
    return {
        "file": frame.file,
        "time_s": frame.time_s,
        "camera_to_world": camera_to_world(frame.camera),
        "actors": [_actor(index, root) for index, root in sorted(frame.actors.items())],
    }


def _actor(index: int, root: Matrix) -> dict:
    return {
        "index": index,
        "position_m": [row[3] for row in root[:3]],
        "heading_rad": math.atan2(root[1][0], root[0][0]),
    }
