"""The libraries that are preloaded into a run, and their orders."""

from __future__ import annotations

import collections
import os
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

_HERE = Path(__file__).resolve().parent
_PYTHON = "/usr/bin/python3"


def can_compile() -> bool:
    """Whether this machine has a C compiler."""
    return subprocess.run(["cc", "--version"], capture_output=True, check=False).returncode == 0


@dataclass
class Shims:
    """Compiled libraries, in a folder."""

    folder: Path

    @classmethod
    def compiled(cls, folder: Path) -> Shims:
        """Compile both."""
        for name in ("fault_shim", "machine_shim"):
            flags = ["-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror"]
            subprocess.run(
                ["cc", *flags, "-o", folder / f"{name}.so", _HERE / f"{name}.c", "-ldl"], check=True
            )
        return cls(folder)

    def preloaded(self, orders: Orders, under: Path, log: Path) -> dict[str, str]:
        """The environment that preloads what these orders need."""
        library = self.folder / f"{orders.library}.so"
        orders_given = {f"FAULT_{name}": str(value) for name, value in orders.values.items()}
        return {"LD_PRELOAD": str(library), "FAULT_UNDER": str(under), "FAULT_LOG": str(log)} | orders_given

    def python(self, program: Path, environment: dict[str, str]) -> Path:
        """Write a Python for the planner, to which the run hands down no variables, that sets its own."""
        settings = " ".join(f"'{name}={value}'" for name, value in environment.items())
        program.write_text(f'#!/bin/sh\nexec env {settings} {_PYTHON} "$@"\n', encoding="utf-8")
        program.chmod(0o755)
        return program


@dataclass(frozen=True)
class Orders:
    """What a library is to inject."""

    library: str = "fault_shim"
    values: dict[str, object] = field(default_factory=dict)


TALLY = Orders(values={"TALLY": 1})


def injected(log: Path) -> int:
    """Faults that really happened."""
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines() if log.exists() else []
    return sum(line.split(" ")[2] != "crash" for line in lines)


def crashed_in(log: Path) -> str:
    """The file whose code crashed, of the programs that run without memory: a library, or a program; "" if none did."""
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines() if log.exists() else []
    return next((line.split(" ")[3] for line in lines if line.split(" ")[2] == "crash"), "")


def tally(log: Path) -> dict[tuple[str, str], int]:
    """By program and kind of call, how often the busiest process of the program calls."""
    counts: collections.Counter = collections.Counter()
    for line in log.read_text(encoding="utf-8", errors="replace").splitlines():
        program, process, call = line.split(" ")[:3]
        counts[program, process, call] += 1
    most: dict[tuple[str, str], int] = {}
    for (program, _, call), count in counts.items():
        key = (program, call)
        most[key] = max(most.get(key, 0), count)
    return most


def is_root() -> bool:
    """Whether disks can be mounted and rights given up."""
    return os.geteuid() == 0
