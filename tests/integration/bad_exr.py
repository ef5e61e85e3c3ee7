"""Invalid EXR files, and EXR files that do not fit the clip."""

# Messages are whole, however long.
# pylint: disable=line-too-long

from __future__ import annotations

import os
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import OpenImageIO

import passes
from bad_input import FRAME, OTHERS, BadInput
from pictures import write_exr
from raw_exr import DEEP, MULTI_PART, TILED, exr_bytes, header_of
from raw_png import png_bytes


def _frame(group: str, name: str, content, reason: str) -> BadInput:
    """A replacement of frame 1: its bytes, planes (height, width), or a function that makes it at a path."""

    def spoil(folder: Path) -> None:
        file = folder / FRAME
        if isinstance(content, bytes):
            file.write_bytes(content)
        elif isinstance(content, dict):
            write_exr(file, content)
        else:
            file.unlink()
            content(file)

    return BadInput(group, name, spoil, 3, f"clip one: frame 1 skipped: one/{FRAME}: {reason}", OTHERS)


def _objects(value: float | None = None, kind: type = np.float32) -> dict[str, np.ndarray]:
    """The object index of frame 1; one pixel of it is `value`."""
    plane = passes.object_index(1).astype(kind)
    if value is not None:
        plane[2, 3] = value
    return {passes.OBJECTS: plane}


def _window(x_min: int, y_min: int, x_max: int, y_max: int) -> bytes:
    return struct.pack("<4i", x_min, y_min, x_max, y_max)


def _stored(compression: str, kind: str) -> Callable[[Path], None]:
    """The object index, stored in this way."""

    def write(file: Path) -> None:
        spec = OpenImageIO.ImageSpec(passes.WIDTH, passes.HEIGHT, 1, kind)
        spec.channelnames = (passes.OBJECTS,)
        spec.attribute("compression", compression)
        out = OpenImageIO.ImageOutput.create(str(file))
        assert out.open(str(file), spec) and out.write_image(passes.object_index(1)[..., None])
        out.close()

    return write


def _huge(width: int, height: int) -> bytes:
    """A header alone, of some 300 bytes, that claims this size."""
    return header_of(_objects(), changed={"dataWindow": _window(0, 0, width - 1, height - 1)}).encoded()


INDEX = "expected a whole number from 0 to 32767"
AT = f"{passes.OBJECTS} at pixel (3, 2)"
FLAT = np.full((passes.HEIGHT, passes.WIDTH), 30, np.float32)

FILES = [
    _frame("file", "missing", lambda file: None, "no such file"),
    _frame("file", "empty", b"", "not an EXR file (wrong first bytes)"),
    _frame("file", "text", b"not an EXR file", "not an EXR file (wrong first bytes)"),
    _frame("file", "zeros", bytes(4096), "not an EXR file (wrong first bytes)"),
    _frame(
        "file",
        "a PNG named .exr",
        png_bytes(passes.object_index(1).astype(np.uint8)),
        "not an EXR file (wrong first bytes)",
    ),
    _frame("file", "a folder", lambda file: file.mkdir(), "it is a folder; expected a file"),
    _frame("file", "a named pipe without a writer", os.mkfifo, "it is a pipe or a device; expected a file"),
    _frame(
        "file",
        "a link to a device",
        lambda file: file.symlink_to("/dev/zero"),
        "it is a pipe or a device; expected a file",
    ),
    _frame(
        "file",
        "a link to itself",
        lambda file: file.symlink_to(file.name),
        "Too many levels of symbolic links",
    ),
    _frame("file", "a link to nowhere", lambda file: file.symlink_to("nowhere"), "no such file"),
]

