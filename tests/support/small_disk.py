"""A disk of its own, so small that it fills: memory that is mounted as a file system."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

BLOCK = 4096  # what a file takes at least, and by what it grows


def _run(*command) -> subprocess.CompletedProcess:
    return subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)


class SmallDisk:
    """A mounted disk. Files of no use take the room that is not to be left."""

    def __init__(self, folder: Path):
        self.folder = folder

    def left(self) -> int:
        """Bytes that are free."""
        told = os.statvfs(self.folder)
        return told.f_bavail * told.f_frsize

    def leave(self, count: int) -> None:
        """Leaves so many bytes free, in whole blocks."""
        self.make_room()
        (self.folder / "filling").write_bytes(bytes(self.left() - count))

    def make_room(self) -> None:
        """All that is not used by others is free again."""
        (self.folder / "filling").unlink(missing_ok=True)

    def make_read_only(self) -> None:
        """Nothing can be written any more."""
        done = _run("mount", "-o", "remount,ro", self.folder)
        assert done.returncode == 0, done.stderr


@contextmanager
def small_disk(folder: Path, size: str = "2m") -> Iterator[SmallDisk]:
    """Mounts a disk in a new folder; where nobody lets us, the test is skipped and says why."""
    folder.mkdir()
    done = _run("mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder)
    if done.returncode != 0:
        pytest.skip(f"cannot mount a small disk: {done.stderr.strip()}")
    try:
        yield SmallDisk(folder)
    finally:
        _run("umount", "-l", folder)


def can_be_root_of_a_namespace() -> bool:
    """Whether an ordinary user can mount where nobody else sees it."""
    return _run("unshare", "-rm", "true").returncode == 0
