"""Tells whoever started the renderer how it goes on: one JSON object a line."""

from __future__ import annotations

import json
import os


class Events:
    """Writes events to an inherited file descriptor; without one it keeps quiet."""

    def __init__(self, fd: int | None):
        self._fd = fd

    def tell(self, event: str, **fields) -> None:
        """Writes one event whole, so that a reader never sees half a line for long."""
        if self._fd is not None:
            line = memoryview((json.dumps({"event": event, **fields}) + "\n").encode())
            while line:
                line = line[os.write(self._fd, line) :]
