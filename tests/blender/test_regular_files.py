"""Files that a config names may be devices, pipes or of any size: each ends in an error at once."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from planner.faults import ConfigError
from planner.flight.texts import read_text
from planner.land.grey_images import read_grey
from planner.model_files import survey
from planner.regular_files import read_regular


def test_a_file_up_to_its_limit(tmp_path: Path):
    file = tmp_path / "file"
    file.write_bytes(b"12345")
    assert read_regular(file, 5) == b"12345"
    with pytest.raises(OSError, match="it has 5 bytes, more than 4"):
        read_regular(file, 4)
    with pytest.raises(IsADirectoryError):
        read_regular(tmp_path, 1 << 30)


def _pipe(folder: Path) -> Path:
    os.mkfifo(folder / "pipe.png")
    return folder / "pipe.png"


@pytest.mark.parametrize("make", [_pipe, lambda folder: Path("/dev/zero")])
def test_devices_and_pipes(tmp_path: Path, make):
    file = make(tmp_path)
    with pytest.raises(ConfigError, match=r"expected a readable file \(it is a device or a pipe\)"):
        read_grey(file, "scene.terrain.heightmap.file")
    with pytest.raises(ConfigError, match="expected a regular file"):
        read_text(str(file), "clips[0].flight.waypoints.file")
    with pytest.raises(OSError, match="it is a device or a pipe"):
        survey(file)
