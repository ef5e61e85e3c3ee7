"""Poses of cameras: (4, 4) from OpenCV's axes (x right, y down, z forward) to east, north, up [m]."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .rejections import number_within

FARTHEST_M = 10_000.0  # from the scene's (0, 0, 0), along each axis: scenes reach 5 km
_NED_TO_ENU = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1.0]])
_CAMERA_TO_BODY = np.array(
    [[0, 0, 1], [1, 0, 0], [0, 1, 0.0]]
)  # a camera that looks to the front of a level body


def pose_looking(place_m: ArrayLike, heading_rad: float, down_rad: float) -> NDArray[np.float64]:
    """A pose without roll: heading counter-clockwise from east, `down_rad` below the horizon."""
    return pose_of_attitude(place_m, 0, -down_rad, np.pi / 2 - heading_rad)


def pose_of_attitude(
    place_m: ArrayLike, roll_rad: float, pitch_rad: float, yaw_rad: float
) -> NDArray[np.float64]:
    """A pose from aviation angles: yaw clockwise from north, then pitch up from the horizon, then roll to the right."""
    return pose_of_rotation(place_m, rotation_of_attitude(roll_rad, pitch_rad, yaw_rad))


def rotation_of_attitude(roll_rad: float, pitch_rad: float, yaw_rad: float) -> NDArray[np.float64]:
    """Rotation from a body's axes (front, right, down) to north, east, down (3, 3)."""
    (cos_r, cos_p, cos_y), (sin_r, sin_p, sin_y) = (
        f([roll_rad, pitch_rad, yaw_rad]) for f in (np.cos, np.sin)
    )
    yaw = np.array([[cos_y, -sin_y, 0], [sin_y, cos_y, 0], [0, 0, 1]])
    pitch = np.array([[cos_p, 0, sin_p], [0, 1, 0], [-sin_p, 0, cos_p]])
    roll = np.array([[1, 0, 0], [0, cos_r, -sin_r], [0, sin_r, cos_r]])
    return yaw @ pitch @ roll


def rotation_of_quaternion(w: float, x: float, y: float, z: float) -> NDArray[np.float64]:
    """Rotation of a quaternion of any length but 0, real part first (3, 3)."""
    w, x, y, z = np.array([w, x, y, z]) / np.linalg.norm([w, x, y, z])
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def checked_place(where: str, place_m: Iterable[object]) -> NDArray[np.float64]:
    """A received position (3,), east, north, up [m]. Unusable if it is invalid, or beyond FARTHEST_M along an axis."""
    return np.array([number_within(where, one, "m", -FARTHEST_M, FARTHEST_M) for one in place_m])


def pose_of_rotation(place_m: ArrayLike, body_to_ned: NDArray[np.float64]) -> NDArray[np.float64]:
    """Pose of a camera that looks to the front of a body at a position (3,) east, north, up [m]."""
    pose = np.eye(4)
    pose[:3, :3] = _NED_TO_ENU @ body_to_ned @ _CAMERA_TO_BODY
    pose[:3, 3] = place_m
    return pose
