"""Runs a command until it ends, or until standard input does; then kills all processes that the command has left.

    python keeper.py COMMAND ARGS …

Whoever starts it holds a pipe to its standard input. The pipe closes when that process ends, even by SIGKILL.
"""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from processes import adopt_orphans, parents  # pylint: disable=wrong-import-position


def _kill_all_below() -> None:
    """A killed process leaves its children to this one, which kills them in turn."""
    while True:
        for child, parent in parents().items():
            if parent == os.getpid():
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
                command.returncode = 0  # it is gone; its exit code is of no use
                return


def main() -> None:
    """Keep the command of the command line."""
    adopt_orphans()
    try:
        _wait(subprocess.Popen(sys.argv[1:], stdin=subprocess.DEVNULL))
    finally:
        _kill_all_below()


if __name__ == "__main__":
    main()
