"""Progress events for the process that started the planner or the renderer: one JSON object per line.

The planner reports `planned` for each clip or flight, the renderer `scene_built`, `clip`, `frame`, `clip_done`, `done`
and `error`. An `error` has a `kind` (`config` or `internal`), a `message` (exception type and last line), `where`
(`blender_scripts/FILE:LINE`) and sometimes a `hint`.
"""

from __future__ import annotations

import json
import os


class Events:
    """Writes events to an inherited file descriptor; without one, does nothing."""

    def __init__(self, fd: int | None):
        self._fd = fd

    def report(self, event: str, **fields) -> None:
        """Write one event completely, so that a reader never waits for the rest of a line."""
        if self._fd is not None:
            line = memoryview((json.dumps({"event": event, **fields}) + "\n").encode())
            while line:
                line = line[os.write(self._fd, line) :]
