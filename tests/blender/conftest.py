"""Fixtures: the small place of `scenes.tiny`, planned and rendered once for all tests."""

import os
from pathlib import Path

import pytest

import numpy_settings

os.environ.update(numpy_settings.REPRODUCIBLE)  # before NumPy is imported

from plans import bake
from rendering import Run, render
from scenes import tiny
from planner.world import World, plan_world


@pytest.fixture(scope="session", name="full")
def _full(tmp_path_factory) -> Run:
    run = render(tmp_path_factory.mktemp("full"), tiny())
    assert run.code == 0, run.log
    return run


@pytest.fixture(scope="session", name="plan")
def _plan(tmp_path_factory) -> Path:
    return bake(tiny(), tmp_path_factory.mktemp("plan") / "plan")


@pytest.fixture(scope="session", name="world")
def _world() -> World:
    return plan_world(tiny())
