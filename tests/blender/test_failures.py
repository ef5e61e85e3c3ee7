"""How a failed script reports itself: the exception's last line, its place in these scripts, and a hint."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from python_environments import venv
from planner import failures
from planner.config import ROOT
from planner.faults import ConfigError

SCRIPTS = ROOT / "blender_scripts"


def _failure(act) -> failures.Failure:
    """How an act fails."""
    try:
        act()
    except BaseException as error:  # pylint: disable=broad-exception-caught
        return failures.failure_of(error)
    raise AssertionError("it did not fail")


def _raise(error: BaseException) -> None:
    raise error


@pytest.mark.parametrize(
    "error, message",
    [
        (ValueError("no mesh"), "ValueError: no mesh"),
        (ValueError(), "ValueError"),
        (KeyError("water"), "KeyError: 'water'"),
        (RuntimeError("Error: no file\n"), "RuntimeError: Error: no file"),
        (ImportError("\n\nIMPORTANT: READ THIS\n\nno libblas\n\n"), "ImportError: no libblas"),
        (MemoryError(), "MemoryError"),
        (SystemExit(3), "SystemExit: 3"),
        (KeyboardInterrupt(), "KeyboardInterrupt"),
    ],
)
def test_an_exception_is_its_type_and_its_last_line(error, message):
    failure = _failure(lambda: _raise(error))
    assert (failure.message, failure.hint, failure.exit_code) == (message, "", 1)


def test_a_fault_of_the_config_is_its_own_words():
    failure = _failure(lambda: _raise(ConfigError("seed = 0; expected more")))
    assert (failure.in_words(), failure.exit_code) == ("seed = 0; expected more", 2)


def test_the_place_is_the_innermost_of_these_scripts():
    """Not that in Python's library, which refuses a number as a path, nor that of the caller."""
    from planner.config import load  # pylint: disable=import-outside-toplevel

    failure = _failure(lambda: load(7))
    lines = (SCRIPTS / "planner" / "config.py").read_text().splitlines()
    file, _, line = failure.where.partition(":")
    assert file == "blender_scripts/planner/config.py" and "Path(path).read_bytes" in lines[int(line) - 1]


def test_without_a_frame_of_these_scripts_the_place_says_so():
    assert _failure(lambda: _raise(ValueError("no mesh"))).where == "outside of blender_scripts"


@pytest.fixture(scope="module", name="bare_python")
def _bare_python(tmp_path_factory) -> Path:
    """A Python without NumPy."""
    folder = tmp_path_factory.mktemp("venv") / "prefix"
    venv(folder)
    return folder / "bin" / "python3"


def _hint(python: Path) -> str:
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    prefix = python.parent.parent
    return f"install NumPy for the Python {version} in {prefix} (apt-get install python3-numpy)"


def _is_import_of_numpy(where: str) -> bool:
    file, _, line = where.partition(":")
    return (ROOT / file).read_text().splitlines()[int(line) - 1].strip() == "import numpy as np"


@pytest.mark.parametrize("script", ["plan_scene.py", "draw_map.py"])
def test_a_python_without_numpy_says_so_in_its_last_line(bare_python, script):
    done = subprocess.run(
        [bare_python, "-I", "-B", SCRIPTS / script, "--config", "none", "--out", "none"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (1, "")
    first, *_, last = done.stderr.splitlines()
    message, _, rest = last.partition(" (")
    where, _, hint = rest.partition("); ")
    assert first == "Traceback (most recent call last):"
    assert message == "ModuleNotFoundError: No module named 'numpy'"
    assert _is_import_of_numpy(where) and hint == _hint(bare_python)


def _events_of(python: Path, script: Path) -> tuple[int, list[dict]]:
    """Exit code and events of a script that fails before it needs a Blender."""
    reader, writer = os.pipe()
    with open(reader, encoding="utf-8") as events:
        command = [
            python,
            "-B",
            script,
            "--",
            "--plan",
            "none",
            "--out",
            "none",
            "--events-fd",
            str(writer),
        ]
        done = subprocess.run(command, pass_fds=[writer], capture_output=True, check=False)
        os.close(writer)
        return done.returncode, [json.loads(line) for line in events]


@pytest.mark.parametrize("script", ["render_passes.py", "profile_render.py"])
def test_imports_that_fail_in_blender_are_an_event(bare_python, script):
    """Plain Python is enough: NumPy, or bpy, is missing there before a Blender is needed."""
    code, events = _events_of(bare_python, SCRIPTS / script)
    where, hint = events[0].pop("where"), events[0].pop("hint", None)
    missing = "numpy" if script == "render_passes.py" else "bpy"
    message = f"ModuleNotFoundError: No module named '{missing}'"
    assert (code, events) == (1, [{"event": "error", "kind": "internal", "message": message}])
    if missing == "numpy":
        assert _is_import_of_numpy(where) and hint == _hint(bare_python)
    else:
        assert where.startswith("blender_scripts/profile_render.py:") and hint is None


def test_a_syntax_error_is_placed_where_it_is(bare_python, tmp_path):
    """In the file that cannot be read, not in the one that imports it."""
    scripts = tmp_path / "blender_scripts"
    (scripts / "planner").mkdir(parents=True)
    (scripts / "veldt_bl").mkdir()
    for name in (
        "planner/__init__",
        "planner/events",
        "planner/failures",
        "planner/faults",
        "veldt_bl/entry",
    ):
        (scripts / f"{name}.py").write_text((SCRIPTS / f"{name}.py").read_text())
    (scripts / "render_passes.py").write_text((SCRIPTS / "render_passes.py").read_text())
    (scripts / "planner" / "bake").mkdir()
    (scripts / "planner" / "bake" / "baked.py").write_text("A = 1\nB = = 2\n")
    code, events = _events_of(bare_python, scripts / "render_passes.py")
    assert (code, events) == (
        1,
        [
            {
                "event": "error",
                "kind": "internal",
                "message": "SyntaxError: invalid syntax",
                "where": "blender_scripts/planner/bake/baked.py:2",
            }
        ],
    )
