"""`veldt.fly`: poses in over UDP, frames out."""

import json
import socket
import subprocess
import sys

import numpy as np
import pytest

from configs import tiny
from flight_log import read_log, send, write_log
from processes import PATIENCE_S
from veldt import ConfigError, IoError, World, plan
from veldt.fly import Poses, fly, line_of, main, pose_of_json
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


@pytest.mark.parametrize(
    "text",
    [
        "{",
        "{}",
        '{"position_m": [1, 2]}',
        '{"position_m": [1, 2, NaN]}',
        '{"position_m": [1, 2, 3], "yaw_deg": "north"}',
        '{"camera_to_world": [1, 2, 3]}',
        '{"camera_to_world": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]}',
        '{"camera_to_world": [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}',
    ],
)
def test_what_is_no_pose_is_refused(text):
    with pytest.raises(ConfigError, match="expected"):
        pose_of_json(text)


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
    # Two looks a frame: when it is due, and when it is done.
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
    for option, (given, told) in others.items():
        assert main(["plan", "side", "--video", "udp://127.0.0.1:5600", option, given]) == 2
        fault = f"veldt.fly: {option} = {told}; expected 127.0.0.1, or --allow-remote\n"
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
    # Without --origin, the flight begins where the planned one does.
    pose = np.array(first["camera_to_world"])
    assert np.linalg.norm(pose[:3, 3] - world.flight_poses[0][:3, 3]) < 0.2
    assert {label["category"] for line in lines for label in line["labels"]} >= {"elephant"}
