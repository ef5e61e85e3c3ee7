"""Report failures of scripts to the user: the exception's last line, its location in these scripts, and a hint.

This module imports nothing but Python's standard library, because it also reports missing modules.
"""

from __future__ import annotations

import errno
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from planner.faults import ConfigError, ProcessLost

_TRY_AGAIN = 75
_KILLED_HINT = "unless someone killed it, the machine may have run out of memory"
_SCRIPTS = Path(__file__).resolve().parents[1]
_MODULES = {"numpy": ("NumPy", "python3-numpy"), "OpenImageIO": ("OpenImageIO", "python3-openimageio")}


@dataclass(frozen=True)
class Failure:
    """Cause of a script's failure, in one line each; `hint` may be empty."""

    exit_code: int  # 2 for a fault of the config, 75 for a full disk or a killed process, else 1
    message: str  # "ModuleNotFoundError: No module named 'numpy'"; of our own exceptions, the bare message
    where: str  # "blender_scripts/planner/noise.py:8"; empty if unknown
    hint: str  # "install NumPy …"

    @property
    def is_config_fault(self) -> bool:
        """Whether the config is at fault, and not the scripts or the machine."""
        return self.exit_code == 2

    def in_words(self) -> str:
        """The failure in one line; for a fault of the config, the message alone."""
        if self.is_config_fault:
            return self.message
        where = f" ({self.where})" if self.where else ""
        return f"{self.message}{where}" + (f"; {self.hint}" if self.hint else "")


def failure_of(error: BaseException) -> Failure:
    """Describes an exception that ended a script; call it while the exception is being handled."""
    if isinstance(error, ConfigError):
        return Failure(2, str(error), _place(error), "")
    if isinstance(error, ProcessLost):
        code, hint = (_TRY_AGAIN, _KILLED_HINT) if error.killed else (1, "")
        return Failure(code, str(error), "", hint)
    is_full = isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT)
    return Failure(_TRY_AGAIN if is_full else 1, _last_line(error), _place(error), _hint(error))


def run(act: Callable[[], None], report: Callable[[BaseException], int] | None = None) -> int:
    """Call `act`, report a failure, and return the exit code: 0 done, 1 failed, 2 invalid config, 75 the disk is full
    or a child process was killed. `report` returns the code of a failure; without it, the failure goes to stderr, with
    a summary in the last line.
    """
    try:
        act()
    except BaseException as error:  # pylint: disable=broad-exception-caught
        return (report or _report)(error)
    return 0


@contextmanager
def reported_imports() -> Iterator[None]:
    """Reports imports that fail as run() does, and exits."""
    try:
        yield
    except BaseException as error:  # pylint: disable=broad-exception-caught
        sys.exit(_report(error))


def _report(error: BaseException) -> int:
    failure = failure_of(error)
    if not failure.is_config_fault:
        traceback.print_exception(error)
    print(failure.in_words(), file=sys.stderr)
    return failure.exit_code


def _last_line(error: BaseException) -> str:
    """Type and message of an exception; of a multi-line message, the last non-empty line."""
    text = error.msg if isinstance(error, SyntaxError) else str(error)
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return ": ".join([type(error).__name__, *lines[-1:]])


def _place(error: BaseException) -> str:
    """File and line of the innermost frame in these scripts; of a syntax error, its own location."""
    steps = [(step.filename, step.lineno) for step in traceback.extract_tb(error.__traceback__)]
    if isinstance(error, SyntaxError):
        steps.append((error.filename or "", error.lineno))
    ours = [(Path(file).resolve(), line) for file, line in steps if file and not file.startswith("<")]
    for file, line in reversed(ours):
        if file.is_relative_to(_SCRIPTS):
            return f"{file.relative_to(_SCRIPTS.parent)}:{line}"
    return "outside of blender_scripts"


def _hint(error: BaseException) -> str:
    module = (error.name or "").partition(".")[0] if isinstance(error, ModuleNotFoundError) else ""
    if module not in _MODULES:
        return ""
    name, package = _MODULES[module]
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    return f"install {name} for the Python {version} in {sys.prefix} (apt-get install {package})"
