"""Hold a program at a moment, so that a test can act there, on a machine of any speed (see gate.c)."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

from processes import wait_until
from program import ROOT, Veldt


def compiled(folder: Path) -> Path:
    """The library that is preloaded."""
    library = folder / "gate.so"
    source = ROOT / "tests" / "support" / "gate.c"
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, source], check=True)
    return library


class Gate:
    """Holds one program, once, as it is about to open, make or rename to a path with a given end; for `with`.

    It goes on when the gate is opened, at the latest when the test ends. Then the gate can hold another.
    """

    def __init__(self, folder: Path, library: Path):
        self._library, self._fifo = library, folder / "gate"
        self._end: int | None = None  # of the FIFO, for as long as a program is held

    def __enter__(self) -> Gate:
        return self

    def __exit__(self, *_) -> None:
        if self._fifo.exists():
            self._is_held()
        self.open()

    def start(self, veldt: Veldt, before: str, *arguments) -> subprocess.Popen:
        """Start a run, and return when it is held before a path."""
        runtime = _sanitizer_of(veldt.program)  # must be the first library
        run = veldt.start(*arguments, env=self.variables(before, *runtime))
        self.wait_for(run)
        return run

    def around(self, program: str, before: str) -> Path:
        """A script that runs a program, which is held: for what `veldt` starts, and to which it hands no variables."""
        script = self._fifo.with_name("held")
        settings = " ".join(f"'{name}={value}'" for name, value in self.variables(before).items())
        script.write_text(f'#!/bin/sh\nexec env {settings} "{program}" "$@"\n', encoding="utf-8")
        script.chmod(0o755)
        return script

    def wait_for(self, run: subprocess.Popen | None = None) -> None:
        """Return when a program is held: this run, or one that it has started. A run that ends before is a fault."""
        assert wait_until(lambda: self._is_held() or run is not None and run.poll() is not None)
        assert self._end is not None, f"the run ended with {run.returncode} before: {run.communicate()}"
        self._fifo.unlink()

    def held(self) -> int:
        """The process that is held."""
        found: list[int] = []
        assert wait_until(lambda: found.extend(self._readers()) or found)
        return found[0]

    def open(self) -> None:
        """Have it go on."""
        if self._end is not None:
            os.close(self._end)
        self._end = None

    def variables(self, before: str, *runtime: Path) -> dict[str, str]:
        """The environment of a program that is to be held; `runtime`: libraries that must be the first."""
        assert self._end is None
        self._fifo.unlink(missing_ok=True)
        os.mkfifo(self._fifo)
        libraries = ":".join(map(str, [*runtime, self._library]))
        return {"LD_PRELOAD": libraries, "GATE": str(self._fifo), "GATE_BEFORE": before}

    def _is_held(self) -> bool:
        try:
            self._end = os.open(self._fifo, os.O_WRONLY | os.O_NONBLOCK)
        except OSError:  # ENXIO: no reader
            return False
        return True

    def _readers(self) -> list[int]:
        found = []
        for process in (int(folder.name) for folder in Path("/proc").glob("[0-9]*")):
            try:
                files = [os.readlink(file) for file in Path(f"/proc/{process}/fd").iterdir()]
            except OSError:  # ended meanwhile, or another user's
                continue
            if process != os.getpid() and any(file.startswith(str(self._fifo)) for file in files):
                found.append(process)
        return found


def _sanitizer_of(program: Path) -> list[Path]:
    """The runtime library of the sanitizer that a program is built with, if it is."""
    needed = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    lines = (line.split() for line in needed.splitlines())
    return [Path(words[2]) for words in lines if words[0].startswith(("libasan.", "libtsan."))]
