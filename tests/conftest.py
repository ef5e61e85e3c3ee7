"""What tests of the program start from."""

import pytest

from program import Veldt


@pytest.fixture(name="veldt")
def _veldt(tmp_path) -> Veldt:
    """The program, in an empty folder."""
    return Veldt(tmp_path)