HEADERS = [
    _frame(
        "EXR header",
        "2^31 pixels in 300 bytes",
        _huge(65536, 32768),
        "part 0: dataWindow = 65536 x 32768 px, 2147.483648 megapixels; expected at most 256 (see --max-megapixels)",
    ),
    _frame(
        "EXR header",
        "2^31 columns",
        _huge(2147483647, 1),
        "part 0: dataWindow = 2147483647 x 1 px, 2147.483647 megapixels; expected at most 256 (see --max-megapixels)",
    ),
    _frame(
        "EXR header",
        "window inside out",
        exr_bytes(_objects(), changed={"dataWindow": _window(23, 15, 0, 0)}),
        "part 0: dataWindow = -22 x -14 px; expected sides of at least 1",
    ),
    _frame(
        "EXR header",
        "window from -2^31 to 2^31 - 1",
        exr_bytes(_objects(), changed={"dataWindow": _window(-(2**31), 0, 2**31 - 1, 15)}),
        "part 0: dataWindow = 4294967296 x 16 px, 68719.476736 megapixels; expected at most 256 (see --max-megapixels)",
    ),
    _frame(
        "EXR header",
        "no channels",
        exr_bytes(_objects(), changed={"channels": b"\0"}),
        'Cannot read image file "one/000001.exr". Missing or empty channel list in header',
    ),
    _frame(
        "EXR header",
        "no list of channels",
        exr_bytes(_objects(), dropped=("channels",)),
        'Cannot read image file "one/000001.exr". Missing or empty channel list in header',
    ),
    _frame(
        "EXR header",
        "no data window",
        exr_bytes(_objects(), dropped=("dataWindow",)),
        "part 0: no dataWindow; expected one",
    ),
    _frame(
        "EXR header",
        "unknown compression",
        exr_bytes(_objects(), changed={"compression": b"\x63"}),
        "compression = 99; expected 0 (none) to 9 (DWAB)",
    ),
    _frame("EXR header", "another version", exr_bytes(_objects(), version=9), "version = 9; expected 2"),
    _frame(
        "EXR header",
        "says it is tiled, and has no tiles",
        exr_bytes(_objects(), version=2 | TILED),
        "part 0: tiles = 0 x 0 px; expected sides of at least 1",
    ),
    _frame(
        "EXR header",
        "says it is deep",
        exr_bytes(_objects(), version=2 | DEEP),
        "holds deep data; expected flat pixels",
    ),
    _frame(
        "EXR header",
        "says it has parts",
        exr_bytes(_objects(), version=2 | MULTI_PART),
        "part 1: no dataWindow; expected one",
    ),
    _frame(
        "EXR header",
        "attribute longer than the file",
        exr_bytes(_objects(), more=(("comments", "string", b"x" * 10),)).replace(
            b"string\0\n\0\0\0", b"string\0\xff\xff\xff\x7f"
        ),
        "part 0: comments = 2147483647 bytes; expected at most the 1803 left in the file",
    ),
    _frame(
        "EXR header",
        "attribute of negative length",
        exr_bytes(_objects(), more=(("comments", "string", b"x" * 10),)).replace(
            b"string\0\n\0\0\0", b"string\0\xff\xff\xff\xff"
        ),
        "part 0: comments = -1 bytes; expected at most the 1803 left in the file",
    ),
    _frame(
        "EXR header",
        "another size",
        {passes.OBJECTS: passes.object_index(1)[:12]},
        "size = 24 x 12 px; expected the manifest's 24 x 16 px",
    ),
]

CHANNELS = [
    _frame(
        "EXR channels",
        "index that is not a number",
        _objects(np.nan),
        "Scene.IndexOB.X at pixel (3, 2) = nan; expected a whole number from 0 to 32767",
    ),
    _frame(
        "EXR channels",
        "infinite index",
        _objects(np.inf),
        "Scene.IndexOB.X at pixel (3, 2) = inf; expected a whole number from 0 to 32767",
    ),
    _frame(
        "EXR channels",
        "negative index",
        _objects(-1),
        "Scene.IndexOB.X at pixel (3, 2) = -1; expected a whole number from 0 to 32767",
    ),
    _frame(
        "EXR channels",
        "half an index",
        _objects(1.5),
        "Scene.IndexOB.X at pixel (3, 2) = 1.5; expected a whole number from 0 to 32767",
    ),
    _frame(
        "EXR channels",
        "index past the last",
        _objects(32768),
        "Scene.IndexOB.X at pixel (3, 2) = 32768; expected a whole number from 0 to 32767",
    ),
    _frame(
        "EXR channels",
        "index past the last, uint",
        exr_bytes(_objects(2**32 - 1, np.uint32)),
        "Scene.IndexOB.X at pixel (3, 2) = 4294967295; expected a whole number from 0 to 32767",
    ),
    _frame(
        "EXR channels",
        "index over 2048, half",
        exr_bytes(_objects(2050, np.float16)),
        "Scene.IndexOB.X at pixel (3, 2) = 2050; expected a whole number from 0 to 2048, up to which half floats are exact",
    ),
    _frame(
        "EXR channels",
        "index the manifest lacks",
        _objects(103),
        "object index at pixel (3, 2) = 103 (1 pixels); expected an index of the manifest's objects: 0, 1, 4, 101, 102",
    ),
    _frame(
        "EXR channels",
        "material index the manifest lacks",
        {**_objects(), "Scene.IndexMA.X": FLAT},
        "material index at pixel (0, 0) = 30 (384 pixels); expected an index of the manifest's materials: 0",
    ),
    _frame(
        "EXR channels",
        "index under B44",
        _stored("b44", "half"),
        "Scene.IndexOB.X: compression = B44; expected a lossless one (none, RLE, ZIPS, ZIP, PIZ or PXR24): others change indices",
    ),
    _frame(
        "EXR channels",
        "index under DWAA",
        exr_bytes(_objects(), changed={"compression": b"\x08"}),
        "Scene.IndexOB.X: compression = DWAA; expected a lossless one (none, RLE, ZIPS, ZIP, PIZ or PXR24): others change indices",
    ),
    _frame(
        "EXR channels",
        "index at every other pixel",
        exr_bytes(_objects(), sampling=2),
        "Scene.IndexOB.X: sampling = 2 x 2 px; expected 1 x 1 px, a number for every pixel",
    ),
    _frame(
        "EXR channels",
        "no object index",
        {"Scene.Depth.Z": FLAT, "Scene.Normal.X": FLAT},
        "no object index channel; expected one such as Scene.IndexOB.X; the file has: Scene.Depth.Z, Scene.Normal.X",
    ),
    _frame(
        "EXR channels",
        "object index in two layers",
        {f"{layer}.IndexOB.X": passes.object_index(1) for layer in "AB"},
        'IndexOB is in several layers: A, B; expected the manifest\'s "layer" to name one',
    ),
]
