"""Live video of frames, with a line of JSON each."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

from numpy.typing import ArrayLike

import veldt._core as _core


class StreamCounts(NamedTuple):
    """What became of frames."""

    sent: int
    dropped: int
    """No room, or nobody to receive them."""
    lines_missed: int
    """Lines that slow clients did not get, and those too long for a datagram."""
    fault: str
    """Why the last frame without a receiver had none."""


class Stream:
    """Sends frames as H.264 video, and a line of JSON with each, on a thread of its own: send() never waits. If more
    than a few frames wait to be sent, the next is dropped. If the receiver of an RTSP stream goes away, frames are dropped
    while the stream tries each second to reach it again.

    >>> with veldt.Stream("udp://127.0.0.1:5600", width_px=640, height_px=512, frame_rate_hz=9) as stream:
    ...     stream.send(capture.ir8, {"time_s": time_s})
    """

    def __init__(
        self,
        video_url: str,
        *,
        width_px: int,
        height_px: int,
        frame_rate_hz: float,
        labels_url: str | None = None,
    ) -> None:
        """video_url: udp://HOST:PORT (MPEG-TS) or rtsp://HOST:PORT/PATH, whose server must run. labels_url:
        tcp://HOST:PORT, a server for any number of clients, or udp://HOST:PORT, a datagram a line.

        ConfigError for another URL; IoError if nobody answers, or the server's port is in use.
        """
        self._stream = _core.FrameStream(video_url, labels_url, frame_rate_hz, width_px, height_px)
        self._next = 0

    def send(self, ir8: ArrayLike, line: dict[str, Any], number: int | None = None) -> bool:
        """Hand over a frame (height, width) of 8 bits and what its line says. number: in frames since the stream began,
        later than the last; None: the next. False if there was no room.

        ConfigError for another size, and a number that has passed.
        """
        number = self._next if number is None else number
        if number < self._next:
            raise _core.ConfigError(f"number = {number}; expected {self._next} or more")
        taken = self._stream.send(ir8, number, json.dumps(line))
        self._next = number + 1
        return taken

    @property
    def counts(self) -> StreamCounts:
        """Up to now."""
        return StreamCounts(*self._stream.counts)

    def close(self) -> None:
        """Send what waits, two seconds at most, and end the stream."""
        self._stream.close()

    def __enter__(self) -> Stream:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
