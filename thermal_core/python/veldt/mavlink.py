"""Where a drone's camera is, by the MAVLink messages that its autopilot sends; needs pymavlink."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pymavlink.dialects.v20 import common

from veldt._core import PlaceOnEarth
from .poses import pose_of_rotation, rotation_of_attitude, rotation_of_quaternion

_LONGEST_S = 1.0  # that a message is carried on by its speeds; afterwards the drone stays


class Vehicle:
    """A drone: position by GLOBAL_POSITION_INT, attitude by ATTITUDE, and its camera by
    GIMBAL_DEVICE_ATTITUDE_STATUS or MOUNT_ORIENTATION. Between messages it goes on with their
    speeds, for a second at most.

    The first system that says where it is counts; others are ignored. A camera without a gimbal's messages is fixed to
    the body, and looks `down_rad` below its front.
    """

    def __init__(
        self,
        start_m: ArrayLike,
        origin: tuple[float, float, float] | None = None,
        down_rad: float = np.pi / 4,
    ) -> None:
        """origin: latitude, longitude [deg] and height [m] of the scene's (0, 0, 0), of the heights that the autopilot
        sends (above the sea). None: the first position is start_m, east, north and up [m].

        ConfigError for a latitude beyond 89 deg and the like.
        """
        self._start_m = np.asarray(start_m, float) if origin is None else np.zeros(3)
        self._place = None if origin is None else PlaceOnEarth(origin)
        self._fixed = rotation_of_attitude(0, -down_rad, 0)
        self._system: int | None = None
        self._last: dict[str, tuple[float, Any]] = {}

    def receive(self, data: bytes, arrived_s: float) -> None:
        """Take a datagram that arrived at a time [s] of the caller's clock: whole messages. What is none, or of no
        use, is ignored."""
        parser = common.MAVLink(None)  # a new one: what a broken datagram leaves must not spoil the next
        parser.robust_parsing = True
        for message in parser.parse_buffer(data) or []:
            kind = message.get_type()
            if kind == "GLOBAL_POSITION_INT" and self._system is None:
                self._system = message.get_srcSystem()
            if message.get_srcSystem() == self._system:
                self._last[kind] = (arrived_s, message)

    def pose_at(self, time_s: float) -> NDArray[np.float64] | None:
        """The camera's pose (4, 4) at a time [s] of the same clock; None before position and attitude have come."""
        body = self._body_at(time_s)
        if body is None or "GLOBAL_POSITION_INT" not in self._last:
            return None
        return pose_of_rotation(self._place_at(time_s), self._camera_at(time_s, body))

    def _age_s(self, kind: str, time_s: float) -> float:
        return float(np.clip(time_s - self._last[kind][0], 0, _LONGEST_S))

    def _place_at(self, time_s: float) -> NDArray[np.float64]:
        _, message = self._last["GLOBAL_POSITION_INT"]
        position = (message.lat * 1e-7, message.lon * 1e-7, message.alt * 1e-3)
        if self._place is None:
            self._place = PlaceOnEarth(position)
        speed_m_s = np.array([message.vy, message.vx, -message.vz]) * 1e-2
        return (
            self._start_m
            + self._place.point_at(position)
            + speed_m_s * self._age_s("GLOBAL_POSITION_INT", time_s)
        )

    def _body_at(self, time_s: float) -> NDArray[np.float64] | None:
        if "ATTITUDE" not in self._last:
            return None
        _, message = self._last["ATTITUDE"]
        rates_rad_s = (message.rollspeed, message.pitchspeed, message.yawspeed)
        body = rotation_of_attitude(message.roll, message.pitch, message.yaw)
        return body @ _turned(rates_rad_s, self._age_s("ATTITUDE", time_s))

    def _camera_at(self, time_s: float, body: NDArray[np.float64]) -> NDArray[np.float64]:
        heading = rotation_of_attitude(0, 0, np.arctan2(body[1, 0], body[0, 0]))
        if "GIMBAL_DEVICE_ATTITUDE_STATUS" in self._last:
            _, message = self._last["GIMBAL_DEVICE_ATTITUDE_STATUS"]
            rates_rad_s = (message.angular_velocity_x, message.angular_velocity_y, message.angular_velocity_z)
            camera = rotation_of_quaternion(*message.q)
            camera = camera @ _turned(rates_rad_s, self._age_s("GIMBAL_DEVICE_ATTITUDE_STATUS", time_s))
            return camera if _yaw_is_from_north(message.flags) else heading @ camera
        if "MOUNT_ORIENTATION" in self._last:
            _, message = self._last["MOUNT_ORIENTATION"]
            angles_rad = np.deg2rad([message.roll, message.pitch, message.yaw])
            return heading @ rotation_of_attitude(*angles_rad)
        return body @ self._fixed


def _turned(rates_rad_s: tuple[float, float, float], for_s: float) -> NDArray[np.float64]:
    """The turn of a body in a time by its rates about its axes; unknown ones (not a number) are 0. For the small angles
    of a few frames: the error is a twelfth of the angle cubed."""
    half = np.nan_to_num(np.array(rates_rad_s, float)) * for_s / 2
    return rotation_of_quaternion(1, *half)


def _yaw_is_from_north(flags: int) -> bool:
    """As the message's definition says: by the flags of the frame, else by the lock of yaw."""
    if flags & (
        common.GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME | common.GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME
    ):
        return bool(flags & common.GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME)
    return bool(flags & common.GIMBAL_DEVICE_FLAGS_YAW_LOCK)
