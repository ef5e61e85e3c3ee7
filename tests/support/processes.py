"""What runs on this machine."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable
from pathlib import Path

_PR_SET_CHILD_SUBREAPER = 36  # <linux/prctl.h>


def running_with(word: str | Path) -> dict[int, str]:
    """Command lines of all running processes in which this word occurs, by process id."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:  # ended meanwhile
            continue
        if str(word) in command:  # a process that has ended but was not waited for has no command line
            found[int(folder.name)] = command
    return found


def wait_until(condition: Callable[[], bool], seconds: float) -> bool:
    """Wait for a condition; whether it came true in time."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def parent_of(process: int) -> int:
    """The process that started a running one."""
    stat = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace")
    return int(stat.rpartition(")")[2].split()[1])


def parents() -> dict[int, int]:
    """The parents of all processes."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            found[int(folder.name)] = parent_of(int(folder.name))
        except (OSError, IndexError):  # ended meanwhile
            continue
    return found


def adopt_orphans() -> None:
    """Have what outlives the process that started it become a child of this one, so that it can be found."""
    ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
