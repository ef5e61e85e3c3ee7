"""Read files named by a config, which are untrusted."""

from __future__ import annotations

import errno
import stat
from pathlib import Path


def read_regular(path: Path, most_bytes: int) -> bytes:
    """A file's content. OSError if it cannot be read, is not regular (reading a device or a pipe may never end), or
    exceeds most_bytes.
    """
    status = path.stat()
    if not stat.S_ISREG(status.st_mode) and not stat.S_ISDIR(status.st_mode):
        raise OSError(errno.EINVAL, "it is a device or a pipe")
    if status.st_size > most_bytes:
        raise OSError(errno.EFBIG, f"it has {status.st_size} bytes, more than {most_bytes}")
    return path.read_bytes()
