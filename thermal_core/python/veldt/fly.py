"""Fly a planned place by the poses that arrive over UDP, and send what the camera sees (`python -m veldt.fly`)."""

from __future__ import annotations

import argparse
import json
import socket
import sys
import time
from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from veldt import ConfigError, Error, IoError, Stream
from veldt._core import check_is_loopback, frames_to_leave_out
from .mavlink import Vehicle
from .poses import pose_of_attitude
from .world import Capture, World

_MOST_BYTES = 65_535  # of a datagram


class Sink(Protocol):
    """Where frames go: veldt.Stream."""

    def send(self, ir8: NDArray[np.uint8], line: dict, number: int) -> bool:
        """False if the frame was dropped."""


class Poses:
    """The poses that arrive as datagrams: MAVLink, or JSON with `camera_to_world` (4 x 4), or with `position_m` (east,
    north, up) and `yaw_deg` (from north, clockwise), `pitch_deg` (up), `roll_deg`. The last kind that came counts.
    """

    def __init__(self, address: tuple[str, int], vehicle: Vehicle) -> None:
        """IoError if nothing can be received at the address."""
        try:
            family, _, _, _, bound_to = socket.getaddrinfo(*address, type=socket.SOCK_DGRAM)[0]
            self._socket = socket.socket(family, socket.SOCK_DGRAM)
            self._socket.bind(bound_to)
        except OSError as error:
            raise IoError(f"{address[0]}:{address[1]}: {error.strerror}; expected a free UDP port") from error
        self.port: int = self._socket.getsockname()[1]
        self._vehicle = vehicle
        self._given: NDArray[np.float64] | None = None
        self.received = 0
        self.rejected: list[str] = []
        """What was wrong with datagrams of JSON, the last ten of them."""

    def receive_until(self, time_s: float, clock: Callable[[], float]) -> None:
        """Take all datagrams that arrive until a time of the clock, and those that are there already."""
        while True:
            self._socket.settimeout(max(time_s - clock(), 0) or 0.0)
            try:
                datagram = self._socket.recv(_MOST_BYTES)
            except (BlockingIOError, TimeoutError):
                return
            self.received += 1
            if datagram.lstrip().startswith(b"{"):
                self._take_json(datagram)
            else:
                self._given = None
                self._vehicle.receive(datagram, clock())

    def pose_at(self, time_s: float) -> NDArray[np.float64] | None:
        """The pose at a time of the clock, None before there is one."""
        return self._vehicle.pose_at(time_s) if self._given is None else self._given

    def close(self) -> None:
        """Receive nothing more."""
        self._socket.close()

    def _take_json(self, datagram: bytes) -> None:
        try:
            self._given = pose_of_json(datagram)
        except ConfigError as error:
            self.rejected = [*self.rejected[-9:], str(error)]


def pose_of_json(text: bytes | str) -> NDArray[np.float64]:
    """A pose (4, 4) of one JSON object, as Poses takes it; a matrix is made a rotation if it is one to within 1e-3.
    ConfigError for another text."""
    try:
        given = json.loads(text)
        if "camera_to_world" in given:
            return _rotation_and_place(np.array(given["camera_to_world"], float))
        angles_rad = np.deg2rad([float(given.get(f"{name}_deg", 0)) for name in ("roll", "pitch", "yaw")])
        pose = pose_of_attitude(np.array(given["position_m"], float).reshape(3), *angles_rad)
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise ConfigError(
            f"pose: {type(error).__name__}: {error}; expected camera_to_world or position_m"
        ) from error
    if not np.isfinite(pose).all():
        raise ConfigError("pose: not a number; expected numbers")
    return pose


def _rotation_and_place(pose: NDArray[np.float64]) -> NDArray[np.float64]:
    if pose.shape != (4, 4) or not np.isfinite(pose).all():
        raise ConfigError("camera_to_world: expected 4 x 4 numbers")
    left, scales, right = np.linalg.svd(pose[:3, :3])
    if np.abs(scales - 1).max() > 1e-3 or np.linalg.det(left @ right) < 0:
        raise ConfigError("camera_to_world: expected a rotation and a place")
    rotated = np.eye(4)
    rotated[:3, :3], rotated[:3, 3] = left @ right, pose[:3, 3]
    return rotated


class Flight(NamedTuple):
    """What became of a flight's frames."""

    sent: int
    dropped: int
    """Not made in time, or not sent."""
    worst_s: float
    """The longest that a frame was late, when it was handed over."""


def fly(
    world: World,
    poses: Poses,
    sink: Sink,
    clock: Callable[[], float] = time.monotonic,
    seconds: float | None = None,
) -> Flight:
    """Send the camera's frames at their true rate from the first pose on, until the plan's time or `seconds` are over.
    A frame that is late by more than a frame is dropped, and the camera goes on."""
    while poses.pose_at(clock()) is None:
        poses.receive_until(clock() + 0.01, clock)
    start_s, frame, sent, worst_s = clock(), 0, 0, 0.0
    length_s = world.flight_s[-1] - world.flight_s[0]
    count = int(np.floor(min(length_s, seconds or length_s) * world.frame_rate_hz + 1e-6)) + 1
    while frame < count:
        due_s = start_s + frame / world.frame_rate_hz
        poses.receive_until(due_s, clock)
        pose = poses.pose_at(due_s)
        time_s = float(world.flight_s[0] + frame / world.frame_rate_hz)
        capture = world.capture(pose, time_s)
        line = {"stream_s": frame / world.frame_rate_hz, "frame": frame, "left_out": frame - sent}
        sent += sink.send(capture.ir8, line | line_of(time_s, pose, capture), frame)
        late_s = clock() - due_s
        worst_s = max(worst_s, late_s)
        frame += 1 + frames_to_leave_out(late_s, world.frame_rate_hz)
    return Flight(sent, count - sent, worst_s)


