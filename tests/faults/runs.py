"""Runs of the program that are disturbed, and what is left of them."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from processes import PATIENCE_S, parents, wait_until
from program import PROGRAM


@dataclass(frozen=True)
class Ended:
    """How a run ended; `code` is -N after signal N, and None if it had to be killed."""

    code: int | None
    err: str

    def last_line(self) -> str:
        """The last line on standard error."""
        lines = [line for line in self.err.splitlines() if line]
        return lines[-1] if lines else ""


def start(
    step: Sequence[str], work: Path, env: dict[str, str] | None = None, under: Sequence[str] = (), **how
) -> subprocess.Popen:
    """Start the program in a folder. Its temporary files go to `tmp` there, and its messages to a file beside it."""
    inherited = {key: value for key, value in os.environ.items() if not key.startswith("VELDT_")}
    messages = _messages(work, how.pop("name", "run"))
    with open(messages, "wb") as err:
        return subprocess.Popen(
            [*under, str(PROGRAM), *step],
            cwd=work,
            env=inherited | {"TMPDIR": str(work / "tmp")} | (env or {}),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=err,
            **how,
        )


def finish(run: subprocess.Popen, work: Path, name: str = "run") -> Ended:
    """Wait for a run; one that hangs is killed."""
    try:
        code: int | None = run.wait(PATIENCE_S)
    except subprocess.TimeoutExpired:
        run.kill()
        run.wait()
        code = None
    return Ended(code, _messages(work, name).read_text(encoding="utf-8", errors="replace"))


def _messages(work: Path, name: str) -> Path:
    return work.parent / f"{name}_messages.txt"


def run_to_end(step: Sequence[str], work: Path, name: str = "run", **how) -> Ended:
    """Run the program to its end."""
    return finish(start(step, work, name=name, **how), work, name)


def descendants(process: int) -> list[int]:
    """A process that runs, and all that it has started, itself or through others; parents first."""
    pairs = parents().items()
    found = [process]
    for known in found:
        found += [child for child, parent in pairs if parent == known]
    return found


def name_of(process: int) -> str:
    """The name of a process, or "" if it has ended."""
    try:
        return Path(f"/proc/{process}/comm").read_text(encoding="utf-8").strip()
    except OSError:
        return ""


def send(process: int, number: int) -> bool:
    """Send a signal; whether the process was there."""
    try:
        os.kill(process, number)
    except ProcessLookupError:
        return False
    return True


def left_over() -> list[str]:
    """Names of the processes that outlive their runs by seconds; they are killed."""
    wait_until(lambda: not _orphans())
    found = []
    for process in _orphans():
        found.append(name_of(process))
        for one in reversed(descendants(process)):
            send(one, signal.SIGKILL)
    wait_until(lambda: not _orphans())
    return found


def _orphans() -> list[int]:
    """Processes that this one has adopted, without those that have ended."""
    while True:
        try:
            if os.waitpid(-1, os.WNOHANG)[0] == 0:
                break
        except ChildProcessError:
            return []
    return descendants(os.getpid())[1:]


def pause(seconds: float, run: subprocess.Popen) -> bool:
    """Wait; whether the run is still going on then."""
    end = time.monotonic() + seconds
    while time.monotonic() < end and run.poll() is None:
        time.sleep(min(0.01, max(0.0, end - time.monotonic())))
    return run.poll() is None
