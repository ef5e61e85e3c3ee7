"""`stream`: live video and lines, decoded by FFmpeg; a killed receiver, faults."""

import itertools
import json
import re
import signal
import socket
import subprocess

import numpy as np
import pytest

from configs import tiny
from pictures import read_grey
from ports import Arrivals, free_port, wait_until_bound
from processes import PATIENCE_S, interrupt
from program import Veldt

SETTINGS = ["render.engine=embree", "render.posed_actors=all"]


@pytest.fixture(name="planned", scope="module")
def _planned(tmp_path_factory):
    """A plan of clips of 8 frames, and the dataset that is generated of it."""
    veldt = Veldt(tmp_path_factory.mktemp("stream"))
    veldt.write("tiny.json", tiny())
    assert veldt("plan", "tiny.json", "--out", "plan", "--quiet", "--set", *SETTINGS).code == 0
    assert veldt("generate", "--plan", "plan", "--out", "made", "--quiet").code == 0
    return veldt


def _decoded(video: bytes, size) -> np.ndarray:
    """The grey frames of a transport stream, by FFmpeg."""
    width, height = size
    command = ["ffmpeg", "-loglevel", "error", "-f", "mpegts", "-i", "-", *_grey(width, height)]
    done = subprocess.run(command, input=video, capture_output=True, check=True)
    return np.frombuffer(done.stdout, np.uint8).reshape(-1, height, width)


def _grey(width: int, height: int) -> list[str]:
    frames = ["-vf", f"crop={width}:{height}:0:0,format=gray", "-vsync", "passthrough"]
    return [*frames, "-f", "rawvideo", "-"]


def _connected(port: int) -> socket.socket:
    """A client of a port, as soon as there is a server."""
    wait_until_bound(port, socket.SOCK_STREAM)
    return socket.create_connection(("127.0.0.1", port))


def _size(planned):
    return read_grey(planned.folder / "made/clips/down/ir8/000000.png").shape[::-1]


STATE = re.compile(r"side: (\d+) of (\d+) frames sent at 2 Hz, (\d+) left out, (\d+) dropped; .*")


def test_a_client_gets_the_lines_and_the_video_has_the_frames(planned):
    """Two frames a clip, again and again, until the client, which may come late, has the lines of several clips, in
    the end beside more clients than are served."""
    port, video = free_port(socket.SOCK_STREAM), Arrivals()
    run = planned.start(
        "stream", "plan", "--clips", "side", "--rate", "2", "--repeat",
        "--video", f"udp://127.0.0.1:{video.port}", "--labels", f"tcp://127.0.0.1:{port}",
    )  # fmt: skip
    with _connected(port) as client, client.makefile() as lines:
        received = [json.loads(lines.readline()) for _ in range(6)]
        others = [socket.create_connection(("127.0.0.1", port)) for _ in range(20)]
        assert [other.recv(1) for other in others] == 15 * [b"{"] + 5 * [b""]
        received += [json.loads(lines.readline()) for _ in range(6)]
        interrupt(run.pid, signal.SIGINT)
        out, err = run.communicate(timeout=PATIENCE_S)
        received += map(json.loads, lines)
    assert (run.returncode, err) == (130, "")
    for other in others:
        other.close()
    assert sum(map(int, re.findall("; ([0-9]+) clients refused\n", out))) == 5
    states = [tuple(map(int, STATE.fullmatch(line).groups())) for line in out.splitlines()]
    assert {count for _, count, _, _ in states[:-1]} == {2}
    assert len(_decoded(video.all(), _size(planned))) == sum(sent for sent, *_ in states)
    assert {line["clip"] for line in received} == {"side"}
    for one, then in itertools.pairwise(received):
        assert then["stream_s"] > one["stream_s"] and (2 * then["stream_s"]).is_integer()
        if then["frame"] > one["frame"]:  # of the same clip: no line is missing
            assert then["frame"] - one["frame"] <= 1 + then["left_out"] - one["left_out"]