def line_of(time_s: float, pose: NDArray[np.float64], capture: Capture) -> dict:
    """What is known of a frame, as `veldt stream` says it."""
    return {
        "time_s": time_s,
        "camera_to_world": pose.tolist(),
        "shutter_closed": capture.shutter_closed,
        "labels": [{"category": label.category} | label.values for label in capture.labels],
    }


def _address(text: str) -> tuple[str, int]:
    host, _, port = text.rpartition(":")
    return host.strip("[]") or "127.0.0.1", int(port)


def _origin(text: str) -> tuple[float, float, float]:
    latitude_deg, longitude_deg, height_m = map(float, text.split(","))
    return latitude_deg, longitude_deg, height_m


def _check_addresses(given: argparse.Namespace) -> None:
    """ConfigError for an address that others can reach."""
    host, port = given.poses
    addresses = {"--poses": f"udp://{host}:{port or 1}", "--video": given.video, "--labels": given.labels}
    for option, url in addresses.items():
        if url is not None:
            check_is_loopback(url, option, "--allow-remote")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m veldt.fly",
        description="Fly a planned place by the poses that arrive over UDP (MAVLink of ArduPilot or PX4, or JSON), and "
        "send what the camera sees at its true rate, with labels. The flight begins with the first pose.",
        epilog="Example: python -m veldt.fly plan night --poses 127.0.0.1:14550 --video udp://127.0.0.1:5600 "
        "--labels tcp://127.0.0.1:5601",
    )
    parser.add_argument("plan", help="folder of a plan with render.engine embree and render.posed_actors all")
    parser.add_argument("clip", help="its clip: the place, the time and the camera")
    parser.add_argument(
        "--poses",
        type=_address,
        default=("127.0.0.1", 14550),
        metavar="HOST:PORT",
        help="where poses arrive; 127.0.0.1:14550 by default",
    )
    parser.add_argument(
        "--origin",
        type=_origin,
        metavar="LAT,LON,M",
        help="where the scene's (0, 0, 0) is, its height as the autopilot counts it; by default the "
        "planned flight begins at the first position",
    )
    parser.add_argument(
        "--down",
        type=float,
        default=45,
        metavar="DEG",
        help="of a camera without a gimbal's messages: below the drone's front (45)",
    )
    parser.add_argument("--rate", type=float, metavar="HZ", help="frames a second; the clip's by default")
    parser.add_argument("--seconds", type=float, help="stop after this time; by default with the plan's")
    parser.add_argument("--video", required=True, metavar="URL", help="where frames go, as of `veldt stream`")
    parser.add_argument("--labels", metavar="URL", help="where a JSON line a frame goes")
    parser.add_argument("--allow-remote", action="store_true", help="accept addresses that others can reach")
    return parser


def main(arguments: list[str] | None = None) -> int:
    """The command; the exit codes of `veldt`."""
    given = _parser().parse_args(arguments)
    try:
        if not given.allow_remote:
            _check_addresses(given)
        world = World(given.plan, given.clip, frame_rate_hz=given.rate)
        vehicle = Vehicle(world.flight_poses[0][:3, 3], given.origin, np.deg2rad(given.down))
        poses = Poses(given.poses, vehicle)
        size = {"width_px": world.camera.width_px, "height_px": world.camera.height_px}
        with Stream(
            given.video,
            **size,
            frame_rate_hz=world.frame_rate_hz,
            labels_url=given.labels,
            allow_remote=given.allow_remote,
        ) as stream:
            print(f"waiting for poses on UDP port {poses.port}", file=sys.stderr, flush=True)
            done = fly(world, poses, stream, seconds=given.seconds)
    except Error as error:
        print(f"veldt.fly: {error}", file=sys.stderr)
        return 2 if isinstance(error, ConfigError) else 1
    except KeyboardInterrupt:
        return 130
    sent, lines_missed, fault = stream.counts.sent, stream.counts.lines_missed, stream.counts.fault
    dropped = done.sent + done.dropped - sent
    print(
        f"{sent} frames sent, {dropped} dropped, {lines_missed} lines missed, the latest "
        f"{1e3 * done.worst_s:.0f} ms late; {poses.received} datagrams received, {len(poses.rejected)} rejected"
    )
    for text in [*poses.rejected, fault] if fault else poses.rejected:
        print(f"veldt.fly: {text}", file=sys.stderr)
    return 3 if poses.rejected or dropped or lines_missed else 0


if __name__ == "__main__":
    sys.exit(main())
