"""Fixtures of several test files."""

import pytest

import fake_blender
from configs import tiny


@pytest.fixture(name="blender")
def _blender(veldt):
    """A stand-in for Blender, and the tiny config beside it."""
    veldt.write("config.json", tiny())
    return fake_blender.install(veldt.folder)
