"""A disk that is full from some call on: the command says to try again, whichever call it is."""

from __future__ import annotations

import errno
import re
from pathlib import Path

import pytest

from program import Veldt
from shims import Orders, Shims, can_compile, injected
from states import config

pytestmark = pytest.mark.skipif(not can_compile(), reason="no C compiler")


FULL = "No space left on device"


def test_every_folder_and_file_of_an_unfinished_plan_that_cannot_be_opened(tmp_path):
    left_over = f"veldt: warning: cannot remove {tmp_path}/out.part: {FULL}; the next run tries again\n"
    veldt = Veldt(tmp_path)
    veldt.write("config.json", config())
    shims, log = Shims.compiled(tmp_path), tmp_path / "injected.txt"
    for call in range(1, 100):
        log.unlink(missing_ok=True)
        values = {"PROGRAM": "veldt", "CALL": "open", "AT": call, "COUNT": 1000000, "ERROR": errno.ENOSPC}
        env = shims.preloaded(Orders(values=values), Path(tmp_path / "out.part"), log)
        done = veldt("plan", "config.json", "--out", "out", "--quiet", env=env)
        if done.code == 0:  # only what is left is looked for with this call, after all is done
            break
        assert done.code == 75 and re.fullmatch(rf"veldt: .*/out\.part\S*: {FULL}\n", done.err), done
        assert not (tmp_path / "out").exists()
    assert done.err == left_over and injected(log) > 0 and call > 3
