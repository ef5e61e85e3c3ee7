"""`veldt.fly`: poses in over UDP, frames out."""

import json
import re
import socket
import subprocess
import sys

import numpy as np
import pytest

from configs import tiny
from flight_log import read_log, send, write_log
from processes import PATIENCE_S
from veldt import ConfigError, IoError, World, plan
from veldt.fly import Poses, fly, line_of, main
from veldt.mavlink import Vehicle

ORIGIN = (-19.3, 23.1, 940.0)
SETTINGS = ["render.engine=embree", "render.posed_actors=all"]


@pytest.fixture(name="place", scope="module")
def _place(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fly") / "plan"
    plan(tiny(), folder, settings=SETTINGS)
    return folder


@pytest.fixture(name="poses")
def _poses():
    poses = Poses(("127.0.0.1", 0), Vehicle([0, 0, 0], ORIGIN))
    yield poses
    poses.close()


class _Sink:
    def __init__(self):
        self.frames, self.lines = [], []

    def send(self, ir8, line, number):
        """Keep them."""
        assert number == line["frame"]
        self.frames.append(ir8.copy())
        self.lines.append(line)
        return True


def _receive(poses, *texts):
    for text in texts:
        send(text.encode(), ("127.0.0.1", poses.port))
    poses.receive_until(0, lambda: 0)


class _Replayed:
    """Poses from a log, each of whose messages arrives when it is due; and the clock by which they are. No time passes
    but in waiting for them."""

    def __init__(self, poses, messages):
        self._poses, self._messages, self._now_s = poses, messages, 0.0

    def __call__(self):
        return self._now_s

    def receive_until(self, time_s, clock):
        """Also go on to that time."""
        while self._messages and self._messages[0][0] <= time_s:
            self._now_s, message = self._messages.pop(0)
            send(message, ("127.0.0.1", self._poses.port))
            self._poses.receive_until(0, clock)
        self._now_s = time_s

    def pose_at(self, time_s):
        """That of the last messages."""
        return self._poses.pose_at(time_s)


def test_a_log_of_the_planned_flight_shows_what_the_plan_would(place, poses, tmp_path):
    world, twin, sink = World(place, "side"), World(place, "side"), _Sink()
    write_log(tmp_path / "flight.tlog", ORIGIN, world.flight_s, world.flight_poses)
    replayed = _Replayed(poses, read_log(tmp_path / "flight.tlog"))
    assert fly(world, replayed, sink, clock=replayed) == (len(world.flight_s), 0, 0)
    for frame, line in zip(sink.frames, sink.lines, strict=True):
        # A message is up to 20 ms old, and the flight begins 10 ms after the first: less than a metre of the way.
        planned = world.flight_poses[line["frame"]]
        pose = np.array(line["camera_to_world"])
        assert np.linalg.norm(pose[:3, 3] - planned[:3, 3]) < 1
        assert np.allclose(pose[:3, :3], planned[:3, :3], atol=0.02)
        assert np.array_equal(twin.capture(pose, line["time_s"]).ir8, frame)


def test_json_says_poses_too(poses):
    _receive(poses, json.dumps({"position_m": [1, 2, 30], "yaw_deg": 90, "pitch_deg": -30}))
    pose = poses.pose_at(0)
    assert pose[:3, 3].tolist() == [1, 2, 30]
    assert np.allclose(pose[:3, 2], [np.sqrt(0.75), 0, -0.5])
    given = json.dumps({"camera_to_world": np.round(pose, 4).tolist()})
    _receive(poses, given, "{}", '{"position_m": [1, 2]}')
    assert np.allclose(poses.pose_at(0), pose, atol=1e-4)
    assert (poses.received, len(poses.rejected)) == (4, 2)
    assert poses.rejected.counts == {"no pose": 1, "wrong type": 1}


JUNK = [
    b"",
    b"\x00",
    b"{",
    b"\xff" * 4096,
    b"\xfd\xff",
    b"{" + b" " * 4096,
    b"x" * 65_000,
    b"{" * 4096,
    b"\xfe\x00",
]


def test_what_cannot_be_used_is_counted_and_changes_nothing(poses):
    _receive(poses, '{"position_m": [1, 2, 30]}')
    pose = poses.pose_at(0)
    for datagram in JUNK:
        send(datagram, ("127.0.0.1", poses.port))
    poses.receive_until(0, lambda: 0)
    assert np.array_equal(poses.pose_at(0), pose)
    assert poses.rejected.counts == {"not MAVLink": 5, "not JSON": 2, "too long": 2}
    assert (poses.received, str(poses.rejected)) == (10, "5 not MAVLink, 2 not JSON, 2 too long")


def test_each_reason_is_reported_once_a_minute():
    reports = []
    poses = Poses(("127.0.0.1", 0), Vehicle([0, 0, 0], ORIGIN), reports.append)
    for time_s in (5, 6, 7, 64.9, 65, 66):
        for datagram in (b"{", b'{"position_m": [0, 0, NaN]}', b"\x1b[2J"):
            send(datagram, ("127.0.0.1", poses.port))
        poses.receive_until(time_s, lambda now_s=time_s: now_s)
    poses.close()
    assert reports == [
        f"rejected: {fault}; {count} up to now)"
        for count in (1, 5)
        for fault in (
            "pose = JSONDecodeError; expected one object of JSON (not JSON",
            "pose = NaN; expected numbers (not a number",
            "datagram = 4 bytes; expected MAVLink, or an object of JSON (not MAVLink",
        )
    ]


class _Flood:
    """A clock on which every look takes a millisecond, in which one more pose arrives, so that there always is one: the
    first at 0 m east, the next a millimetre farther."""

    def __init__(self, poses, step_s=0.001):
        self.now_s, self.sent, self._to, self._step_s = 0.0, 0, ("127.0.0.1", poses.port), step_s

    def __call__(self):
        send(json.dumps({"position_m": [1e-3 * self.sent, 0, 40], "pitch_deg": -90}).encode(), self._to)
        self.sent += 1
        self.now_s += self._step_s
        return self.now_s


def test_of_a_flood_the_newest_are_taken_until_the_time(poses):
    frozen = _Flood(poses, step_s=0)
    for _ in range(1000):  # more than a socket holds
        frozen()
    poses.receive_until(0, lambda: 0)
    there = poses.received
    assert len(poses.rejected) == max(there - 256, 0)
    assert poses.pose_at(0)[0, 3] == pytest.approx(1e-3 * (there - 1))
    clock = _Flood(poses)
    poses.receive_until(0.1, clock)
    assert 0.07 <= clock.now_s <= 0.11  # the last pause takes no time of this clock
    assert poses.received - there > 10
    begun_s = clock.now_s
    poses.receive_until(0, clock)
    assert clock.now_s <= begun_s + 0.01


def test_a_flood_of_poses_takes_no_frames_and_the_newest_counts(place, poses):
    world, sink, clock = World(place, "side"), _Sink(), _Flood(poses)
    done = fly(world, poses, sink, clock=clock)
    assert done == (len(world.flight_s), 0, pytest.approx(0, abs=0.01))
    east_m = [line["camera_to_world"][0][3] for line in sink.lines]
    newest_m = 1e-3 * (1e3 / world.frame_rate_hz) * np.arange(len(east_m))  # sent when a frame is due
    # Half of the looks are at what has arrived: those that came meanwhile wait.
    assert np.all(np.diff(east_m) > 0) and np.all(east_m <= newest_m + 0.1)


def test_a_flood_of_junk_before_the_first_pose_does_not_hold_the_flight(place, poses):
    class _Junk(_Flood):
        def __call__(self):
            for datagram in (b"{", b""):
                send(datagram, self._to)
            return super().__call__()

    done = fly(World(place, "side"), poses, _Sink(), clock=_Junk(poses), seconds=0.2)
    assert done.dropped == 0
    assert (
        {"not JSON", "not MAVLink"} <= poses.rejected.counts.keys() <= {"not JSON", "not MAVLink", "too many"}
    )


def test_the_wait_for_the_first_pose_says_so_each_minute_and_can_be_ended():
    class _None:
        now_s = 0.0

        def pose_at(self, _):
            """None, until somebody presses Ctrl-C."""
            if self.now_s > 130:
                raise KeyboardInterrupt

        def receive_until(self, time_s, _):
            """Wait."""
            self.now_s = time_s

    reports, none = [], _None()
    with pytest.raises(KeyboardInterrupt):
        fly(None, none, _Sink(), clock=lambda: none.now_s, report=reports.append)
    expected = "expected position and attitude of MAVLink, or JSON"
    assert reports == [f"no pose for {seconds} s; {expected}" for seconds in (60, 120)]


@pytest.mark.parametrize("seconds", [0, -1, float("nan")])
def test_a_flight_of_no_time_is_refused(seconds):
    with pytest.raises(ConfigError, match=r"^seconds = (0|-1|nan) s; expected above 0$"):
        fly(None, None, _Sink(), seconds=seconds)


@pytest.mark.parametrize(
    "options, message",
    [
        (["--seconds", "0"], "--seconds = 0 s; expected above 0, such as 60"),
        (["--seconds", "-1"], "--seconds = -1 s; expected above 0, such as 60"),
        (["--seconds", "nan"], "--seconds = nan s; expected above 0, such as 60"),
        (["--seconds", "long"], '--seconds = "long"; expected above 0, such as 60'),
        (["--rate", "0"], "--rate = 0 Hz; expected 0.1 to 240, such as 9"),
        (["--rate", "nan"], "--rate = nan Hz; expected 0.1 to 240, such as 9"),
        (["--rate", "1e9"], "--rate = 1e+09 Hz; expected 0.1 to 240, such as 9"),
        (["--down", "nan"], "--down = nan deg; expected -90 to 90, such as 45"),
        (["--down", "inf"], "--down = inf deg; expected -90 to 90, such as 45"),
        *(
            (["--poses", text], f'--poses = "{text}"; expected HOST:PORT, such as 127.0.0.1:14550')
            for text in ("127.0.0.1:70000", "127.0.0.1", "127.0.0.1:-1", "127.0.0.1:1e3", ":")
        ),
        (["--poses", "no.such.invalid:14550", "--allow-remote"],
         '--poses = "no.such.invalid:14550"; expected a known host, such as 127.0.0.1:14550'),
        (["--poses", f"{'a' * 70}:1", "--allow-remote"],
         f'--poses = "{"a" * 70}:1"; expected a known host, such as 127.0.0.1:14550'),
        *(
            ([f"--origin={text}"],
             f'--origin = "{text}"; expected LAT,LON,M within 89 deg, 180 deg and -1000 to 20000 m,'
             " such as --origin=-19.3,23.1,940")
            for text in ("", "1", "1,2", "1,2,3,4", "1,2,x", "nan,2,3", "93,2,3", "1,181,3", "1,2,inf")
        ),
    ],
    ids=lambda one: one[-1][:40] if isinstance(one, list) else "",
)  # fmt: skip
def test_wrong_options_are_refused_by_name(options, message, capsys):
    assert main(["plan", "side", "--video", "udp://127.0.0.1:5600", *options]) == 2
    assert capsys.readouterr().err == f"veldt.fly: {message}\n"


class _SlowClock:
    """A clock on which every look takes a while, so that making a frame does."""

    def __init__(self, step_s):
        self.now_s, self._step_s = 0.0, step_s

    def __call__(self):
        self.now_s += self._step_s
        return self.now_s


def test_frames_that_are_late_by_more_than_a_frame_are_dropped(place, poses):
    _receive(poses, '{"position_m": [0, 0, 40], "pitch_deg": -90}')
    world, sink = World(place, "side"), _Sink()
    # Three looks a frame: two when it is due, and one when it is done.
    done = fly(world, poses, sink, clock=_SlowClock(1.3 / world.frame_rate_hz))
    frames = [line["frame"] for line in sink.lines]
    assert done.sent == len(frames) < len(world.flight_s)
    assert done.sent + done.dropped == len(world.flight_s)
    assert done.worst_s > 1 / world.frame_rate_hz
    assert max(np.diff(frames)) > 1


def test_a_line_has_what_a_detector_is_judged_by(place):
    world = World(place, "side")
    capture = world.capture(world.flight_poses[0], world.flight_s[0])
    line = json.loads(json.dumps(line_of(world.flight_s[0], world.flight_poses[0], capture)))
    assert np.array_equal(line["camera_to_world"], world.flight_poses[0])
    assert [label["bbox"] for label in line["labels"]] == [list(label.box_px) for label in capture.labels]


def test_a_port_in_use_and_an_address_for_others_are_refused(poses, capsys):
    with pytest.raises(IoError, match=r"^127.0.0.1:\d+: Address already in use; expected a free UDP port$"):
        Poses(("127.0.0.1", poses.port), Vehicle([0, 0, 0]))
    others = {
        "--poses": ("0.0.0.0:14550", "udp://0.0.0.0:14550"),
        "--video": ("udp://10.0.0.1:5600", "udp://10.0.0.1:5600"),
        "--labels": ("tcp://0.0.0.0:5601", "tcp://0.0.0.0:5601"),
    }
    for option, (given, reports) in others.items():
        assert main(["plan", "side", "--video", "udp://127.0.0.1:5600", option, given]) == 2
        fault = f"veldt.fly: {option} = {reports}; expected 127.0.0.1, or --allow-remote\n"
        assert capsys.readouterr().err == fault


def test_the_command_flies_by_mavlink_and_sends_video_and_lines(place, tmp_path):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
        client.bind(("127.0.0.1", 0))
        client.settimeout(PATIENCE_S)
        run = subprocess.Popen(
            [sys.executable, "-m", "veldt.fly", str(place), "side", "--poses", "127.0.0.1:0", "--video",
             "udp://127.0.0.1:9", "--labels", f"udp://127.0.0.1:{client.getsockname()[1]}"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        port = int(run.stderr.readline().rpartition(" ")[2])
        world = World(place, "side")
        write_log(tmp_path / "flight.tlog", ORIGIN, world.flight_s, world.flight_poses)
        messages = [message for _, message in read_log(tmp_path / "flight.tlog")]
        for message in messages[:7]:  # until the first position, and then until the attitudes
            send(message, ("127.0.0.1", port))
        first = json.loads(client.recv(1 << 16))
        for message in messages[7:]:
            send(message, ("127.0.0.1", port))
        out, err = run.communicate(timeout=PATIENCE_S)
        sent = int(out.split()[0])
        assert (run.returncode, err) == (0 if sent == len(world.flight_s) else 3, "")
        lines = [first, *(json.loads(client.recv(1 << 16)) for _ in range(sent - 1))]
    assert f"{sent} frames sent, {len(world.flight_s) - sent} dropped, 0 lines missed, the latest " in out
    assert out.endswith(" of no use, 0 rejected\n")
    # Without --origin, the flight begins where the planned one does.
    pose = np.array(first["camera_to_world"])
    assert np.linalg.norm(pose[:3, 3] - world.flight_poses[0][:3, 3]) < 0.2
    assert {label["category"] for line in lines for label in line["labels"]} >= {"elephant"}


def test_a_terminal_that_has_gone_is_no_fault_of_its_own(monkeypatch):
    class _Gone:
        def write(self, _):
            """To a pipe without a reader."""
            raise BrokenPipeError

    monkeypatch.setattr(sys, "stderr", _Gone())
    assert main(["plan", "side", "--video", "udp://127.0.0.1:5600", "--seconds", "0"]) == 2


def test_the_command_flies_on_and_says_what_it_dropped(place):
    run = subprocess.Popen(
        [sys.executable, "-m", "veldt.fly", str(place), "side", "--poses", "127.0.0.1:0", "--video",
         "udp://127.0.0.1:9", "--seconds", "0.2"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    port = int(run.stderr.readline().rpartition(" ")[2])
    for datagram in (*JUNK, b'{"position_m": [0, 0, 1e300]}', b'{"position_m": [0, 0, 40]}'):
        send(datagram, ("127.0.0.1", port))
    out, err = run.communicate(timeout=PATIENCE_S)
    assert run.returncode == 3
    counts = "11 datagrams received, 0 of no use, 10 rejected (5 not MAVLink, 2 not JSON, 2 too long, 1 out of range)"
    assert out.endswith(f"; {counts}\n")
    assert re.findall(r"\((.*); 1 up to now\)", err) == [
        "not MAVLink",
        "not JSON",
        "too long",
        "out of range",
    ]
    assert len(err.splitlines()) == 4
    assert (
        "veldt.fly: rejected: position_m = 1e+300 m; expected -10000 to 10000 (out of range; 1 up to now)\n"
        in err
    )
