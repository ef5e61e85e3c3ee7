"""`stream`: live video and lines, received by FFmpeg's own client; killed and slow clients, faults."""

import json
import signal
import socket
import subprocess
import threading
import time

import numpy as np
import pytest

from configs import tiny
from pictures import read_grey
from ports import free_port, wait_until_bound
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


class _Lines(threading.Thread):
    """A client of the lines: connects as soon as there is a server, and reads all."""

    def __init__(self, port):
        super().__init__()
        self.text, self._port = b"", port
        self.start()

    def run(self):
        """Until the server ends."""
        for _ in range(600):
            try:
                with socket.create_connection(("127.0.0.1", self._port)) as server:
                    while part := server.recv(1 << 16):
                        self.text += part
                    return
            except OSError:
                time.sleep(0.02)

    def lines(self):
        """All of them."""
        self.join()
        return [json.loads(line) for line in self.text.splitlines()]


class _Receiver:
    """FFmpeg, which decodes what it receives to grey frames."""

    def __init__(self, scheme, port, size, *options):
        width, height = size
        url = (
            f"udp://127.0.0.1:{port}?timeout=5000000" if scheme == "udp" else f"rtsp://127.0.0.1:{port}/veldt"
        )
        self._shape = (height, width)
        self._process = subprocess.Popen(
            ["ffmpeg", "-loglevel", "error", *options, "-i", url, "-vf", f"crop={width}:{height}:0:0,format=gray",
             "-vsync", "passthrough", "-f", "rawvideo", "-"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )  # fmt: skip
        wait_until_bound(port, socket.SOCK_DGRAM if scheme == "udp" else socket.SOCK_STREAM)

    def frames(self):
        """All that came, until a second without."""
        pixels, _ = self._process.communicate(timeout=60)
        return np.frombuffer(pixels, np.uint8).reshape(-1, *self._shape)

    def kill(self):
        """At once."""
        self._process.kill()
        self._process.communicate()


def _size(planned):
    return read_grey(planned.folder / "made/clips/down/ir8/000000.png").shape[::-1]


def test_ffmpeg_receives_the_frames_and_a_client_the_lines_of_generate(planned):
    video, labels = free_port(socket.SOCK_DGRAM), free_port(socket.SOCK_STREAM)
    lines = _Lines(labels)
    receiver = _Receiver("udp", video, _size(planned))
    # Two a second, so that any machine is in time.
    done = planned(
        "stream", "plan", "--clips", "side", "--rate", "2",
        "--video", f"udp://127.0.0.1:{video}", "--labels", f"tcp://127.0.0.1:{labels}",
    )  # fmt: skip
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("side: ") and " frames sent at 2 Hz, 0 left out, 0 dropped; " in done.out
    frames, told = receiver.frames(), lines.lines()
    sent = int(done.out.split()[1])
    assert len(frames) == sent
    assert len(told) in (sent, sent - 1)  # the first frame may leave before the client connects
    assert [line["frame"] for line in told] == list(range(sent - len(told), sent))
    assert [line["stream_s"] for line in told] == [line["frame"] / 2 for line in told]
    assert {line["clip"] for line in told} == {"side"}


def test_at_the_clips_own_rate_frames_and_labels_are_those_of_generate(planned):
    video, labels = free_port(socket.SOCK_DGRAM), free_port(socket.SOCK_STREAM)
    lines = _Lines(labels)
    receiver = _Receiver("udp", video, _size(planned))
    planned("stream", "plan", "--clips", "down", "--video", f"udp://127.0.0.1:{video}",
            "--labels", f"tcp://127.0.0.1:{labels}")  # fmt: skip
    frames, told = receiver.frames(), lines.lines()
    made = planned.read("made/annotations.json")
    images = {image["id"]: image for image in made["images"] if "/down/" in image["file_name"]}
    for line in told:
        if line["left_out"] > 0:
            break
        in_file = [one for one in made["annotations"]
                   if images.get(one["image_id"], {}).get("frame_index") == line["frame"]]  # fmt: skip
        assert [label["bbox"] for label in line["labels"]] == [one["bbox"] for one in in_file]
        assert [label["segmentation"] for label in line["labels"]] == [one["segmentation"] for one in in_file]
    first = read_grey(planned.folder / "made/clips/down/ir8/000000.png")
    # Levels 0 to 255 as 16 to 235 and back, and x264 at a rate factor of 20.
    assert np.abs(frames[0].astype(int) - first).mean() < 4
    assert len(told) >= 2


def test_a_killed_receiver_of_rtsp_costs_frames_and_no_more(planned):
    port = free_port(socket.SOCK_STREAM)
    receiver = _Receiver("rtsp", port, _size(planned), "-rtsp_flags", "listen")
    run = planned.start(
        "stream", "plan", "--clips", "side", "--repeat", "--video", f"rtsp://127.0.0.1:{port}/veldt"
    )
    first = run.stdout.readline()
    receiver.kill()
    clips = [run.stdout.readline() for _ in range(4)]
    run.send_signal(signal.SIGINT)
    rest, _ = run.communicate(timeout=30)
    assert run.returncode == 130
    assert ", 0 dropped; " in first
    assert f"; cannot send to rtsp://127.0.0.1:{port}/veldt: " in clips[-1] + rest
    assert ", 0 dropped; " not in clips[-1]


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
            out, err = run.communicate(timeout=30)
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
