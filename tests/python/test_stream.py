"""`veldt.Stream`: frames of a program's own as live video."""

import itertools
import json
import os
import signal
import socket
import subprocess
from pathlib import Path

import numpy as np
import pytest

from ports import Arrivals, free_port, wait_until_bound
from processes import wait_until
from veldt import ConfigError, IoError, Stream

SIZE = {"width_px": 640, "height_px": 512}


def test_frames_and_lines_arrive():
    video, labels = Arrivals(), Arrivals()
    urls = [f"udp://127.0.0.1:{port.port}" for port in (video, labels)]
    with Stream(urls[0], **SIZE, frame_rate_hz=30, labels_url=urls[1]) as stream:
        for k in range(12):
            assert stream.send(np.full((512, 640), 20 * k, np.uint8), {"frame": k})
            assert wait_until(lambda: stream.counts.waiting == 0)
    assert stream.counts == (12, 0, 0, 0, "")
    assert [json.loads(line) for line in labels.all().splitlines()] == [{"frame": k} for k in range(12)]
    command = [
        "ffprobe",
        "-v",
        "error",
        "-count_frames",
        "-show_entries",
        "stream=width,height,nb_read_frames",
    ]
    probe = [*command, "-of", "json", "-f", "mpegts", "-i", "-"]
    said = subprocess.run(probe, input=video.all(), capture_output=True, check=True).stdout
    (found,) = json.loads(said)["streams"]
    assert (found["width"], found["height"], int(found["nb_read_frames"])) == (640, 512, 12)


def _is_blocked(stream) -> bool:
    """Whether a frame waits, and no thread but this one has anything to do, at fifty looks in a row."""
    for _ in range(50):
        others = (task for task in Path("/proc/self/task").iterdir() if int(task.name) != os.getpid())
        states = {(task / "stat").read_text().rpartition(")")[2].split()[0] for task in others}
        if stream.counts.waiting == 0 or states != {"S"}:
            return False
    return True


def _send(stream, frame, client) -> bool:
    """Send a frame with a line, which arrives. Nothing gives up meanwhile: no frame has waited for the receiver."""
    taken = stream.send(frame, {"mean": int(frame.mean())})
    assert json.loads(client.recv(1 << 16)) == {"mean": int(frame.mean())}
    assert stream.counts.fault == ""
    return taken


def _send_until_blocked(stream, noise, client):
    frames = itertools.cycle(noise)
    while not _is_blocked(stream):
        _send(stream, next(frames), client)
    assert not all(_send(stream, next(frames), client) for _ in range(5))


def test_a_receiver_that_stops_reading_costs_frames_and_no_time():
    port = free_port(socket.SOCK_STREAM)
    url = f"rtsp://127.0.0.1:{port}/veldt"
    client = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    client.bind(("127.0.0.1", 0))
    labels_url = f"udp://127.0.0.1:{client.getsockname()[1]}"
    receiver = subprocess.Popen(
        ["ffmpeg", "-loglevel", "error", "-rtsp_flags", "listen", "-i", url, "-f", "null", "-"]
    )
    wait_until_bound(port, socket.SOCK_STREAM)
    stream = Stream(url, **SIZE, frame_rate_hz=30, labels_url=labels_url)
    rng = np.random.default_rng(1)
    noise = rng.integers(0, 256, (8, 512, 640), np.uint8)  # hardly compresses: 0.3 MB a frame
    receiver.send_signal(signal.SIGSTOP)
    _send_until_blocked(stream, noise, client)
    receiver.send_signal(signal.SIGCONT)
    before = stream.counts.sent
    while stream.counts.sent < before + 3:
        _send(stream, noise[0], client)
    receiver.send_signal(signal.SIGSTOP)
    _send_until_blocked(stream, noise, client)
    stream.close()  # gives up, before the receiver's time is over
    receiver.kill()
    receiver.wait()
    client.close()
    counts = stream.counts
    assert (counts.waiting, counts.fault) == (0, f"cannot send to {url}: stopped")


def test_a_receiver_that_reads_nothing_for_5_s_is_given_up():
    port = free_port(socket.SOCK_STREAM)
    url = f"rtsp://127.0.0.1:{port}/veldt"
    receiver = subprocess.Popen(
        ["ffmpeg", "-loglevel", "error", "-rtsp_flags", "listen", "-i", url, "-f", "null", "-"]
    )
    wait_until_bound(port, socket.SOCK_STREAM)
    with Stream(url, **SIZE, frame_rate_hz=30) as stream:
        receiver.send_signal(signal.SIGSTOP)
        noise = np.random.default_rng(1).integers(0, 256, (512, 640), np.uint8)

        def fault() -> str:
            stream.send(noise, {})
            return stream.counts.fault

        assert wait_until(fault)
        assert stream.counts.fault == f"cannot send to {url}: no answer within 5 s"
        receiver.kill()
        receiver.wait()


def test_faults_have_the_words_of_the_command():
    with pytest.raises(ConfigError, match='^video_url = "x"; expected udp://HOST:PORT or rtsp://HOST:PORT$'):
        Stream("x", **SIZE, frame_rate_hz=9)
    others = "udp://10.0.0.1:5600"
    permit = "expected 127.0.0.1, or allow_remote=True$"
    with pytest.raises(ConfigError, match=f"^video_url = {others}; {permit}"):
        Stream(others, **SIZE, frame_rate_hz=9)
    with pytest.raises(ConfigError, match=f"^labels_url = {others}; {permit}"):
        Stream("udp://127.0.0.1:9", **SIZE, frame_rate_hz=9, labels_url=others)
    for rate_hz in (0, float("nan"), 1e9):
        with pytest.raises(ConfigError, match="^frame_rate_hz = .* Hz; expected 0.1 to 240$"):
            Stream("udp://127.0.0.1:9", **SIZE, frame_rate_hz=rate_hz)
    with pytest.raises(ConfigError, match="^width_px = 0 px; expected 1 to 8192$"):
        Stream("udp://127.0.0.1:9", width_px=0, height_px=512, frame_rate_hz=9)
    port = free_port(socket.SOCK_STREAM)
    with pytest.raises(IoError, match="Connection refused$"):
        Stream(f"rtsp://127.0.0.1:{port}/veldt", **SIZE, frame_rate_hz=9)
    with Stream("udp://127.0.0.1:9", **SIZE, frame_rate_hz=9) as stream:
        with pytest.raises(ConfigError, match="^frame = 8 x 8 px; expected 640 x 512$"):
            stream.send(np.zeros((8, 8), np.uint8), {})
        with pytest.raises(ConfigError, match="^line: .*; expected finite numbers$"):
            stream.send(np.zeros((512, 640), np.uint8), {"time_s": float("nan")})
        stream.send(np.zeros((512, 640), np.uint8), {}, 5)
        with pytest.raises(ConfigError, match="^number = 5; expected 6 or more$"):
            stream.send(np.zeros((512, 640), np.uint8), {}, 5)
        for number in (6.5, "6"):
            with pytest.raises(ConfigError, match=f"^number = {number}; expected 6 or more$"):
                stream.send(np.zeros((512, 640), np.uint8), {}, number)
        with pytest.raises(ConfigError, match="^number = 1099511627777; expected 1099511627776 at most$"):
            stream.send(np.zeros((512, 640), np.uint8), {}, 2**40 + 1)
        deep = []
        for _ in range(100_000):
            deep = [deep]
        for value in (np.zeros(3), deep):
            with pytest.raises(ConfigError, match="^line: .*; expected what JSON can hold$"):
                stream.send(np.zeros((512, 640), np.uint8), {"value": value})
        assert stream.clients_refused == 0