def test_at_the_clips_own_rate_frames_and_labels_are_those_of_generate(planned):
    """As far as the machine is in time; the first frame always is."""
    video, lines = Arrivals(), Arrivals()
    done = planned("stream", "plan", "--clips", "down", "--video", f"udp://127.0.0.1:{video.port}",
                   "--labels", f"udp://127.0.0.1:{lines.port}")  # fmt: skip
    assert (done.code, done.err) == (0, "")
    frames, received = _decoded(video.all(), _size(planned)), [
        json.loads(line) for line in lines.all().splitlines()
    ]
    made = planned.read("made/annotations.json")
    images = {image["id"]: image for image in made["images"] if "/down/" in image["file_name"]}
    for line in received:
        if line["left_out"] > 0:
            break
        in_file = [one for one in made["annotations"]
                   if images.get(one["image_id"], {}).get("frame_index") == line["frame"]]  # fmt: skip
        assert [label["bbox"] for label in line["labels"]] == [one["bbox"] for one in in_file]
        assert [label["segmentation"] for label in line["labels"]] == [one["segmentation"] for one in in_file]
    assert (received[0]["frame"], received[0]["left_out"]) == (0, 0)
    first = read_grey(planned.folder / "made/clips/down/ir8/000000.png")
    # Levels 0 to 255 as 16 to 235 and back, and x264 at a rate factor of 20.
    assert np.abs(frames[0].astype(int) - first).mean() < 4


def test_a_killed_receiver_of_rtsp_costs_frames_and_no_more(planned):
    port = free_port(socket.SOCK_STREAM)
    url = f"rtsp://127.0.0.1:{port}/veldt"
    command = ["ffmpeg", "-loglevel", "error", "-rtsp_flags", "listen", "-i", url, *_grey(*_size(planned))]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as receiver:
        wait_until_bound(port, socket.SOCK_STREAM)
        run = planned.start("stream", "plan", "--clips", "side", "--repeat", "--video", url)
        assert receiver.stdout.read(1)  # of a frame that has arrived
        receiver.kill()
    states = []
    for state in run.stdout:
        states.append(state)
        if state.startswith("side: 0 of "):
            break
    interrupt(run.pid, signal.SIGINT)
    run.communicate(timeout=PATIENCE_S)
    assert run.returncode == 130
    assert not states[0].startswith("side: 0 of ")
    assert f"; cannot send to {url}: " in states[-1]


@pytest.mark.parametrize(
    "options, message",
    [
        (["--video", "udp://10.0.0.1:5600"], "--video = udp://10.0.0.1:5600; expected 127.0.0.1, or --allow-remote"),
        (["--video", "udp://127.0.0.1:5600", "--labels", "tcp://0.0.0.0:5601"],
         "--labels = tcp://0.0.0.0:5601; expected 127.0.0.1, or --allow-remote"),
        (["--video", "srt://127.0.0.1:5600"],
         '--video = "srt://127.0.0.1:5600"; expected udp://HOST:PORT or rtsp://HOST:PORT'),
        (["--video", "udp://127.0.0.1:5600", "--set", "seed=2"], "--set = seed=2; expected a config, not a plan"),
        (["--video", "udp://127.0.0.1:5600", "--rate", "nan"], "--rate = nan Hz; expected 0.1 to 240"),
        (["--video", "udp://127.0.0.1:5600", "--rate", "1e9"], "--rate = 1e+09 Hz; expected 0.1 to 240"),
        (["--video", "udp://127.0.0.1:5600", "--clips", "up"],
         '--clips = "up"; expected one of down, side'),
    ],
)  # fmt: skip
def test_wrong_usage(planned, options, message):
    done = planned("stream", "plan", *options)
    assert (done.code, done.out) == (2, "")
    assert done.err == f"veldt: {message}\n"


def test_a_server_that_accepts_and_says_nothing_is_given_up_and_ctrl_c_ends_the_wait(planned):
    with socket.create_server(("127.0.0.1", 0)) as silent:
        url = f"rtsp://127.0.0.1:{silent.getsockname()[1]}/veldt"
        done = planned("stream", "plan", "--video", url)
        assert (done.code, done.err) == (1, f"veldt: cannot send to {url}: no answer within 5 s\n")
        run = planned.start("stream", "plan", "--video", url)
        with silent.accept()[0], silent.accept()[0]:  # the given up one is still in the queue
            run.send_signal(signal.SIGINT)
            out, err = run.communicate(timeout=PATIENCE_S)
    assert (run.returncode, out, err) == (130, "", "")


def test_a_server_that_does_not_answer_and_a_port_in_use_are_faults(planned):
    port = free_port(socket.SOCK_STREAM)
    done = planned("stream", "plan", "--video", f"rtsp://127.0.0.1:{port}/veldt")
    assert (done.code, done.err) == (
        1,
        f"veldt: cannot send to rtsp://127.0.0.1:{port}/veldt: Connection refused\n",
    )
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        done = planned(
            "stream", "plan", "--video", "udp://127.0.0.1:9", "--labels", f"tcp://127.0.0.1:{port}"
        )
    assert (done.code, done.err) == (
        1,
        f"veldt: cannot listen at tcp://127.0.0.1:{port}: Address already in use\n",
    )
