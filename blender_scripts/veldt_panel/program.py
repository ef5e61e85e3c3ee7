# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the `veldt` program and reads what it reports. No bpy."""

from __future__ import annotations

import json
import queue
import shutil
import subprocess
import tempfile
import threading
from collections.abc import Generator
from dataclasses import dataclass
from pathlib import Path


class ProgramError(Exception):
    """The program could not be run, or it has failed; the text is for the user."""


@dataclass(frozen=True)
class Installation:
    """A working program."""

    path: str
    version: str
    home: Path  # of assets


@dataclass(frozen=True)
class Progress:
    """Progress of a job: a fraction, and the current step."""

    fraction: float
    text: str


Job = Generator[Progress, None, str]  # what it returns is for the user


def find_program(named: str) -> Installation:
    """The program at this path, or if it is empty the `veldt` on PATH, from `veldt doctor`."""
    path = shutil.which(named or "veldt")
    if path is None:
        raise ProgramError(
            f"program = {named or 'veldt'}; expected a program that can be run: see Preferences"
        )
    try:
        done = subprocess.run(
            [path, "doctor", "--json"], capture_output=True, text=True, timeout=60, check=False
        )
        findings = {entry["what"]: entry["found"] for entry in json.loads(done.stdout)}
        found = Installation(path, findings["veldt"], Path(findings["assets and scripts"]))
    except (OSError, ValueError, KeyError, TypeError, subprocess.TimeoutExpired) as error:
        raise ProgramError(f"{path} doctor = no answer ({error}); expected the program veldt") from error
    if not findings["assets and scripts"]:
        raise ProgramError(f"{path}: {_remedy(done.stdout)}")
    return found


def _remedy(report: str) -> str:
    return next(entry["remedy"] for entry in json.loads(report) if entry["what"] == "assets and scripts")


def run(program: str, arguments: list[str]) -> Job:
    """Run a command; yields its progress, several times a second. Returns its last output line.

    ProgramError with the command's own message if it fails; exit code 3 (some inputs were rejected) is one. Closing the
    generator stops the command.
    """
    with tempfile.TemporaryFile("w+", encoding="utf-8") as out:
        process = subprocess.Popen(
            [program, *arguments, "--progress", "json"],
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            errors="replace",
        )
        try:
            messages = yield from _watch(process, arguments[0])
        finally:
            if process.poll() is None:
                process.terminate()
            process.wait()
            process.stderr.close()
        out.seek(0)
        printed = out.read().strip()
    if process.returncode != 0:
        said = "\n".join(messages) or printed or "no message"
        raise ProgramError(f"veldt {arguments[0]} ended with exit code {process.returncode}: {said}")
    return "\n".join([*messages, printed])


def parse_progress(line: str, what: str) -> Progress | None:
    """The progress in a line of `--progress json`; None if the line is a message. Other events are progress too."""
    try:
        event = json.loads(line)
    except ValueError:
        return None
    if not isinstance(event, dict):
        return None
    counts = [(event[key], event[f"{key[:-5]}_total"], key[:-5]) for key in event if key.endswith("_done")]
    done, total, unit = counts[0] if counts else (0, 0, event.get("event", ""))
    text = f"{what}: {event.get('clip', '')} {done}/{total} {unit}" if counts else f"{what}: {unit}"
    return Progress(done / total if total else 0, text)


def _watch(process: subprocess.Popen, what: str) -> Generator[Progress, None, list[str]]:
    """Yields progress until the program ends; returns the lines that are not progress."""
    lines: queue.Queue[str | None] = queue.Queue()
    reader = threading.Thread(target=_read, args=(process.stderr, lines), daemon=True)
    reader.start()
    messages: list[str] = []
    latest = Progress(0, what)
    while True:
        try:
            line = lines.get(timeout=0.1)
        except queue.Empty:
            yield latest
            continue
        if line is None:
            reader.join()
            process.wait()
            return messages
        if (progress := parse_progress(line, what)) is not None:
            latest = progress
            yield latest
        elif line.strip():
            messages.append(line.strip())


def _read(stream, lines: queue.Queue) -> None:
    for line in stream:
        lines.put(line)
    lines.put(None)
