"""Fixtures for tests of the Python package."""

import json
import sys

import pytest

import passes
from configs import tiny
from program import Veldt
from veldt import open_dataset

# Behind the packages: `datasets` is Hugging Face's in these tests, not that of tests/support.
sys.path.sort(key=lambda folder: folder.endswith("support"))


@pytest.fixture(name="veldt", scope="session")
def _veldt(tmp_path_factory) -> Veldt:
    """The program, in a folder that all tests share."""
    return Veldt(tmp_path_factory.mktemp("veldt"))


@pytest.fixture(name="converted", scope="session")
def _converted(veldt):
    """A dataset of one clip, converted by the program, and the folder of its passes."""
    folder = passes.write_clip(veldt.folder / "one")
    done = veldt("convert", "one", "--out", "out", "--quiet")
    assert (done.code, done.err) == (0, "")
    return veldt.folder / "out", folder


@pytest.fixture(name="generated", scope="session")
def _generated(veldt):
    """A dataset that the program generated, with its config."""
    (veldt.folder / "tiny.json").write_text(json.dumps(tiny()), encoding="utf-8")
    done = veldt("generate", "tiny.json", "--out", "tiny", "--engine", "embree", "--quiet")
    assert (done.code, done.err) == (0, "")
    return open_dataset(veldt.folder / "tiny")
