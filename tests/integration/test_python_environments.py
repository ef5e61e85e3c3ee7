"""`generate` with a real Blender from the shell of somebody who uses a Python of their own."""

import sys
from pathlib import Path

import pytest

from configs import tiny
from program import ROOT, Veldt
from python_environments import ENVIRONMENTS, venv


def _one_frame(config: dict) -> None:
    config["camera"] = {"width_px": 48, "height_px": 40, "pixel_pitch_um": 100}
    config["clips"] = [{**config["clips"][0], "frames": 1}]


def _generate(veldt, blender, env: dict | None = None):
    veldt.write("config.json", tiny(_one_frame))
    return veldt("generate", "config.json", "--out", "out", "--quiet", "--blender", blender, env=env)


@pytest.fixture(scope="module", name="usual")
def _usual(tmp_path_factory, blender) -> dict:
    """Hashes of the pixels made from a shell without any of that."""
    veldt = Veldt(tmp_path_factory.mktemp("usual"))
    done = _generate(veldt, blender)
    assert (done.code, done.err) == (0, "")
    return veldt.pixels("out")


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_it_makes_the_same_from_any_shell(veldt, tmp_path_factory, blender, usual, name):
    env = ENVIRONMENTS[name](tmp_path_factory.mktemp(name) / "prefix")
    done = _generate(veldt, blender, env)
    assert (done.code, done.out, done.err) == (0, "", "")
    assert veldt.pixels("out") == usual


def test_a_blender_without_numpy_says_so(veldt, tmp_path_factory, blender):
    """A script in front of Blender puts the venv back that `veldt` keeps from it."""
    if Path(blender).resolve() != Path("/usr/bin/blender"):
        pytest.skip("this Blender does not take its Python from PATH")
    prefix = tmp_path_factory.mktemp("venv") / "prefix"
    script = veldt.write("in_venv", f'#!/bin/sh\nPATH="{venv(prefix)["PATH"]}" exec {blender} "$@"\n')
    script.chmod(0o755)
    done = _generate(veldt, script)
    imported = (ROOT / "blender_scripts" / "planner" / "bake" / "baked.py").read_text().splitlines()
    line = imported.index("import numpy as np") + 1
    assert (done.code, done.out) == (1, "")
    assert done.err == (
        "veldt: Blender failed while building the scene: ModuleNotFoundError: No module named 'numpy'"
        f" (blender_scripts/planner/bake/baked.py:{line}); install NumPy for the Python"
        f" {sys.version_info.major}.{sys.version_info.minor} in {prefix} (apt-get install python3-numpy);"
        " log: out/passes/down.log\n"
    )
    assert "Traceback" in (veldt.folder / "out" / "passes" / "down.log").read_text()
