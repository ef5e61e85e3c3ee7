"""The camera in Blender."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import mathutils
import numpy as np

from planner.camera import DEPTH_RANGE_M, Intrinsics, lens_shift

_SENSOR_MM = 36.0  # arbitrary: only its ratio to the focal length matters
_FROM_OPENCV = np.diag([1.0, -1.0, -1.0, 1.0])  # Blender's cameras look along -z with y up


def add_camera(intrinsics: Intrinsics, depth_range_m: Sequence[float] = DEPTH_RANGE_M) -> bpy.types.Object:
    """Add a camera with these intrinsics and make it the scene's camera. The renderer sets their pixel aspect."""
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit = "HORIZONTAL"
    lens.sensor_width = _SENSOR_MM
    lens.clip_start, lens.clip_end = depth_range_m
    camera = bpy.data.objects.new("camera", lens)
    camera.parent = bpy.data.objects.new("camera mount", None)
    scene = bpy.context.scene
    scene.collection.objects.link(camera)
    scene.collection.objects.link(camera.parent)
    scene.camera = camera
    set_lens(camera, intrinsics)
    return camera


def set_lens(camera: bpy.types.Object, intrinsics: Intrinsics) -> None:
    """Give a camera other intrinsics."""
    lens = camera.data
    lens.lens = _SENSOR_MM * intrinsics.focal_px[0] / intrinsics.width_px
    lens.shift_x, lens.shift_y = lens_shift(intrinsics)


def place(camera: bpy.types.Object, camera_to_world: np.ndarray) -> None:
    """Move the camera to a pose (4, 4), as its matrix in single precision.

    A rotation in Blender would be off by up to 2e-7 rad, 2e-4 px at silhouettes. Only the matrix between an object and
    its parent is stored exactly.
    """
    camera.matrix_parent_inverse = mathutils.Matrix((camera_to_world @ _FROM_OPENCV).tolist())
