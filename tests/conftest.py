"""Fixtures for tests of the program."""

import pytest

from program import Veldt


@pytest.fixture(name="veldt")
def _veldt(tmp_path) -> Veldt:
    """The program, in an empty folder."""
    return Veldt(tmp_path)
