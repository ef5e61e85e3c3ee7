"""Run the built program like a user, in a separate folder."""

from __future__ import annotations

import atexit
import functools
import json
import os
import re
import resource
import select
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from processes import PATIENCE_S

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("VELDT_PROGRAM") or ROOT / "build" / "release" / "bin" / "veldt")
# The end of each fault about a link.
NO_LINKS = "expected a path that is not a link; nothing elsewhere is read or written"
# Such lines come when a run takes longer than some seconds: how many depends on the machine.
_PROGRESS = re.compile(r"^\d+/\d+ (\w+), \d+\.\d \1/s, .*, clip .*\n", re.MULTILINE)


@dataclass(frozen=True)
class Ended:
    """How a run ended."""

    code: int
    out: str
    err: str

    def json(self):
        """What it printed, read as JSON."""
        return json.loads(self.out)


def check_fault(done: Ended, code: int, message: str) -> None:
    """Check that a run printed one message, on standard error, and nothing else."""
    assert (done.code, done.out, done.err) == (code, "", f"veldt: {message}\n")


def _without_progress(words: Sequence[str], done: Ended) -> Ended:
    asked = any(word.startswith("--progress") for word in words)
    return done if asked else Ended(done.code, done.out, _PROGRESS.sub("", done.err))


class _CommandServer:
    """A running command_server.cpp."""

    def __init__(self, program: Path):
        bound = os.environ | {"LD_BIND_NOW": "1"}  # once here instead of in each child
        self._process = subprocess.Popen(
            [program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=bound
        )
        atexit.register(self._end)

    def run(self, words: list[str], environment: dict[str, str], folder: Path) -> Ended:
        """Run a command line to the end."""
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            files = {
                name: f"/proc/{os.getpid()}/fd/{file.fileno()}" for name, file in (("out", out), ("err", err))
            }
            order = {"arguments": words, "environment": environment, "folder": str(folder)} | files
            self._process.stdin.write(json.dumps(order) + "\n")
            self._process.stdin.flush()
            if not select.select([self._process.stdout], [], [], PATIENCE_S)[0]:
                self._process.kill()
                _server.cache_clear()
                raise subprocess.TimeoutExpired(words, PATIENCE_S)
            return Ended(int(self._process.stdout.readline()), _text(out), _text(err))

    def used_s(self) -> float:
        """Processor time of the runs that have ended."""
        stat = Path(f"/proc/{self._process.pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
        return (int(stat[13]) + int(stat[14])) / os.sysconf("SC_CLK_TCK")

    def _end(self) -> None:
        self._process.stdin.close()
        self._process.wait()


@functools.cache
def _server(program: Path) -> _CommandServer | None:
    """The one for this program, where it has been built with tests."""
    server = program.parent / "command_server"
    return _CommandServer(server) if server.exists() else None


def used_s(program: Path = PROGRAM) -> float:
    """Processor time of all runs that have ended."""
    used, server = resource.getrusage(resource.RUSAGE_CHILDREN), _server(program)
    return used.ru_utime + used.ru_stime + (server.used_s() if server else 0)


def _is_text(word: str) -> bool:
    """Whether JSON can hold it: names of files may be any bytes."""
    return not any("\ud800" <= letter <= "\udfff" for letter in word)


def _text(file) -> str:
    """All that was written to a file, as subprocess reads it."""
    file.seek(0)
    return file.read().decode().replace("\r\n", "\n").replace("\r", "\n")


class Veldt:
    """The program, run in `folder`, so that its messages contain short paths."""

    def __init__(self, folder: Path, program: Path = PROGRAM):
        self.folder = folder
        self.program = program

    def __call__(self, *arguments, env: dict | None = None, under: Sequence[str] = ()) -> Ended:
        """Run to the end. `env` changes the environment; `under` is a command that runs the program. `err` has no
        lines of progress, unless --progress asks for them.

        Without either, a process that has loaded the program's libraries runs the command (command_server.cpp).
        """
        words, environment = list(map(str, arguments)), _environment(env)
        server = _server(self.program)
        if server and not under and not env and all(map(_is_text, [*words, *environment.values()])):
            return _without_progress(words, server.run(words, environment, self.folder))
        done = subprocess.run(
            [*under, self.program, *words],
            cwd=self.folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
        )
        return _without_progress(words, Ended(done.returncode, done.stdout, done.stderr))

    def start(self, *arguments, env: dict | None = None) -> subprocess.Popen:
        """Start a run in the background; its progress can be read from `stderr`, line by line."""
        return subprocess.Popen(
            [self.program, *map(str, arguments)],
            cwd=self.folder,
            env=_environment(env),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def write(self, name: str, content) -> Path:
        """Write a file of text, or of JSON."""
        file = self.folder / name
        file.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
        return file

    def read(self, name: str | Path):
        """Read a file of JSON."""
        return json.loads((self.folder / name).read_text(encoding="utf-8"))

    def pixels(self, dataset: str | Path) -> dict[str, str]:
        """Hashes of a dataset's pixels, clip by clip; the dataset must be complete."""
        index = self.read(Path(dataset) / "dataset.json")
        assert index["status"] == "complete"
        return {"all": index["pixels_sha256"]} | {c["id"]: c["pixels_sha256"] for c in index["clips"]}


def _environment(changes: dict | None) -> dict:
    """This process's environment without settings of the program, then changed."""
    inherited = {key: value for key, value in os.environ.items() if not key.startswith("VELDT_")}
    return inherited | (changes or {})


def files_below(folder: Path) -> list[str]:
    """Names of all files in a folder and below, sorted."""
    return sorted(str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file())
