"""Fly through a planned scene by poses received over UDP, and send the camera's frames (`python -m veldt.fly`)."""

from __future__ import annotations

import argparse
import json
import math
import socket
import sys
import time
from collections import deque
from collections.abc import Callable
from contextlib import closing, suppress
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from veldt import ConfigError, Error, IoError, Stream
from veldt._core import check_is_loopback, frames_to_leave_out
from .mavlink import Vehicle
from .pose_json import pose_of_json
from .rejections import Rejections, Unusable
from .world import Capture, World

_MOST_BYTES = 4_096  # of a datagram
_MOST_HELD = 256  # datagrams, about the capacity of a socket
_TAKE_S = 0.002
_PAUSE_S = 0.03
_REPORT_EACH_S = 60.0


def _nothing(_: str) -> None:
    """Report nothing."""


class Sink(Protocol):
    """Destination of frames: veldt.Stream."""

    def send(self, ir8: NDArray[np.uint8], line: dict, number: int) -> bool:
        """False if the frame was dropped."""


class Poses:
    """Poses received as datagrams: MAVLink for Vehicle, or JSON for pose_of_json(), whichever arrived last. Unusable
    datagrams, and those of more than 4,096 bytes, are counted in `rejected`, reported, and otherwise ignored.
    """

    def __init__(
        self, address: tuple[str, int], vehicle: Vehicle, report: Callable[[str], None] = _nothing
    ) -> None:
        """report: receives a line of text about rejected datagrams, at most once a minute for each reason.

        IoError if the address cannot be bound.
        """
        try:
            self._socket = _bound_socket(address)
        except (OSError, UnicodeError) as error:
            reason = getattr(error, "strerror", "unknown host")
            raise IoError(f"{address[0]}:{address[1]}: {reason}; expected a free UDP port") from error
        self.port: int = self._socket.getsockname()[1]
        self._vehicle = vehicle
        self._given: NDArray[np.float64] | None = None
        self._held: deque[bytes] = deque(maxlen=_MOST_HELD)
        self.received = 0
        self.of_no_use = 0
        """Datagrams of valid MAVLink messages without a pose."""
        self.rejected = Rejections(report)

    def receive_until(self, time_s: float, clock: Callable[[], float]) -> None:
        """Process datagrams until a time of the clock; if that has passed, those that are queued. A flood does not
        delay frames or occupy the processor: at most the newest 256 datagrams are queued, and 2 ms of processing are
        followed by a pause of 30 ms or until the time.
        """
        wait_s = 0.0
        while True:
            self._hold(wait_s, clock)
            now_s = clock()
            end_s = min(now_s + _TAKE_S, time_s if now_s < time_s else math.inf)
            while self._held and clock() < end_s:
                self._take(self._held.popleft(), clock())
            left_s = time_s - clock()
            if left_s <= 0:
                return
            wait_s = left_s
            if self._held:
                time.sleep(min(_PAUSE_S, left_s))
                if left_s <= _PAUSE_S:
                    return  # after a pause, a frame starts at once even on a busy processor
                wait_s = 0.0

    def pose_at(self, time_s: float) -> NDArray[np.float64] | None:
        """The pose at a time of the clock, None before there is one."""
        return self._vehicle.pose_at(time_s) if self._given is None else self._given

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()

    def _hold(self, wait_s: float, clock: Callable[[], float]) -> None:
        """Wait for a datagram, and queue it and those behind it, up to twice the limit; the oldest are dropped."""
        before, dropped = self.received, 0
        self._socket.settimeout(wait_s)
        while self.received < before + 2 * _MOST_HELD:
            try:
                datagram = self._socket.recv(_MOST_BYTES + 1)
            except (BlockingIOError, TimeoutError):
                break
            self._socket.settimeout(0)
            self.received += 1
            dropped += len(self._held) == _MOST_HELD
            self._held.append(datagram)
        if dropped:
            fault = Unusable(
                "too many", "datagrams", f"{_MOST_HELD + dropped} at once", f"{_MOST_HELD} at most"
            )
            self.rejected.add(fault, clock(), dropped)

    def _take(self, datagram: bytes, now_s: float) -> None:
        try:
            if len(datagram) > _MOST_BYTES:
                raise Unusable("too long", "datagram", "more bytes", f"{_MOST_BYTES} at most")
            if datagram.lstrip().startswith(b"{"):
                self._given = pose_of_json(datagram)
            else:
                self._take_messages(datagram, now_s)
        except Unusable as fault:
            self.rejected.add(fault, now_s)

    def _take_messages(self, datagram: bytes, now_s: float) -> None:
        used, faults = self._vehicle.receive(datagram, now_s)
        if used and self._given is not None and self._vehicle.pose_at(now_s) is not None:
            self._given = None
        for fault in faults:
            self.rejected.add(fault, now_s)
        self.of_no_use += not used and not faults


