"""What runs on this machine, and how long tests wait for it.

No test may depend on how fast the machine is: PATIENCE_S only ends the wait for what never comes.
"""

from __future__ import annotations

import ctypes
import os
import re
import time
from collections.abc import Callable
from pathlib import Path

PATIENCE_S = 600.0
HELD_S = 6 * PATIENCE_S  # how long what is held stays, if it is not ended: longer than any test waits

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


def wait_until(condition: Callable[[], bool]) -> bool:
    """Wait for a condition; whether it came true."""
    end = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def interrupt(process: int, number: int) -> None:
    """Send `veldt` a signal that asks it to stop, and return when it knows."""
    os.kill(process, number)
    assert wait_until(lambda: knows_of(process, number))


def knows_of(process: int, number: int) -> bool:
    """Whether `veldt` has taken such a signal: then it has no handler for it any more, as when it has ended."""
    try:
        status = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    except (FileNotFoundError, ProcessLookupError):
        return True
    caught = int(re.search(r"SigCgt:\s*(\w+)", status)[1], 16)
    return not caught >> (number - 1) & 1


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
