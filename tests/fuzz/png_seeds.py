"""PNG files of 8 x 8 pixels, one for each kind of index picture; pass_manifests.h has their manifests."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np

from exr_seeds import PLAIN, object_index

GREY, COLOUR, PALETTE, GREY_ALPHA, COLOUR_ALPHA = 0, 2, 3, 4, 6  # W3C, PNG (Second Edition), table 11.1
COLOURS = {0: (0, 0, 0), 1: (90, 60, 30), 4: (0, 200, 0), 101: (250, 0, 7)}


def chunk(kind: bytes, data: bytes) -> bytes:
    """A part of a PNG file."""
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(pixels: np.ndarray, colour_type: int, extra: bytes = b"") -> bytes:
    """A picture (height, width) or (height, width, channels) of 8 or 16 bits, `extra` chunks before its pixels."""
    height, width = pixels.shape[:2]
    head = struct.pack(">IIBBBBB", width, height, 8 * pixels.itemsize, colour_type, 0, 0, 0)
    rows = b"".join(b"\0" + row.astype(row.dtype.newbyteorder(">")).tobytes() for row in pixels)
    chunks = (chunk(b"IHDR", head), extra, chunk(b"IDAT", zlib.compress(rows)), chunk(b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)


def pictures() -> dict[str, bytes]:
    """All kinds by name."""
    index = object_index().astype(np.uint8)
    colour = np.array([[COLOURS[int(i)] for i in row] for row in index], np.uint8)
    place = np.vectorize(list(COLOURS).index, otypes=[np.uint8])(index)
    opaque = np.full_like(index, 255)
    table = chunk(b"PLTE", bytes(sum(COLOURS.values(), ()))) + chunk(b"tRNS", bytes([255, 255, 255, 0]))
    return {
        "grey8": png(index, GREY),
        "grey16": png(index.astype(np.uint16), GREY),
        "grey_alpha": png(np.dstack([index, opaque]), GREY_ALPHA),
        "colour": png(colour, COLOUR),
        "colour16": png(colour.astype(np.uint16) * 257, COLOUR),
        "colour_alpha": png(np.dstack([colour, opaque]), COLOUR_ALPHA),
        "palette": png(place, PALETTE, table),
    }


def write_png_seeds(folder: Path) -> None:
    """Write all of them into an existing folder, each with the byte that chooses a manifest."""
    for name, content in pictures().items():
        (folder / f"{name}.png").write_bytes(content + bytes([PLAIN]))
