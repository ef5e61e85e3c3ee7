"""Shells of people who use a Python of their own. A Blender that sees their PATH and variables fails."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path


def venv(folder: Path) -> dict[str, str]:
    """An active venv without packages."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
    return {"VIRTUAL_ENV": str(folder), "PATH": _path(folder / "bin")}


def pyenv(folder: Path) -> dict[str, str]:
    """Shims of a pyenv, and the version they chose first on PATH, as `pyenv exec` sets it."""
    version = folder / "versions" / "3.11.9"
    _add_pythons(version / "bin", "exit 1")
    _add_libraries(version / "lib")
    _add_pythons(folder / "shims", f'exec "{version}/bin/python3" "$@"')
    return {
        "PYENV_ROOT": str(folder),
        "PYENV_VERSION": "3.11.9",
        "PATH": f"{version}/bin{os.pathsep}{_path(folder / 'shims')}",
    }


def conda(folder: Path) -> dict[str, str]:
    """An active conda environment with another Python's library, and a PYTHONPATH with a NumPy that fails."""
    _add_pythons(folder / "bin", "exit 1")
    _add_libraries(folder / "lib")
    junk = folder / "junk"
    junk.mkdir()
    (junk / "numpy.py").write_text("raise ImportError('the NumPy of PYTHONPATH')\n", encoding="utf-8")
    return {
        "CONDA_PREFIX": str(folder),
        "CONDA_DEFAULT_ENV": "thermal",
        "PYTHONHOME": str(folder),
        "PYTHONPATH": str(junk),
        "LD_LIBRARY_PATH": str(folder / "lib"),
        "PATH": _path(folder / "bin"),
    }


ENVIRONMENTS: dict[str, Callable[[Path], dict[str, str]]] = {"venv": venv, "pyenv": pyenv, "conda": conda}


def _add_libraries(folder: Path) -> None:
    """What a Python, and so Blender's, looks for to find its prefix."""
    for name in ("python3.11", "python3.13"):
        (folder / name).mkdir(parents=True)
        (folder / name / "os.py").write_text("raise ImportError('another os')\n", encoding="utf-8")


def _add_pythons(folder: Path, script: str) -> None:
    folder.mkdir(parents=True)
    for name in ("python", "python3", "python3.11", "python3.13"):
        program = folder / name
        program.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
        program.chmod(0o755)


def _path(first: Path) -> str:
    return f"{first}{os.pathsep}{os.environ['PATH']}"
