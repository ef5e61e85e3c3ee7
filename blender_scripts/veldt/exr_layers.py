"""Add a layer to a frame's EXR file: the object index of actors alone.

Reads the uncompressed files that Blender writes here: one part, increasing y, channels of 32-bit floats.
Layout: "OpenEXR File Layout", openexr.com.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .exr_files import read_header

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


@dataclass(frozen=True)
class Layers:
    """A file's magic number, version and header, and its channels (lines, columns) by name."""

    beginning: bytes
    header: dict[str, bytes]
    channels: dict[str, np.ndarray]


def add_layer(frame: Path, channel: str, other: Path | None, of_other: str, to: Path) -> None:
    """Copy a frame to another file, adding the channel of a second frame, or a channel of 0 without one."""
    layers = read_layers(frame)
    channels = {name: plane for name, plane in layers.channels.items() if _LEFT_OUT not in name}
    added = read_layers(other).channels[of_other] if other else np.zeros_like(next(iter(channels.values())))
    write_layers(to, Layers(layers.beginning, layers.header, channels | {channel: added}))


def read_layers(path: Path) -> Layers:
    """A file of 32-bit floats without compression."""
    with open(path, "rb") as file:
        beginning = file.read(8)
        header = read_header(file)
        names = _channel_names(header["channels"])
        left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
        lines, columns = bottom - top + 1, right - left + 1
        file.seek(8 * lines, 1)  # where each line begins
        data = np.fromfile(file, _line(len(names), columns), lines)
    return Layers(beginning, header, {name: data["samples"][:, k] for k, name in enumerate(names)})


def write_layers(path: Path, layers: Layers) -> None:
    """The inverse of `read_layers`; optional attributes are left out."""
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
