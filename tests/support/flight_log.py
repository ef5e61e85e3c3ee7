"""Logs of flights, as ground stations record them: MAVLink messages with the time of each."""

from __future__ import annotations

import socket
import struct
from pathlib import Path

import numpy as np
from pymavlink import mavutil
from pymavlink.dialects.v20 import common
from pymavlink.quaternion import Quaternion

from earth import axes_at, earth_coordinates_m

_GIMBAL = common.GIMBAL_DEVICE_FLAGS_ROLL_LOCK | common.GIMBAL_DEVICE_FLAGS_PITCH_LOCK


def position_of(origin: tuple[float, float, float], point_m: np.ndarray) -> tuple[float, float, float]:
    """Latitude, longitude [deg] and height [m] of a point, by Newton's method on the way there."""
    position = np.array(origin, float)
    target_m = earth_coordinates_m(*origin) + axes_at(*origin[:2]).T @ point_m
    for _ in range(4):
        off_m = axes_at(*position[:2]) @ (target_m - earth_coordinates_m(*position))
        across_m = 6.37e6 * np.cos(np.deg2rad(position[0]))
        position += [np.rad2deg(off_m[1] / 6.37e6), np.rad2deg(off_m[0] / across_m), off_m[2]]
    return tuple(position)


def write_log(path: Path, origin: tuple[float, float, float], times_s, poses, hz: float = 50) -> None:
    """A log of a drone whose camera takes these poses; the body leans as it likes. Positions have the 1e-7 degrees and
    millimetres of the message, so 1 cm."""
    link = common.MAVLink(None, srcSystem=1, srcComponent=1)
    with path.open("wb") as file:
        for time_s in np.arange(times_s[0], times_s[-1], 1 / hz):
            place_m = [np.interp(time_s, times_s, poses[:, k, 3]) for k in range(3)]
            axes = np.array(
                [[np.interp(time_s, times_s, poses[:, k, axis]) for k in range(3)] for axis in (0, 2)]
            )
            for message in _messages_at(origin, np.array(place_m), *axes, time_s - times_s[0]):
                file.write(struct.pack(">Q", round(time_s * 1e6)) + message.pack(link))


def _messages_at(origin, place_m, right, forward, time_s: float):
    latitude_deg, longitude_deg, height_m = position_of(origin, place_m)
    yaw, pitch = np.arctan2(forward[0], forward[1]), np.arcsin(forward[2] / np.linalg.norm(forward))
    level = np.array([np.cos(yaw), -np.sin(yaw), 0])
    roll = np.arctan2(right @ np.cross(forward, level), right @ level)
    boot_ms = round(1e3 * time_s)
    yield common.MAVLink_heartbeat_message(2, 3, 0, 0, 4, 3)
    yield common.MAVLink_attitude_message(boot_ms, 0.1 * np.sin(time_s), -0.2, yaw + 0.3, 0, 0, 0)
    yield common.MAVLink_gimbal_device_attitude_status_message(
        0, 0, boot_ms, _GIMBAL | common.GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME, Quaternion([roll, pitch, yaw]).q,
        0, 0, 0, 0,
    )  # fmt: skip
    yield common.MAVLink_global_position_int_message(
        boot_ms, round(latitude_deg * 1e7), round(longitude_deg * 1e7), round(height_m * 1e3), 0, 0, 0, 0, 0
    )


def send(datagram: bytes, to: tuple[str, int]) -> None:
    """Send one; on this machine it has arrived afterwards."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        out.sendto(datagram, to)


def read_log(path: Path) -> list[tuple[float, bytes]]:
    """A log's messages, with the times [s] from the first on."""
    log = mavutil.mavlink_connection(str(path), dialect="common")
    messages = list(iter(log.recv_msg, None))
    return [(one._timestamp - messages[0]._timestamp, bytes(one.get_msgbuf())) for one in messages]
