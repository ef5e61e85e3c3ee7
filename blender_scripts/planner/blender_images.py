"""The image files that Blender writes: detect truncated ones, and add a layer of the actors alone to a frame.

Implemented here, because Python inside Blender may lack OpenImageIO, as the module bpy does, and a view layer of
Blender's own for the actors takes .1 s more of processor time a frame. Remove it when every Blender in use includes
OpenImageIO.

Blender reports a file as saved even if the disk was full, so a file is checked before it gets its final name. EXR files
have one part of scan lines, with increasing y; those that are joined have 32-bit floats without compression. Layouts:
"OpenEXR File Layout", openexr.com; PNG, ISO/IEC 15948.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

_EXR_MAGIC = b"\x76\x2f\x31\x01"
_LINES_PER_CHUNK = {0: 1, 1: 1, 2: 1, 3: 16}  # by compression code: none, RLE, ZIPS, ZIP
_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_PNG_END = b"\0\0\0\0IEND\xae\x42\x60\x82"
_KEPT = {  # required attributes and their types
    "dataWindow": "box2i",
    "displayWindow": "box2i",
    "lineOrder": "lineOrder",
    "pixelAspectRatio": "float",
    "screenWindowCenter": "v2f",
    "screenWindowWidth": "float",
}
_FLOAT = struct.pack("<4i", 2, 0, 1, 1)  # kind; linearity; distance of samples in x and y
_LEFT_OUT = ".Combined."  # the picture itself, which is black


def is_whole_png(path: Path) -> bool:
    """Whether the file begins and ends like a complete PNG file."""
    try:
        content = path.read_bytes()
    except OSError:
        return False
    return content.startswith(_PNG_SIGNATURE) and content.endswith(_PNG_END)


def is_whole_exr(path: Path) -> bool:
    """Whether the EXR file contains all of its pixel chunks, to the last byte. Chunks are not decompressed."""
    try:
        with open(path, "rb") as file:
            return _has_all_chunks(file, path.stat().st_size)
    except (OSError, struct.error, KeyError, UnicodeDecodeError):  # too short, or an invalid header
        return False


def _has_all_chunks(file: BinaryIO, size_bytes: int) -> bool:
    if file.read(4) != _EXR_MAGIC:
        return False
    file.read(4)  # version and flags
    header = _read_header(file)
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


def _read_header(file: BinaryIO) -> dict[str, bytes]:
    """Attributes by name; each is stored as name, type, size and value."""
    header = {}
    while name := _read_word(file):
        _read_word(file)
        (size,) = struct.unpack("<i", file.read(4))
        header[name] = file.read(size)
    return header


def _read_word(file: BinaryIO) -> str:
    """Text up to a zero byte or the end of the file."""
    return b"".join(iter(lambda: file.read(1).rstrip(b"\0"), b"")).decode("ascii")


@dataclass(frozen=True)
class _Layers:
    """A file's magic number, version and header, and its channels (lines, columns) by name."""

    beginning: bytes
    header: dict[str, bytes]
    channels: dict[str, np.ndarray]


def add_layer(frame: Path, channel: str, other: Path | None, of_other: str, to: Path) -> None:
    """Copy a frame to another file, adding the channel of a second frame, or a channel of 0 without one."""
    layers = _read_layers(frame)
    channels = {name: plane for name, plane in layers.channels.items() if _LEFT_OUT not in name}
    added = _read_layers(other).channels[of_other] if other else np.zeros_like(next(iter(channels.values())))
    _write_layers(to, _Layers(layers.beginning, layers.header, channels | {channel: added}))


def _read_layers(path: Path) -> _Layers:
    """A file of 32-bit floats without compression."""
    with open(path, "rb") as file:
        beginning = file.read(8)
        header = _read_header(file)
        names = _channel_names(header["channels"])
        left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
        lines, columns = bottom - top + 1, right - left + 1
        file.seek(8 * lines, 1)  # start of each line
        data = np.fromfile(file, _line(len(names), columns), lines)
    return _Layers(beginning, header, {name: data["samples"][:, k] for k, name in enumerate(names)})


def _write_layers(path: Path, layers: _Layers) -> None:
    """The inverse of `_read_layers`; optional attributes are left out."""
    names = sorted(layers.channels)
    lines, columns = layers.channels[names[0]].shape
    data = np.empty(lines, _line(len(names), columns))
    data["y"] = struct.unpack_from("<2i", layers.header["dataWindow"])[1] + np.arange(lines)
    data["bytes"] = 4 * len(names) * columns
    for k, name in enumerate(names):
        data["samples"][:, k] = layers.channels[name]
    head = layers.beginning + _header(names, layers.header)
    starts = len(head) + 8 * lines + data.itemsize * np.arange(lines, dtype="<u8")
    with open(path, "wb") as file:
        for part in (head, starts.tobytes(), data.tobytes()):
            file.write(part)


def _line(channels: int, columns: int) -> np.dtype:
    return np.dtype([("y", "<i4"), ("bytes", "<i4"), ("samples", "<f4", (channels, columns))])


def _channel_names(listed: bytes) -> list[str]:
    names = []
    while listed[0]:
        name, listed = listed.split(b"\0", 1)
        assert listed[:4] == _FLOAT[:4], f"{name!r} does not hold 32-bit floats"
        names.append(name.decode("ascii"))
        listed = listed[len(_FLOAT) :]
    return names


def _header(names: list[str], header: dict[str, bytes]) -> bytes:
    listed = b"".join(name.encode("ascii") + b"\0" + _FLOAT for name in names) + b"\0"
    kept = [(name, kind, header[name]) for name, kind in _KEPT.items()]
    attributes = [("channels", "chlist", listed), ("compression", "compression", b"\0"), *kept]
    packed = [
        f"{name}\0{kind}\0".encode("ascii") + struct.pack("<i", len(value)) + value
        for name, kind, value in attributes
    ]
    return b"".join(packed) + b"\0"
