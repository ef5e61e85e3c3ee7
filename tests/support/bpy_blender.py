"""Stands in for the Blender program where only its Python module `bpy` is installed: runs a script as Blender would.

    python bpy_blender.py -b --factory-startup --disable-autoexec --python-exit-code 1 -t 2 --python FILE -- ARGS …
    python bpy_blender.py --version

Of Blender's options it knows those that this project uses. Run it with the Python that has the module.
"""

from __future__ import annotations

import argparse
import os
import runpy
import sys
import traceback
from pathlib import Path

import bpy


def main(arguments: list[str]) -> int:
    """Execute Blender's command line and return its exit code."""
    end = arguments.index("--") if "--" in arguments else len(arguments)
    options = _parse(arguments[:end])
    if options.version:
        print(f"Blender {bpy.app.version_string} (bpy)")
        return 0
    bpy.ops.wm.read_factory_settings()
    _limit_threads(options.threads)
    sys.argv = ["blender", *arguments]
    return _run(options.python, options.python_exit_code)


def _parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="blender", allow_abbrev=False)
    parser.add_argument("-b", "--background", action="store_true", help="always; it has no window")
    parser.add_argument("--factory-startup", action="store_true", help="always")
    parser.add_argument(
        "--disable-autoexec", action="store_true", help="always: no .blend file's scripts are run"
    )
    parser.add_argument("--python-exit-code", type=int, default=0)
    parser.add_argument("-t", "--threads", type=int, default=0)
    parser.add_argument("--python", type=Path)
    parser.add_argument("--version", action="store_true")
    return parser.parse_args(arguments)


def _limit_threads(threads: int) -> None:
    """The module has no -t; a scene's own number of threads does the same for rendering. 0: one a core."""
    if threads > 0:
        for scene in bpy.data.scenes:
            scene.render.threads_mode, scene.render.threads = "FIXED", threads


def _run(script: Path, exit_code: int) -> int:
    """Run a script and return its exit code; `exit_code` if it raises an exception."""
    try:
        runpy.run_path(str(script), run_name="__main__")
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:  # pylint: disable=broad-exception-caught
        traceback.print_exc()
        return exit_code
    return 0


def _leave(code: int) -> None:
    """Ends at once: the module's own tidying up may crash after all is done."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


if __name__ == "__main__":
    _leave(main(sys.argv[1:]))
