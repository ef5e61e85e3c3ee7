"""Fixtures for tests of the program."""

from pathlib import Path

import pytest

import gate
from program import Veldt


@pytest.fixture(name="veldt")
def _veldt(tmp_path) -> Veldt:
    """The program, in an empty folder."""
    return Veldt(tmp_path)


@pytest.fixture(scope="session", name="gate_library")
def _gate_library(tmp_path_factory) -> Path:
    return gate.compiled(tmp_path_factory.mktemp("gate_library"))


@pytest.fixture(name="gate")
def _gate(tmp_path_factory, gate_library):
    """Holds a program at a moment."""
    with gate.Gate(tmp_path_factory.mktemp("gate"), gate_library) as one:
        yield one
