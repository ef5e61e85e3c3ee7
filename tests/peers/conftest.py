"""Datasets for tests with third-party programs, which run in an environment of their own."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from program import ROOT, Veldt

# motmetrics' last release calls a function that NumPy 2 no longer has, and NumPy 1 has no wheels for Python 3.13.
if not hasattr(np, "asfarray"):
    np.asfarray = lambda values: np.asarray(values, float)

# Debian's own, because Debian's packages put their modules there.
_DRAWING_PYTHON = "/usr/bin/python3"


@pytest.fixture(scope="session", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A place with datasets and the passes they are made from: `masks` and `march`, of two clips each, and `survey`,
    whose camera has poses."""
    veldt = Veldt(tmp_path_factory.mktemp("peers"))
    draw = [_DRAWING_PYTHON, "-B", ROOT / "tests" / "peers" / "draw_passes.py", veldt.folder / "passes"]
    subprocess.run(draw, env=os.environ | {"PYTHONPATH": str(ROOT / "tests" / "support")}, check=True)
    for name in ("masks", "march"):
        done = veldt("convert", f"passes/{name}_a", f"passes/{name}_b", "--out", name, "--quiet")
        assert (done.code, done.out, done.err) == (0, "", "")
    done = veldt("convert", "passes/survey", "--out", "survey", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt


@pytest.fixture(scope="session", name="planes")
def _planes(place) -> dict[str, np.ndarray]:
    """Object index of every pixel of a clip's frames, (frames, height, width)."""
    return {file.stem: np.load(file) for file in (place.folder / "passes").glob("*.npy")}


@pytest.fixture(scope="session", name="export")
def _export(place):
    """export(dataset, format, options…) -> folder."""

    def export(dataset: str, layout: str, *options) -> Path:
        out = f"{dataset}_{layout}{'_'.join(options)}".replace(":", "_")
        if not (place.folder / out).exists():
            done = place("export", dataset, "--format", layout, "--out", out, "--quiet", *options)
            assert (done.code, done.out, done.err) == (0, "", "")
        return place.folder / out

    return export
