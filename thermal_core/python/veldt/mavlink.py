"""Poses of a drone's camera from its autopilot's MAVLink messages; needs pymavlink."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pymavlink.dialects.v20 import common

from veldt._core import Georeference
from .poses import checked_place, pose_of_rotation, rotation_of_attitude, rotation_of_quaternion
from .rejections import Unusable, number_within

_LONGEST_S = 1.0  # how long a message is extrapolated by its speeds; then the drone is taken to stand still
_MOST_LATITUDE_DEG = 89.0  # nearer to a pole, east is ill-defined
_HEIGHTS_M = (-1_000.0, 20_000.0)
_MOST_M_S = 200.0
_MOST_RAD_S = 100.0
_MOST_RAD = 200 * np.pi  # a hundred turns
_UNKNOWN_SPEEDS = (32_767, -32_768)  # [cm/s] the limits of the field's type


class Received(NamedTuple):
    """Counts of a datagram's messages."""

    used: int
    """Messages with a position or an attitude."""
    faults: list[Unusable]
    """Dropped messages. Valid messages of other kinds are not counted."""


class _Motion(NamedTuple):
    """State from one message."""

    arrived_s: float
    now: NDArray[np.float64]
    """A position (3,) [m], or a rotation (3, 3)."""
    rates: NDArray[np.float64]
    """Rates of change (3,) per second."""
    from_north: bool = False


class Vehicle:
    """A drone: position by GLOBAL_POSITION_INT, attitude by ATTITUDE, and its camera by GIMBAL_DEVICE_ATTITUDE_STATUS
    or MOUNT_ORIENTATION. Between messages it is extrapolated by their speeds, for a second at most.

    The first system with a position is used; poses of others are dropped. A camera without gimbal messages is fixed to
    the body, and looks `down_rad` below its front.

    A message is dropped, and the previous state kept, if its position is 0/0 (no fix), beyond 89 degrees of latitude or
    180 of longitude, not -1 to 20 km high, or 10 km from the scene's (0, 0, 0) along an axis; if it moves by more than
    200 m/s along an axis, or turns by more than 100 rad/s; if an angle is not a number or beyond a hundred turns, or a
    quaternion not of length 1 to within a tenth. Unknown speeds and rates (not a number, or the ends of a whole
    number's type) count as 0.
    """

    def __init__(
        self,
        start_m: ArrayLike,
        origin: tuple[float, float, float] | None = None,
        down_rad: float = np.pi / 4,
    ) -> None:
        """origin: latitude, longitude [deg] and height [m] of the scene's (0, 0, 0), in the autopilot's heights (above
        the sea). None: the first position is start_m, east, north and up [m].

        ConfigError for invalid positions, such as a latitude beyond 89 deg.
        """
        self._start_m = np.asarray(start_m, float) if origin is None else np.zeros(3)
        self._place = None if origin is None else Georeference(origin)
        self._fixed = rotation_of_attitude(0, -down_rad, 0)
        self._system: int | None = None
        self._last: dict[str, _Motion] = {}
        self._early: dict[int, dict[str, _Motion]] = {}  # by system, until one has a position
        self._readers = {
            "GLOBAL_POSITION_INT": self._position,
            "ATTITUDE": _attitude,
            "GIMBAL_DEVICE_ATTITUDE_STATUS": _gimbal,
            "MOUNT_ORIENTATION": _mount,
        }

    def receive(self, data: bytes, arrived_s: float) -> Received:
        """Process a datagram of complete messages that arrived at a time [s] of the caller's clock."""
        parser = common.MAVLink(None)  # a new one, because a broken datagram leaves state behind
        parser.robust_parsing = True
        used, faults, is_whole = 0, [], True
        for message in parser.parse_buffer(data) or []:
            try:
                used += self._take(message, arrived_s)
            except Unusable as fault:
                faults.append(fault)
            is_whole = is_whole and message.get_type() != "BAD_DATA"
        if not data or not is_whole or parser.buf_len() > 0:
            faults.append(
                Unusable("not MAVLink", "datagram", f"{len(data)} bytes", "MAVLink, or an object of JSON")
            )
        return Received(used, faults)

    def pose_at(self, time_s: float) -> NDArray[np.float64] | None:
        """The camera's pose (4, 4) at a time [s] of the same clock; None before position and attitude have come."""
        position, attitude = self._last.get("GLOBAL_POSITION_INT"), self._last.get("ATTITUDE")
        if position is None or attitude is None:
            return None
        place_m = position.now + position.rates * _age_s(position, time_s)
        return pose_of_rotation(place_m, self._camera_at(time_s, _turned(attitude, time_s)))

    def _take(self, message: Any, arrived_s: float) -> bool:
        """Process a message; whether it is used."""
        kind, system = message.get_type(), message.get_srcSystem()
        if kind not in self._readers:
            return False
        if self._system not in (None, system):
            raise Unusable(
                "another system", f"{kind}: system", str(system), f"{self._system}, which came first"
            )
        motion = self._readers[kind](message, arrived_s)
        if kind == "GLOBAL_POSITION_INT" and self._system is None:
            self._system, self._last = system, self._early.get(system, {})
            self._early = {}
        heard = self._early.setdefault(system, {}) if self._system is None else self._last
        heard[kind] = motion
        return True

    def _position(self, message: Any, arrived_s: float) -> _Motion:
        kind = "GLOBAL_POSITION_INT"
        if message.lat == 0 and message.lon == 0:
            raise Unusable("no fix", f"{kind}.lat, lon", "0, 0 deg", "a position")
        position = (
            number_within(f"{kind}.lat", message.lat * 1e-7, "deg", -_MOST_LATITUDE_DEG, _MOST_LATITUDE_DEG),
            number_within(f"{kind}.lon", message.lon * 1e-7, "deg", -180, 180),
            number_within(f"{kind}.alt", message.alt * 1e-3, "m", *_HEIGHTS_M),
        )
        speed_m_s = [_speed(f"{kind}.{name}", getattr(message, name)) for name in ("vy", "vx", "vz")]
        place = self._place or Georeference(position)
        place_m = checked_place(f"{kind}: place", (self._start_m + place.point_at(position)).tolist())
        self._place = place
        return _Motion(arrived_s, place_m, speed_m_s * np.array([1, 1, -1]))

    def _camera_at(self, time_s: float, body: NDArray[np.float64]) -> NDArray[np.float64]:
        heading = rotation_of_attitude(0, 0, np.arctan2(body[1, 0], body[0, 0]))
        camera = self._last.get("GIMBAL_DEVICE_ATTITUDE_STATUS") or self._last.get("MOUNT_ORIENTATION")
        if camera is None:
            return body @ self._fixed
        turned = _turned(camera, time_s)
        return turned if camera.from_north else heading @ turned