def _bound_socket(address: tuple[str, int]) -> socket.socket:
    family, _, _, _, bound_to = socket.getaddrinfo(*address, type=socket.SOCK_DGRAM)[0]
    bound = socket.socket(family, socket.SOCK_DGRAM)
    try:
        bound.bind(bound_to)
    except OSError:
        bound.close()
        raise
    return bound


class Flight(NamedTuple):
    """Counts of a flight's frames."""

    sent: int
    dropped: int
    """Not made in time, or not sent."""
    worst_s: float
    """Largest lateness of a frame, when it was queued."""


def fly(
    world: World,
    poses: Poses,
    sink: Sink,
    clock: Callable[[], float] = time.monotonic,
    seconds: float | None = None,
    report: Callable[[str], None] = _nothing,
) -> Flight:
    """Send the camera's frames in real time from the first pose on, until the plan's time or `seconds` are over. A
    frame that is late by more than a frame is dropped, and the camera continues. While the first pose is missing,
    `report` receives a line of text each minute; only an exception, such as by Ctrl-C, ends the wait.

    ConfigError unless `seconds` are above 0.
    """
    if seconds is not None and not seconds > 0:
        raise ConfigError(f"seconds = {seconds:g} s; expected above 0")
    _wait_for_pose(poses, clock, report)
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


def _wait_for_pose(poses: Poses, clock: Callable[[], float], report: Callable[[str], None]) -> None:
    begun_s = clock()
    report_s = begun_s + _REPORT_EACH_S
    while poses.pose_at(clock()) is None:
        now_s = clock()
        poses.receive_until(now_s + 0.01, clock)
        if now_s >= report_s:
            report_s = now_s + _REPORT_EACH_S
            report(f"no pose for {now_s - begun_s:.0f} s; expected position and attitude of MAVLink, or JSON")


def line_of(time_s: float, pose: NDArray[np.float64], capture: Capture) -> dict:
    """Metadata of a frame, in the format of `veldt stream`."""
    return {
        "time_s": time_s,
        "camera_to_world": pose.tolist(),
        "shutter_closed": capture.shutter_closed,
        "labels": [{"category": label.category} | label.values for label in capture.labels],
    }


def _address(text: str) -> tuple[str, int]:
    host, _, port = text.rpartition(":")
    if not (port.isascii() and port.isdigit() and len(port) <= 5 and int(port) <= 65_535):
        raise ConfigError(f"--poses = {json.dumps(text)}; expected HOST:PORT, such as 127.0.0.1:14550")
    return host.strip("[]") or "127.0.0.1", int(port)


def _origin(text: str) -> tuple[float, float, float]:
    try:
        origin = latitude_deg, longitude_deg, height_m = tuple(map(float, text.split(",")))
        good = abs(latitude_deg) <= 89 and abs(longitude_deg) <= 180 and -1_000 <= height_m <= 20_000
    except ValueError:
        good = False
    if good:
        return origin
    raise ConfigError(
        f"--origin = {json.dumps(text)}; expected LAT,LON,M within 89 deg, 180 deg and -1000 to 20000 m, such as "
        "--origin=-19.3,23.1,940"
    )


