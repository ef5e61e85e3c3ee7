"""The errors of the package."""

import pickle

import pytest

import veldt


@pytest.mark.parametrize("name", ["ConfigError", "DataError", "IoError", "TryAgainError", "Cancelled"])
def test_errors_are_of_one_kind_and_can_be_sent_between_processes(name):
    kind = getattr(veldt, name)
    assert issubclass(kind, veldt.Error)
    again = pickle.loads(pickle.dumps(kind("why")))
    assert (type(again), str(again)) == (kind, "why")
