"""Runs a command until it ends, or until standard input does; then kills all processes that the command has left.

    python keeper.py COMMAND ARGS …

Whoever starts it holds a pipe to its standard input. The pipe closes when that process ends, even by SIGKILL.
"""

from __future__ import annotations

import ctypes
import os
import select
import signal
import subprocess
import sys
from pathlib import Path

_PR_SET_CHILD_SUBREAPER = 36  # <linux/prctl.h>: orphans below this process become its children


def _children() -> list[int]:
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            parent = int(stat.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()[1])
        except OSError:  # ended meanwhile
            continue
        if parent == os.getpid():
            found.append(int(stat.parent.name))
    return found


def _kill_all_below() -> None:
    """A killed process leaves its children to this one, which kills them in turn."""
    while True:
        for child in _children():
            os.kill(child, signal.SIGKILL)
        try:
            os.waitpid(-1, 0)
        except ChildProcessError:
            return


def _wait(command: subprocess.Popen) -> None:
    """Until the command or standard input ends. Orphans that end are removed from the list of processes."""
    while not select.select([sys.stdin], [], [], 0.1)[0]:
        while ended := os.waitpid(-1, os.WNOHANG)[0]:
            if ended == command.pid:
                command.returncode = 0  # it is gone; nobody asks how it ended
                return


def main() -> None:
    """Keep the command of the command line."""
    ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    try:
        _wait(subprocess.Popen(sys.argv[1:], stdin=subprocess.DEVNULL))
    finally:
        _kill_all_below()


if __name__ == "__main__":
    main()