def _number(option: str, unit: str, expected: str, fits: Callable[[float], bool]) -> Callable[[str], float]:
    """A parser of an option's finite number."""

    def read(text: str) -> float:
        try:
            number = float(text)
        except ValueError as error:
            raise ConfigError(f"{option} = {json.dumps(text)}; expected {expected}") from error
        if not (math.isfinite(number) and fits(number)):
            raise ConfigError(f"{option} = {number:g} {unit}; expected {expected}")
        return number

    return read


def _check_addresses(given: argparse.Namespace) -> None:
    """ConfigError for an address that others can reach, unless allowed, and for an unknown host for poses."""
    host, port = given.poses
    addresses = {"--poses": f"udp://{host}:{port or 1}", "--video": given.video, "--labels": given.labels}
    for option, url in addresses.items():
        if url is not None and not given.allow_remote:
            check_is_loopback(url, option, "--allow-remote")
    try:
        socket.getaddrinfo(host, port, type=socket.SOCK_DGRAM)
    except (socket.gaierror, UnicodeError) as error:
        raise ConfigError(
            f"--poses = {json.dumps(f'{host}:{port}')}; expected a known host, such as 127.0.0.1:14550"
        ) from error


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
        type=_number("--down", "deg", "-90 to 90, such as 45", lambda deg: abs(deg) <= 90),
        default=45,
        metavar="DEG",
        help="of a camera without a gimbal's messages: below the drone's front (45)",
    )
    parser.add_argument(
        "--rate",
        type=_number("--rate", "Hz", "0.1 to 240, such as 9", lambda hz: 0.1 <= hz <= 240),
        metavar="HZ",
        help="frames a second, 0.1 to 240; the clip's by default",
    )
    parser.add_argument(
        "--seconds",
        type=_number("--seconds", "s", "above 0, such as 60", lambda s: s > 0),
        help="stop after this time, above 0; by default with the plan's",
    )
    parser.add_argument("--video", required=True, metavar="URL", help="where frames go, as of `veldt stream`")
    parser.add_argument("--labels", metavar="URL", help="where a JSON line a frame goes")
    parser.add_argument("--allow-remote", action="store_true", help="accept addresses that others can reach")
    return parser


def _report(text: str) -> None:
    with suppress(OSError):  # a closed terminal does not end a flight
        print(f"veldt.fly: {text}", file=sys.stderr, flush=True)


def _run(given: argparse.Namespace) -> int:
    _check_addresses(given)
    world = World(given.plan, given.clip, frame_rate_hz=given.rate)
    vehicle = Vehicle(world.flight_poses[0][:3, 3], given.origin, np.deg2rad(given.down))
    size = {"width_px": world.camera.width_px, "height_px": world.camera.height_px}
    with (
        closing(Poses(given.poses, vehicle, _report)) as poses,
        Stream(
            given.video,
            **size,
            frame_rate_hz=world.frame_rate_hz,
            labels_url=given.labels,
            allow_remote=given.allow_remote,
        ) as stream,
    ):
        print(f"waiting for poses on UDP port {poses.port}", file=sys.stderr, flush=True)
        done = fly(world, poses, stream, seconds=given.seconds, report=_report)
    return _summary(done, poses, stream)


def _summary(done: Flight, poses: Poses, stream: Stream) -> int:
    """Print counts of frames and datagrams; returns the exit code."""
    counts, refused, rejected = stream.counts, stream.clients_refused, poses.rejected
    dropped = done.sent + done.dropped - counts.sent
    text = (
        f"{counts.sent} frames sent, {dropped} dropped, {counts.lines_missed} lines missed, the latest "
        f"{1e3 * done.worst_s:.0f} ms late; {poses.received} datagrams received, {poses.of_no_use} of no use, "
        f"{len(rejected)} rejected"
    )
    text += f" ({rejected})" if rejected else ""
    text += f"; {refused} clients refused" if refused else ""
    print(text)
    if counts.fault:
        _report(counts.fault)
    return 3 if rejected or dropped or counts.lines_missed or refused else 0


def main(arguments: list[str] | None = None) -> int:
    """The command; the exit codes of `veldt`."""
    try:
        return _run(_parser().parse_args(arguments))
    except Error as error:
        _report(str(error))
        return 2 if isinstance(error, ConfigError) else 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