def _attitude(message: Any, arrived_s: float) -> _Motion:
    kind = "ATTITUDE"
    angles_rad = [
        number_within(f"{kind}.{name}", getattr(message, name), "rad", -_MOST_RAD, _MOST_RAD)
        for name in ("roll", "pitch", "yaw")
    ]
    rates_rad_s = _rates(kind, message, ("rollspeed", "pitchspeed", "yawspeed"))
    return _Motion(arrived_s, rotation_of_attitude(*angles_rad), rates_rad_s)


def _gimbal(message: Any, arrived_s: float) -> _Motion:
    kind = "GIMBAL_DEVICE_ATTITUDE_STATUS"
    rates_rad_s = _rates(kind, message, ("angular_velocity_x", "angular_velocity_y", "angular_velocity_z"))
    number_within(f"{kind}: length of q", float(np.linalg.norm(message.q)), "", 0.9, 1.1)
    return _Motion(
        arrived_s, rotation_of_quaternion(*message.q), rates_rad_s, _yaw_is_from_north(message.flags)
    )


def _mount(message: Any, arrived_s: float) -> _Motion:
    most_deg = np.rad2deg(_MOST_RAD)
    angles_deg = [
        number_within(f"MOUNT_ORIENTATION.{name}", getattr(message, name), "deg", -most_deg, most_deg)
        for name in ("roll", "pitch", "yaw")
    ]
    return _Motion(arrived_s, rotation_of_attitude(*np.deg2rad(angles_deg)), np.zeros(3))


def _speed(where: str, speed_cm_s: int) -> float:
    if speed_cm_s in _UNKNOWN_SPEEDS:
        return 0.0
    return number_within(where, speed_cm_s * 1e-2, "m/s", -_MOST_M_S, _MOST_M_S)


def _rates(kind: str, message: Any, names: Iterable[str]) -> NDArray[np.float64]:
    """Rates of a body about its axes [rad/s]; unknown ones are 0."""
    given = {name: getattr(message, name) for name in names}
    return np.array([
        0.0 if np.isnan(rate) else number_within(f"{kind}.{name}", rate, "rad/s", -_MOST_RAD_S, _MOST_RAD_S)
        for name, rate in given.items()
    ])  # fmt: skip


def _age_s(motion: _Motion, time_s: float) -> float:
    return min(max(time_s - motion.arrived_s, 0.0), _LONGEST_S)


def _turned(body: _Motion, time_s: float) -> NDArray[np.float64]:
    """A body's rotation, extrapolated by its rates. For the small angles of a few frames: the error is a twelfth of the
    angle cubed.
    """
    half = body.rates * _age_s(body, time_s) / 2
    return body.now @ rotation_of_quaternion(1, *half)


def _yaw_is_from_north(flags: int) -> bool:
    """By the message's definition: from the flags of the frame, else from the lock of yaw."""
    if flags & (
        common.GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME | common.GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME
    ):
        return bool(flags & common.GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME)
    return bool(flags & common.GIMBAL_DEVICE_FLAGS_YAW_LOCK)
