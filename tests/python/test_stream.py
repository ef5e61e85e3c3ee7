"""`veldt.Stream`: frames of a program's own as live video."""

import json
import signal
import socket
import subprocess
import time

import numpy as np
import pytest

from ports import free_port, wait_until_bound
from veldt import ConfigError, IoError, Stream

SIZE = {"width_px": 640, "height_px": 512}


def test_frames_and_lines_arrive():
    video, labels = free_port(socket.SOCK_DGRAM), free_port(socket.SOCK_DGRAM)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
        client.bind(("127.0.0.1", labels))
        receiver = subprocess.Popen(
            ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=width,height,nb_read_frames",
             "-of", "json", f"udp://127.0.0.1:{video}?timeout=2000000"], stdout=subprocess.PIPE,
        )  # fmt: skip
        wait_until_bound(video, socket.SOCK_DGRAM)
        with Stream(
            f"udp://127.0.0.1:{video}", **SIZE, frame_rate_hz=30, labels_url=f"udp://127.0.0.1:{labels}"
        ) as stream:
            for k in range(12):
                assert stream.send(np.full((512, 640), 20 * k, np.uint8), {"frame": k})
                time.sleep(0.05)
        assert stream.counts == (12, 0, 0, 0, "")
        assert [json.loads(client.recv(1 << 16)) for _ in range(12)] == [{"frame": k} for k in range(12)]
    (found,) = json.loads(receiver.communicate(timeout=60)[0])["streams"]
    assert (found["width"], found["height"], int(found["nb_read_frames"])) == (640, 512, 12)


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
    longest_s = 0.0
    for k in range(120):
        begin_s = time.perf_counter()
        stream.send(noise[k % 8], {"frame": k})
        assert json.loads(client.recv(1 << 16)) == {"frame": k}  # lines go on
        longest_s = max(longest_s, time.perf_counter() - begin_s)
        time.sleep(0.01)
    assert longest_s < 1
    assert stream.counts.dropped > 0
    receiver.send_signal(signal.SIGCONT)
    before = stream.counts.sent
    deadline_s = time.monotonic() + 30
    while stream.counts.sent < before + 3 and time.monotonic() < deadline_s:
        stream.send(noise[0], {})
        time.sleep(0.05)
    assert stream.counts.sent >= before + 3
    receiver.send_signal(signal.SIGSTOP)
    for k in range(120):
        stream.send(noise[k % 8], {})
        time.sleep(0.01)
    begin_s = time.monotonic()
    stream.close()  # gives up
    assert time.monotonic() - begin_s < 10
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
        begin_s = time.monotonic()
        while not stream.counts.fault and time.monotonic() - begin_s < 60:
            stream.send(noise, {})
            time.sleep(0.02)
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
