"""A Python that runs the planner up to a chosen moment and holds it there, so that a test can kill it.

The planner is the real one: only the function that follows the moment is replaced.
"""

from __future__ import annotations

import runpy
import sys
import time
from pathlib import Path

# Orders lie beside the program: its environment is not that of the test.
_ORDER, _HELD = "planner_holds_at.txt", "planner_is_held.txt"

# Before anything is baked; with half of scene.bin written; in a worker, with the first track written.
MOMENTS = ("planning", "baking the scene", "baking tracks")


def install(folder: Path) -> Path:
    """Write a program for VELDT_PYTHON that runs this file, and return its path."""
    program = folder / "held_python"
    program.write_text(
        f'#!/bin/sh\nexec "{sys.executable}" -I -B "{__file__}" "{folder}" "$@"\n', encoding="utf-8"
    )
    program.chmod(0o755)
    return program


def hold_at(folder: Path, moment: str) -> None:
    """Has the planner started by the program of `folder` stop, once, at one of MOMENTS."""
    (folder / _HELD).unlink(missing_ok=True)
    (folder / _ORDER).write_text(moment, encoding="utf-8")


def is_held(folder: Path) -> bool:
    """Whether the planner has reached the moment."""
    return (folder / _HELD).exists()


def _main() -> None:
    folder, script = Path(sys.argv[1]), Path(sys.argv[3])  # after -I
    sys.argv = sys.argv[3:]
    sys.path.insert(0, str(script.parent))
    order = folder / _ORDER
    if order.exists():
        _replace(order.read_text(encoding="utf-8"), folder)
        order.unlink()
    runpy.run_path(str(script), run_name="__main__")


def _replace(moment: str, folder: Path) -> None:
    """Make the function that follows the moment hold."""
    from planner.bake import folder as plan_folder  # pylint: disable=import-outside-toplevel
    from planner.bake import scene  # pylint: disable=import-outside-toplevel

    bake_track = plan_folder.bake_track

    def hold(*_) -> None:
        (folder / _HELD).touch()
        time.sleep(3600)  # longer than any test waits; this Python finds no module of the tests

    def write_half(path: Path, *_) -> None:
        path.with_suffix(".bin").write_bytes(b"half a scene")
        hold()

    def bake_one(*track, **more) -> None:
        bake_track(*track, **more)
        hold()

    if moment == MOMENTS[0]:
        plan_folder.bake_scene = hold
    elif moment == MOMENTS[1]:
        scene.write = write_half
    else:
        assert moment == MOMENTS[2]
        plan_folder.bake_track = bake_one


if __name__ == "__main__":
    _main()
