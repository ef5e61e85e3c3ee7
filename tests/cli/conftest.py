"""Fixtures of several test files."""

import shutil
import subprocess
from pathlib import Path

import pytest

import fake_blender
from configs import tiny
from program import ROOT, Veldt


@pytest.fixture(name="blender")
def _blender(veldt):
    """A stand-in for Blender, and the tiny config beside it."""
    veldt.write("config.json", tiny())
    return fake_blender.install(veldt.folder)


@pytest.fixture(scope="session", name="tiny_plan")
def _tiny_plan(tmp_path_factory) -> Path:
    """The plan that `generate` makes of the tiny config."""
    veldt = Veldt(tmp_path_factory.mktemp("tiny_plan"))
    veldt.write("config.json", tiny())
    blender = fake_blender.install(veldt.folder)
    assert fake_blender.generate(veldt, blender, "--quiet").code == 0
    return veldt.folder / "out" / "plan"


@pytest.fixture(name="planned")
def _planned(veldt, tiny_plan) -> None:
    """That plan where `generate --out out` looks for one: it saves most of a run's time."""
    shutil.copytree(tiny_plan, veldt.folder / "out" / "plan")


@pytest.fixture(scope="session", name="store")
def _store(tmp_path_factory) -> Path:
    """A library that, preloaded, refuses what an object store cannot do."""
    library = tmp_path_factory.mktemp("store") / "object_store.so"
    source = ROOT / "tests" / "support" / "object_store.c"
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, source], check=True)
    return library
