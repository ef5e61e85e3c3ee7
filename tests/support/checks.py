"""Checks that `run` starts one after another; in the end, those that were skipped and those that failed are named.

A work takes arguments, prints what it finds, and returns whether it passed. All run in the root of the repository.
"""

from __future__ import annotations

import filecmp
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

CORES = len(os.sched_getaffinity(0))
# Stages and their seconds, one a line, of which `run` prints a summary.
SECONDS = Path(os.environ.setdefault("VELDT_SECONDS", os.devnull))


def fail(code: int, line: str) -> NoReturn:
    """End with a message."""
    print(f"run: {line}", file=sys.stderr)
    sys.exit(code)


def ran(*command: object, **how) -> bool:
    """Run a program; whether it ended with 0."""
    try:
        return subprocess.run(list(map(str, command)), check=False, **how).returncode == 0
    except OSError as error:
        print(f"run: {command[0]}: {error.strerror}", file=sys.stderr)
        return False


def from_run(function: str, *arguments: str) -> list[str]:
    """The command that calls a function of `run`."""
    return ["bash", "-c", 'source ./run && "$@"', "bash", function, *arguments]


def build(preset: str, target: str, *options: str) -> None:
    """Build a target, or end if that fails."""
    if not ran(*from_run("build", preset, target, *options)):
        sys.exit(1)


def install_python(folder: str, requirements: str, *options: str) -> bool:
    """Python packages in an environment of their own, with options of venv; whether they could be installed."""
    installed = Path(folder, "requirements.txt")
    if installed.exists() and filecmp.cmp(requirements, installed, shallow=False):
        return True
    lines = Path(requirements).read_text(encoding="utf-8").splitlines()
    print(f"Installing Python packages into {folder}:", *(line for line in lines if not line.startswith("#")))
    shutil.rmtree(folder, ignore_errors=True)
    install = (f"{folder}/bin/python", "-m", "pip", "install", "--quiet", "--requirement", requirements)
    if not (ran(sys.executable, "-m", "venv", *options, folder) and ran(*install)):
        return False
    shutil.copyfile(requirements, installed)
    return True


def _add_seconds(stage: str, seconds: float) -> None:
    with SECONDS.open("a", encoding="utf-8") as file:
        file.write(f"{stage}\t{seconds:.3f}\n")


def _preparing_s() -> float:
    """Seconds spent on packages and on building."""
    rows = (line.split("\t") for line in SECONDS.read_text(encoding="utf-8").splitlines())
    return sum(float(seconds) for stage, seconds in rows if stage in ("packages", "build"))


@contextmanager
def timed(stage: str) -> Iterator[None]:
    """Add the seconds of what is done within to those of a stage."""
    start_s = time.monotonic()
    try:
        yield
    finally:
        _add_seconds(stage, time.monotonic() - start_s)


class Checks:
    """What was checked so far."""

    def __init__(self) -> None:
        self.skipped: list[str] = []
        self.failed: list[str] = []
        sys.stdout.reconfigure(line_buffering=True)  # in order with what programs print
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it without a trace

    def check(self, name: str, work: Callable[..., bool], *arguments: object, **how) -> None:
        """Do a work, and note whether it passed. Seconds that it spends on packages and on building count as those."""
        start_s = time.monotonic() - _preparing_s()
        print(f"\n== {name}")
        if not work(*arguments, **how):
            self.failed.append(name)
        seconds = time.monotonic() - _preparing_s() - start_s
        _add_seconds(name, seconds)
        print(f"== {name} took {int(seconds)} s")

    def conclude(self, what: str) -> None:
        """End with 1 if anything failed."""
        print()
        for one in self.skipped:
            print(f"skipped: {one}")
        if self.failed:
            fail(1, f"{what} failed: " + "".join(f"{one}; " for one in self.failed))
        print(f"{what} passed, without what was skipped" if self.skipped else f"{what} passed")
