"""Write EXR files byte by byte, so that they can contain what no library would write.

Source: Technical Introduction to OpenEXR, "OpenEXR File Layout".
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

MAGIC = 20000630
TILED, LONG_NAMES, DEEP, MULTI_PART = 0x200, 0x400, 0x800, 0x1000
_TYPES = {"uint32": 0, "float16": 1, "float32": 2}


@dataclass
class Header:
    """What the header of a file without compression says."""

    channels: dict[str, str]  # name to numpy's name of the type
    width: int
    height: int
    version: int = 2
    sampling: int = 1
    changed: dict[str, bytes] = field(default_factory=dict)  # attributes with other content
    dropped: tuple[str, ...] = ()
    more: tuple[tuple[str, str, bytes], ...] = ()  # name, type, content

    def encoded(self) -> bytes:
        """Its bytes, the file's first."""
        window = struct.pack("<4i", 0, 0, self.width - 1, self.height - 1)
        entries = [
            ("channels", "chlist", self._channel_list()),
            ("compression", "compression", b"\0"),
            ("dataWindow", "box2i", window),
            ("displayWindow", "box2i", window),
            ("lineOrder", "lineOrder", b"\0"),
            ("pixelAspectRatio", "float", struct.pack("<f", 1)),
            ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
            ("screenWindowWidth", "float", struct.pack("<f", 1)),
            *self.more,
        ]
        out = struct.pack("<ii", MAGIC, self.version)
        for name, kind, content in entries:
            if name not in self.dropped:
                content = self.changed.get(name, content)
                out += (
                    name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(content)) + content
                )
        return out + b"\0"

    def _channel_list(self) -> bytes:
        out = b""
        for name in sorted(self.channels):
            kind = _TYPES[self.channels[name]]
            out += name.encode() + b"\0" + struct.pack("<iB3xii", kind, 0, self.sampling, self.sampling)
        return out + b"\0"


def header_of(planes: dict[str, np.ndarray], **changes) -> Header:
    """The header of a file that holds these planes (height, width)."""
    height, width = next(iter(planes.values())).shape
    return Header({name: plane.dtype.name for name, plane in planes.items()}, width, height, **changes)


def exr_bytes(planes: dict[str, np.ndarray], **changes) -> bytes:
    """A whole file: `changes` are those of its header alone."""
    head = header_of(planes, **changes).encoded()
    rows = [
        b"".join(np.ascontiguousarray(planes[name][y]).tobytes() for name in sorted(planes))
        for y in range(next(iter(planes.values())).shape[0])
    ]
    begin = len(head) + 8 * len(rows)
    offsets, chunks = b"", b""
    for y, row in enumerate(rows):
        offsets += struct.pack("<q", begin + len(chunks))
        chunks += struct.pack("<ii", y, len(row)) + row
    return head + offsets + chunks


def write_exr(file: Path, planes: dict[str, np.ndarray]) -> None:
    """Write planes (height, width) as float channels; takes no library's time to start."""
    file.write_bytes(exr_bytes({name: plane.astype(np.float32) for name, plane in planes.items()}))
