"""Fixtures for tests with a real Blender."""

import os
import shutil

import pytest


@pytest.fixture(scope="session", name="blender")
def _blender() -> str:
    """The Blender on PATH, or the one that BLENDER names."""
    found = os.environ.get("BLENDER") or shutil.which("blender")
    if found is None:
        pytest.fail("no Blender: neither on PATH nor named by BLENDER")
    return found
