"""The camera in Blender."""

from __future__ import annotations

import bpy
import mathutils
import numpy as np

from veldt.camera import Intrinsics

_SENSOR_MM = 36.0  # any value will do: only its ratio to the focal length counts
_CLIP_M = (0.1, 20000.0)
_FROM_OPENCV = np.diag([1.0, -1.0, -1.0, 1.0])  # Blender's cameras look along -z with y up


def add_camera(intrinsics: Intrinsics) -> bpy.types.Object:
    """A camera with these intrinsics, made the scene's own."""
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit = "HORIZONTAL"
    lens.sensor_width = _SENSOR_MM
    lens.lens = _SENSOR_MM * intrinsics.f_px / intrinsics.width_px
    lens.clip_start, lens.clip_end = _CLIP_M
    camera = bpy.data.objects.new("camera", lens)
    camera.rotation_mode = "QUATERNION"
    scene = bpy.context.scene
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def place(camera: bpy.types.Object, camera_to_world: np.ndarray) -> None:
    """Puts the camera where a pose (4, 4) is."""
    matrix = mathutils.Matrix((camera_to_world @ _FROM_OPENCV).tolist())
    camera.location = matrix.to_translation()
    camera.rotation_quaternion = matrix.to_quaternion()
