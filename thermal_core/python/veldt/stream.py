"""Live video of frames, with a line of JSON each."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

import veldt._core as _core


_LAST = 2**40  # 145 years at 240 Hz: times in a video's ticks stay within 64 bits


class StreamCounts(NamedTuple):
    """Counts of frames."""

    sent: int
    dropped: int
    """Queue full, or no receiver."""
    waiting: int
    """Queued; at most a few."""
    lines_missed: int
    """Lines that slow clients missed, and those too long for a datagram."""
    fault: str
    """Why the last frame without a receiver had none."""


class Stream:
    """Sends frames as H.264 video on a separate thread, and a line of JSON with each: send() never blocks. If more than
    a few frames are queued, the next is dropped. If the receiver of an RTSP stream goes away, or does not read for 5 s,
    frames are dropped while the stream reconnects each second. Lines are sent at once, independently of the video.
    FFmpeg prints no messages of its own from the first stream on.

    >>> with veldt.Stream("udp://127.0.0.1:5600", width_px=640, height_px=512, frame_rate_hz=9) as stream: ...
    stream.send(capture.ir8, {"time_s": time_s})
    """

    def __init__(
        self,
        video_url: str,
        *,
        width_px: int,
        height_px: int,
        frame_rate_hz: float,
        labels_url: str | None = None,
        allow_remote: bool = False,
    ) -> None:
        """video_url: udp://HOST:PORT (MPEG-TS) or rtsp://HOST:PORT/PATH, whose server must run. labels_url:
        tcp://HOST:PORT, a server for 16 clients, or udp://HOST:PORT, a datagram a line. allow_remote: hosts
        may be other than this machine. Sides of 1 to 8192 px, 0.1 to 240 Hz.

        ConfigError for another URL, rate or size; IoError without an answer in 5 s, or the server's port is in use.
        """
        self._stream = _core.FrameStream(
            video_url, labels_url, frame_rate_hz, width_px, height_px, allow_remote
        )
        self._next = 0

    def send(self, ir8: ArrayLike, line: dict[str, Any], number: int | None = None) -> bool:
        """Queue a frame (height, width) of 8 bits and its line. number: in frames since the stream's start, increasing,
        2^40 at most; None: the next. False if the queue was full; the line is sent nevertheless.

        ConfigError for another size, another number, and for NaN, infinity and other values that JSON cannot represent.
        """
        number = self._next if number is None else number
        if not isinstance(number, (int, np.integer)) or number < self._next:
            raise _core.ConfigError(f"number = {number}; expected {self._next} or more")
        if number > _LAST:
            raise _core.ConfigError(f"number = {number}; expected {_LAST} at most")
        try:
            text = json.dumps(line, allow_nan=False)
        except ValueError as error:
            raise _core.ConfigError(f"line: {error}; expected finite numbers") from error
        except (TypeError, RecursionError) as error:
            raise _core.ConfigError(f"line: {error}; expected what JSON can hold") from error
        taken = self._stream.send(ir8, number, text)
        self._next = number + 1
        return taken

    @property
    def counts(self) -> StreamCounts:
        """Counts up to now."""
        return StreamCounts(*self._stream.counts)

    @property
    def clients_refused(self) -> int:
        """Clients of the lines that were closed at once, because 16 were connected."""
        return self._stream.clients_refused

    def close(self) -> None:
        """Send queued frames for at most two seconds, and end the stream."""
        self._stream.close()

    def __enter__(self) -> Stream:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
