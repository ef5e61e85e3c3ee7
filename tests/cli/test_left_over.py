"""Temporary folders that cannot be removed: a warning names them, the data are complete, and the next run removes
them."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

import passes
from configs import tiny
from datasets import content_of
from program import Veldt

# Root may remove anything, but for these.
WITH_RIGHTS = ("setpriv", "--bounding-set=-dac_override,-dac_read_search") if os.geteuid() == 0 else ()

pytestmark = pytest.mark.skipif(not shutil.which("setpriv"), reason="no setpriv")


@pytest.fixture(scope="module", name="made")
def _made(tmp_path_factory) -> Veldt:
    """A plan, a dataset of it, and one that is converted."""
    veldt = Veldt(tmp_path_factory.mktemp("made"))
    config = tiny()
    config["render"] = {"actor_layer": True, "engine": "embree"}
    veldt.write("config.json", config)
    passes.write_clip(veldt.folder / "one")
    for command in (PLAN, GENERATE, SCRATCH, CONVERT):
        assert veldt(*command).code == 0
    return veldt


PLAN = ("plan", "config.json", "--out", "plan", "--quiet")
GENERATE = ("generate", "config.json", "--out", "out", "--quiet")
SCRATCH = ("generate", "--plan", "plan", "--out", "whole", "--scratch", "scratch", "--quiet")
CONVERT = ("convert", "one", "--out", "converted", "--quiet")
CASES = {
    "a plan": (PLAN, "plan.part"),
    "a dataset's plan": (GENERATE, "out/plan.part"),
    "an earlier clip": (GENERATE, "out/clips/down.part"),
    "passes": (GENERATE, "out/passes/down"),
    "a clip in a scratch folder": (SCRATCH, "scratch/side.part"),
    "passes in a scratch folder": (SCRATCH, "scratch/passes/side"),
    "a converted clip": (CONVERT, "converted/clips/one.part"),
}


@pytest.mark.parametrize("name", CASES)
def test_what_cannot_be_removed_is_named_until_it_can(made, tmp_path, name):
    command, left = CASES[name]
    veldt = Veldt(tmp_path / "made")
    shutil.copytree(made.folder, veldt.folder, symlinks=True)
    folder = veldt.folder / left / "kept"
    folder.mkdir(parents=True)
    (folder / "file").touch()
    folder.chmod(0o555)
    shown = veldt.folder / left if command == PLAN else Path(left)
    try:
        done = veldt(*command, under=WITH_RIGHTS)
    finally:
        folder.chmod(0o755)
    expected = [f"veldt: warning: cannot remove {shown}: Permission denied; the next run tries again"]
    assert (done.code, done.out, done.err.splitlines()[:1]) == (0, "", expected)
    assert folder.is_dir()
    done = veldt(*command)
    assert (done.code, done.out, done.err) == (0, "", "")
    assert content_of(veldt.folder) == content_of(made.folder)
    assert not (veldt.folder / left).exists()
