"""Distinguish complete EXR files from truncated ones.

Blender reports a file as saved even if the disk was full, so a frame is checked before it gets its final name.
Layout: "OpenEXR File Layout", openexr.com; single-part scan-line files only, which is what Blender writes here.
"""

from __future__ import annotations

import struct
from pathlib import Path
from typing import BinaryIO

_MAGIC = b"\x76\x2f\x31\x01"
_LINES_PER_CHUNK = {0: 1, 1: 1, 2: 1, 3: 16}  # by compression code: none, RLE, ZIPS, ZIP


def is_whole(path: Path) -> bool:
    """Whether the file contains all of its pixel chunks, to the last byte. Chunks are not decompressed."""
    try:
        with open(path, "rb") as file:
            return _has_all_chunks(file, path.stat().st_size)
    except (OSError, struct.error, KeyError, UnicodeDecodeError):  # too short, or an invalid header
        return False


def _has_all_chunks(file: BinaryIO, size_bytes: int) -> bool:
    if file.read(4) != _MAGIC:
        return False
    file.read(4)  # version and flags
    header = read_header(file)
    _, y_min, _, y_max = struct.unpack("<4i", header["dataWindow"])
    lines = _LINES_PER_CHUNK[header["compression"][0]]
    chunks = -(-(y_max - y_min + 1) // lines)
    offsets = struct.unpack(f"<{chunks}Q", file.read(8 * chunks))
    if min(offsets) == 0:
        return False
    last = max(offsets)
    file.seek(last)
    _, packed_bytes = struct.unpack("<2i", file.read(8))
    return last + 8 + packed_bytes == size_bytes


def read_header(file: BinaryIO) -> dict[str, bytes]:
    """Attributes by name, starting after the first 8 bytes; each is stored as name, type, size and value."""
    header = {}
    while name := _read_word(file):
        _read_word(file)
        (size,) = struct.unpack("<i", file.read(4))
        header[name] = file.read(size)
    return header


def _read_word(file: BinaryIO) -> str:
    """Text up to a zero byte or the end of the file."""
    return b"".join(iter(lambda: file.read(1).rstrip(b"\0"), b"")).decode("ascii")
