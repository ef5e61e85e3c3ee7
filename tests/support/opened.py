"""Count how often files are opened by any process: Linux's inotify through the C library."""

from __future__ import annotations

import ctypes
import os
import struct
from collections import Counter
from pathlib import Path

_IN_CLOSE_NOWRITE = 0x10
_IN_OPEN = 0x20
_IN_Q_OVERFLOW = 0x4000
_EVENT = struct.Struct("iIII")  # watch, mask, cookie, length of the name that follows


class Opened:
    """Watches the files of some folders from now on; for `with`."""

    def __init__(self, *folders: Path):
        self._folders = folders
        self._names: dict[int, Path] = {}
        self._descriptor = -1

    def __enter__(self) -> Opened:
        libc = ctypes.CDLL(None, use_errno=True)
        self._descriptor = libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        assert self._descriptor >= 0, os.strerror(ctypes.get_errno())
        for folder in self._folders:
            watched = _IN_OPEN | _IN_CLOSE_NOWRITE
            watch = libc.inotify_add_watch(self._descriptor, str(folder).encode(), watched)
            assert watch >= 0, os.strerror(ctypes.get_errno())
            self._names[watch] = folder
        return self

    def __exit__(self, *_) -> None:
        os.close(self._descriptor)

    def counts(self, suffix: str) -> dict[Path, int]:
        """How often each file with this suffix was opened since the last call; no file may be open at the call.

        The kernel merges consecutive equal events until the first is read. Therefore a file that is opened again while
        it is open may be reported once or twice, and is counted once.
        """
        found: Counter[Path] = Counter()
        last: dict[Path, int] = {}
        for watch, mask, name in self._events():
            assert not mask & _IN_Q_OVERFLOW, "more events than the kernel keeps"
            file, event = self._names[watch] / name, mask & (_IN_OPEN | _IN_CLOSE_NOWRITE)
            if event == _IN_OPEN != last.get(file) and name.endswith(suffix):
                found[file] += 1
            last[file] = event
        return dict(found)

    def _events(self):
        while True:
            try:
                events = os.read(self._descriptor, 1 << 16)
            except BlockingIOError:
                return
            while events:
                watch, mask, _, length = _EVENT.unpack_from(events)
                name = events[_EVENT.size : _EVENT.size + length].rstrip(b"\0").decode()
                events = events[_EVENT.size + length :]
                yield watch, mask, name
