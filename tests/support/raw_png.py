"""Write PNG files chunk by chunk, so that they can contain what no library would write.

Source: PNG specification (ISO/IEC 15948).
"""

from __future__ import annotations

import struct
import zlib

import numpy as np

GREY, RGB, RGBA = 0, 2, 6
_CHANNELS = {GREY: 1, RGB: 3, RGBA: 4}


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def png_bytes(pixels: np.ndarray, colours: int = GREY, size: tuple[int, int] | None = None) -> bytes:
    """A picture of unsigned bytes or words (height, width[, channels]); `size` is the header's (width, height)."""
    height, width = pixels.shape[:2]
    assert pixels.size == width * height * _CHANNELS[colours]
    wide, high = size or (width, height)
    head = struct.pack(">IIBBBBB", wide, high, 8 * pixels.dtype.itemsize, colours, 0, 0, 0)
    rows = pixels.astype(pixels.dtype.newbyteorder(">")).reshape(height, -1)
    data = b"".join(b"\0" + row.tobytes() for row in rows)
    body = _chunk(b"IHDR", head) + _chunk(b"IDAT", zlib.compress(data)) + _chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body
