"""Fixtures of several test files."""

import subprocess
from pathlib import Path

import pytest

import fake_blender
from configs import tiny
from program import ROOT


@pytest.fixture(name="blender")
def _blender(veldt):
    """A stand-in for Blender, and the tiny config beside it."""
    veldt.write("config.json", tiny())
    return fake_blender.install(veldt.folder)


@pytest.fixture(scope="session", name="store")
def _store(tmp_path_factory) -> Path:
    """A library that, preloaded, refuses what an object store cannot do."""
    library = tmp_path_factory.mktemp("store") / "object_store.so"
    source = ROOT / "tests" / "support" / "object_store.c"
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, source], check=True)
    return library
