"""A small disk that can be filled: a file system in memory."""

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
    """A mounted disk. Dummy files occupy the disk space that must not be free."""

    def __init__(self, folder: Path):
        self.folder = folder

    def left(self) -> int:
        """Bytes that are free."""
        status = os.statvfs(self.folder)
        return status.f_bavail * status.f_frsize

    def leave(self, count: int) -> None:
        """Leave the given number of bytes free, in whole blocks."""
        self.free_space()
        (self.folder / "filling").write_bytes(bytes(self.left() - count))

    def free_space(self) -> None:
        """Free all disk space that the dummy files occupy."""
        (self.folder / "filling").unlink(missing_ok=True)

    def make_read_only(self) -> None:
        """Nothing can be written any more."""
        done = _run("mount", "-o", "remount,ro", self.folder)
        assert done.returncode == 0, done.stderr


@contextmanager
def small_disk(folder: Path, size: str = "2m") -> Iterator[SmallDisk]:
    """Mount a disk in a new folder; without permission, the test is skipped with the reason."""
    folder.mkdir()
    done = _run("mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder)
    if done.returncode != 0:
        pytest.skip(f"cannot mount a small disk: {done.stderr.strip()}")
    try:
        yield SmallDisk(folder)
    finally:
        _run("umount", "-l", folder)


def can_be_root_of_a_namespace() -> bool:
    """Whether an ordinary user can mount in a namespace of its own."""
    return _run("unshare", "-rm", "true").returncode == 0
