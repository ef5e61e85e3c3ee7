"""Every bad input that was tried on `convert`, and what it gets: the one table of them. test_bad_inputs.py runs it and
keeps README.md the same."""

from __future__ import annotations

import json
import os
import struct
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import OpenImageIO

import mattes
import passes
from pictures import write_exr
from raw_exr import DEEP, MULTI_PART, TILED, exr_bytes, header_of
from raw_png import GREY, RGB, RGBA, png_bytes

FRAME = "000001.exr"
RUN = ("convert", "one", "--out", "out", "--quiet")

# What is made in spite of it.
NOTHING, NO_CLIP, OTHERS, ALL = "nothing", "no clip", "the other frames", "all frames"


@dataclass(frozen=True)
class BadInput:
    """One of them. `spoil` has a folder of good passes, three frames of clip one, to do its worst to."""

    group: str
    name: str
    spoil: Callable[[Path], None]
    code: int
    told: str  # standard error, without "veldt: " at the beginning of its lines
    made: str
    more: tuple[str, ...] = ()  # arguments


# --- frames -----------------------------------------------------------------------------------------------------------


def _frame(group: str, name: str, content, reason: str) -> BadInput:
    """A file instead of frame 1: its bytes, planes (height, width), or what makes it of its path."""

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
    _frame("file", "missing", lambda file: None, "there is no such file"),
    _frame("file", "empty", b"", "not an EXR file (its first bytes are others)"),
    _frame("file", "text", b"not an EXR file", "not an EXR file (its first bytes are others)"),
    _frame("file", "zeros", bytes(4096), "not an EXR file (its first bytes are others)"),
    _frame(
        "file",
        "a PNG named .exr",
        png_bytes(passes.object_index(1).astype(np.uint8)),
        "not an EXR file (its first bytes are others)",
    ),
    _frame("file", "a folder", lambda file: file.mkdir(), "it is a folder; expected a file"),
    _frame(
        "file", "a named pipe that nobody writes to", os.mkfifo, "it is a pipe or a device; expected a file"
    ),
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
    _frame("file", "a link to nowhere", lambda file: file.symlink_to("nowhere"), "there is no such file"),
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
        "part 0: dataWindow = -22 x -14 px; expected sides of 1 and more",
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
        "part 0: tiles = 0 x 0 px; expected sides of 1 and more",
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
        "part 0: comments = 2147483647 bytes; expected at most the 1803 that are left of the file",
    ),
    _frame(
        "EXR header",
        "attribute of negative length",
        exr_bytes(_objects(), more=(("comments", "string", b"x" * 10),)).replace(
            b"string\0\n\0\0\0", b"string\0\xff\xff\xff\xff"
        ),
        "part 0: comments = -1 bytes; expected at most the 1803 that are left of the file",
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
        "Scene.IndexOB.X: compression = B44; expected a lossless one (none, RLE, ZIPS, ZIP, PIZ or PXR24): others make other indices of these",
    ),
    _frame(
        "EXR channels",
        "index under DWAA",
        exr_bytes(_objects(), changed={"compression": b"\x08"}),
        "Scene.IndexOB.X: compression = DWAA; expected a lossless one (none, RLE, ZIPS, ZIP, PIZ or PXR24): others make other indices of these",
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
        "no object index channel; expected one like Scene.IndexOB.X, the file has: Scene.Depth.Z, Scene.Normal.X",
    ),
    _frame(
        "EXR channels",
        "object index in two layers",
        {f"{layer}.IndexOB.X": passes.object_index(1) for layer in "AB"},
        'IndexOB is in several layers: A, B; expected the manifest\'s "layer" to name one',
    ),
]


# --- pictures ---------------------------------------------------------------------------------------------------------


def _picture(name: str, content: bytes, reason: str, colours: bool = False) -> BadInput:
    """A PNG instead of frame 1 of a clip of PNGs: of indices, or of colours."""

    def spoil(folder: Path) -> None:
        document = passes.manifest()
        if colours:
            for place, told in enumerate(document["objects"]):
                told["colour"] = [place + 1, 0, 0]
        for frame, told in enumerate(document["frames"]):
            (folder / told["file"]).unlink()
            told["file"] = f"{frame:06d}.png"
            indices = passes.object_index(frame).astype(np.uint8)
            picture = png_bytes(_colours(frame), RGB) if colours else png_bytes(indices)
            (folder / told["file"]).write_bytes(picture)
        (folder / "000001.png").write_bytes(content)
        passes.write_manifest(folder, document)

    return BadInput("PNG", name, spoil, 3, f"clip one: frame 1 skipped: one/000001.png: {reason}", OTHERS)


def _colours(frame: int, change: int | None = None) -> np.ndarray:
    """A frame's objects as colours: (place in the manifest + 1, 0, 0); one pixel is (255, 0, `change`)."""
    index = passes.object_index(frame)
    picture = np.zeros((*index.shape, 3), np.uint8)
    for place, told in enumerate(passes.manifest()["objects"]):
        picture[index == told["index"], 0] = place + 1
    if change is not None:
        picture[2, 3] = (255, 0, change)
    return picture


_INDICES = passes.object_index(1).astype(np.uint8)
_ALPHA = np.concatenate([_colours(1), np.full((*_INDICES.shape, 1), 128, np.uint8)], axis=-1)

PICTURES = [
    _picture("empty", b"", "no PNG, or its head is damaged"),
    _picture("text", b"not a PNG", "no PNG, or its head is damaged"),
    _picture(
        "2^31 pixels in 100 bytes",
        png_bytes(_INDICES, size=(65536, 32768)),
        "size = 65536 x 32768 px; expected the manifest's 24 x 16 px",
    ),
    _picture(
        "another size", png_bytes(_INDICES[:12]), "size = 24 x 12 px; expected the manifest's 24 x 16 px"
    ),
    _picture(
        "index the manifest lacks",
        png_bytes(np.where(_INDICES == 4, 103, _INDICES).astype(np.uint8)),
        "object index at pixel (9, 7) = 103 (9 pixels); expected an index of the manifest's objects: 0, 1, 4, 101, 102",
    ),
    _picture(
        "colours, where the manifest has none",
        png_bytes(_colours(1), RGB),
        "a picture of colours; expected objects[].colour in the manifest, or a grey picture of indices",
    ),
    _picture(
        "unknown colour",
        png_bytes(_colours(1, 7), RGB),
        "colour at pixel (3, 2) = #ff0007 (255, 0, 7) (1 pixels); expected an object's or the sky's; did you mean #040000 (4, 0, 0)?",
        True,
    ),
    _picture(
        "colours of 16 bits",
        png_bytes(_colours(1).astype(np.uint16), RGB),
        "bits a channel = 16; expected 8 in a picture of colours",
        True,
    ),
    _picture(
        "half transparent colours",
        png_bytes(_ALPHA, RGBA),
        "alpha at pixel (0, 0) = 128; expected 0 (sky) or 255: a pixel is one object's",
        True,
    ),
    _picture(
        "grey, where the manifest has colours",
        png_bytes(_INDICES, GREY),
        "colour at pixel (0, 2) = #010101 (1, 1, 1) (303 pixels); expected an object's or the sky's; did you mean #010000 (1, 0, 0)?",
        True,
    ),
]


# --- cryptomattes -----------------------------------------------------------------------------------------------------

_MATTE = "ViewLayer.CryptoObject"
_NAMES = {told["index"]: told["name"] for told in passes.manifest()["objects"]}


def _write_matte(
    file: Path, names: np.ndarray, planes: dict | None = None, texts: dict | None = None, **how
) -> None:
    """A frame of names; some channels are others, or None for none, and so are texts of the metadata."""
    ranks = [(names, (names != "").astype(np.float32))]
    told = mattes.texts_of(tuple(_NAMES.values()), _MATTE)
    key = next(iter(told)).rsplit("/", 1)[0]
    told |= {f"{key}/{name}": text for name, text in (texts or {}).items()}
    channels = mattes.planes_of(ranks, _MATTE) | (planes or {})
    kept = {name: plane for name, plane in channels.items() if plane is not None}
    mattes.write_exr_with_texts(
        file, kept, {name: text for name, text in told.items() if text is not None}, **how
    )


def _names(frame: int) -> np.ndarray:
    index = passes.object_index(frame)
    return np.vectorize(lambda number: _NAMES.get(int(number), ""), otypes=[object])(index)


def _matte(name: str, reason: str, change: Callable[[np.ndarray], None] | None = None, **how) -> BadInput:
    """Frame 1 of a clip of cryptomattes, with other names in it or written in another way."""

    def spoil(folder: Path) -> None:
        for frame in range(passes.FRAMES):
            _write_matte(folder / f"{frame:06d}.exr", _names(frame))
        names = _names(1)
        if change is not None:
            change(names)
        _write_matte(folder / FRAME, names, **how)
        passes.write_manifest(folder, passes.manifest() | {"cryptomatte": "CryptoObject"})

    return BadInput(
        "cryptomatte", name, spoil, 3, f"clip one: frame 1 skipped: one/{FRAME}: {reason}", OTHERS
    )


def _put_stranger(names: np.ndarray) -> None:
    names[2, 3] = "stranger"


CRYPTOMATTES = [
    _matte(
        "none in the file",
        'cryptomatte = "CryptoObject"; expected a file with cryptomattes, this one has none',
        texts={"name": None, "hash": None, "conversion": None, "manifest": None},
    ),
    _matte(
        "name the manifest lacks",
        'ViewLayer.CryptoObject00.r at pixel (3, 2) = "dd9c161c" (1 pixels); expected the hash of a name among the manifest\'s objects: ground, shrub, walker, cow',
        _put_stranger,
    ),
    _matte(
        "metadata of another hash",
        'cryptomatte ViewLayer.CryptoObject: hash = "SHA256"; expected "MurmurHash3_32"',
        texts={"hash": "SHA256"},
    ),
    _matte(
        "metadata of another conversion",
        'cryptomatte ViewLayer.CryptoObject: conversion = "none"; expected "uint32_to_float32"',
        texts={"conversion": "none"},
    ),
    _matte(
        "metadata without its name",
        'cryptomatte = "CryptoObject"; expected one that the file has: 542cafa',
        texts={"name": None},
    ),
    _matte(
        "no channels",
        "cryptomatte ViewLayer.CryptoObject: no channels; expected ViewLayer.CryptoObject00.r, ViewLayer.CryptoObject00.g and so on",
        planes={f"{_MATTE}00.{letter}": None for letter in "rgba"} | {"A": FLAT},
    ),
    _matte(
        "a channel missing",
        "cryptomatte ViewLayer.CryptoObject: no channel ViewLayer.CryptoObject00.g; expected hash and coverage of every rank up to ViewLayer.CryptoObject00.a",
        planes={f"{_MATTE}00.g": None},
    ),
    _matte(
        "hashes under PXR24",
        "cryptomatte ViewLayer.CryptoObject: ViewLayer.CryptoObject00.r: compression = PXR24; expected one that keeps the bits of hashes: none, RLE, ZIPS, ZIP or PIZ",
        compression="pxr24",
    ),
    _matte(
        "coverage that is not a number",
        "ViewLayer.CryptoObject00.g at pixel (0, 0) = nan; expected a coverage from 0 to 1",
        planes={f"{_MATTE}00.g": np.full_like(FLAT, np.nan)},
    ),
    _matte(
        "negative coverage",
        "ViewLayer.CryptoObject00.g at pixel (0, 0) = -30; expected a coverage from 0 to 1",
        planes={f"{_MATTE}00.g": -FLAT},
    ),
]


# --- manifests --------------------------------------------------------------------------------------------------------


def _text(name: str, content: bytes, told: str, code: int = 1) -> BadInput:
    return BadInput(
        "manifest", name, lambda folder: (folder / "manifest.json").write_bytes(content), code, told, NOTHING
    )


def _manifest(
    name: str, change: Callable[[dict], object], told: str, code: int = 1, made: str = NOTHING
) -> BadInput:
    def spoil(folder: Path) -> None:
        document = passes.manifest()
        change(document)
        passes.write_manifest(folder, document)

    return BadInput("manifest", name, spoil, code, told, made)


def _instead(name: str, make: Callable[[Path], object], told: str, code: int = 1) -> BadInput:
    def spoil(folder: Path) -> None:
        (folder / "manifest.json").unlink()
        make(folder / "manifest.json")

    return BadInput("manifest", name, spoil, code, told, NOTHING)


_GOOD = json.dumps(passes.manifest())

MANIFESTS = [
    _instead(
        "missing",
        lambda file: None,
        'cannot read one/manifest.json: there is no such file; expected one that tells what the passes mean, such as "veldt inspect one --starter-manifest one/manifest.json" writes',
    ),
    _instead(
        "a folder",
        lambda file: file.mkdir(),
        "cannot read one/manifest.json: it is a folder; expected a file",
    ),
    _instead(
        "a named pipe that nobody writes to",
        os.mkfifo,
        "cannot read one/manifest.json: it is a pipe or a device; expected a file",
    ),
    _instead(
        "a link to itself",
        lambda file: file.symlink_to(file.name),
        "cannot read one/manifest.json: Too many levels of symbolic links",
    ),
    _instead(
        "a link to a device",
        lambda file: file.symlink_to("/dev/zero"),
        "cannot read one/manifest.json: it is a pipe or a device; expected a file",
    ),
    _text(
        "not UTF-8",
        _GOOD.replace("made_up", "\xff").encode("latin-1"),
        "one/manifest.json:1:67: not JSON: syntax error while parsing value - invalid string: ill-formed UTF-8 byte; last read: '\"\\xff'",
    ),
    _text(
        "empty",
        b"",
        "one/manifest.json:1:1: not JSON: syntax error while parsing value - unexpected end of input; expected '[', '{', or a literal",
    ),
    _text(
        "not JSON",
        b"clip: one",
        "one/manifest.json:1:1: not JSON: syntax error while parsing value - invalid literal; last read: 'c'",
    ),
    _text(
        "cut short",
        _GOOD[:100].encode(),
        "one/manifest.json:1:101: not JSON: syntax error while parsing object key - invalid string: missing closing quote; last read: '\"w'; expected string literal",
    ),
    _text("a list", b"[]", "one/manifest.json: document = a list of 0; expected an object"),
    _text(
        "100,000 brackets",
        b"[" * 100_000,
        "one/manifest.json: lists and objects more than 64 deep in each other; expected fewer",
    ),
    _text(
        "100,000 brackets, closed again",
        b"[" * 100_000 + b"]" * 100_000,
        "one/manifest.json: lists and objects more than 64 deep in each other; expected fewer",
    ),
    _text(
        "100,000 objects, one in the other",
        b'{"a":' * 100_000,
        "one/manifest.json: lists and objects more than 64 deep in each other; expected fewer",
    ),
    _text(
        "a key twice",
        _GOOD.replace('"seed"', '"clip": "two", "seed"').encode(),
        'one/manifest.json: key "clip" comes twice in one object; expected once',
    ),
    _text(
        "a number over all bounds",
        _GOOD.replace('"fx_px": 30', '"fx_px": 1e999').encode(),
        "one/manifest.json: not JSON: number overflow parsing '1e999'",
    ),
    _text(
        "NaN",
        _GOOD.replace('"fx_px": 30', '"fx_px": NaN').encode(),
        "one/manifest.json:1:141: not JSON: syntax error while parsing value - invalid literal; last read: '\"fx_px\": N'; expected a finite number: JSON has no NaN and no Infinity, though Python writes them",
    ),
    _manifest(
        "unknown key",
        lambda m: m.update(clips="one"),
        'one/manifest.json: clips is not a known key; expected one of format, version, clip, scene, seed, frame_rate_hz, layer, actor_layer, channels, cryptomatte, sky_colour, sequence, supersample, overscan_px, camera, objects, materials, frames; did you mean "clip"?',
    ),
    _manifest(
        "a text for a number",
        lambda m: m.update(seed="5"),
        'one/manifest.json: seed = "5"; expected a whole number',
    ),
    _manifest(
        "a number for a list",
        lambda m: m.update(objects=3),
        "one/manifest.json: objects = 3; expected a list",
    ),
    _manifest(
        "a seed over 2^32",
        lambda m: m.update(seed=2**40),
        "one/manifest.json: seed = 1099511627776; expected at least 0 and at most 4294967295",
    ),
    _manifest(
        "a camera of 10^10 pixels",
        lambda m: m["camera"].update(width_px=100000, height_px=100000),
        "clip one rejected: one: size of the passes = 100000 x 100000 px; expected at most 256000000 pixels (--max-megapixels)",
        made=NO_CLIP,
    ),
    _manifest(
        "a camera without pixels",
        lambda m: m["camera"].update(width_px=0),
        "one/manifest.json: camera.width_px = 0 px; expected at least 1 and at most 100000 px",
    ),
    _manifest(
        "a clip named ../x",
        lambda m: m.update(clip="../x"),
        'one/manifest.json: clip = "../x"; expected letters, digits, _ and - only',
    ),
    _manifest(
        "a clip named /tmp/x",
        lambda m: m.update(clip="/tmp/x"),
        'one/manifest.json: clip = "/tmp/x"; expected letters, digits, _ and - only',
    ),
    _manifest(
        "a frame in another folder",
        lambda m: m["frames"][1].update(file="../x.exr"),
        'one/manifest.json: frames[1].file = "../x.exr"; expected text like ^[^/\\\\]+$',
    ),
    _manifest(
        "a frame at a place of its own",
        lambda m: m["frames"][1].update(file="/etc/passwd"),
        'one/manifest.json: frames[1].file = "/etc/passwd"; expected text like ^[^/\\\\]+$',
    ),
    _manifest(
        "a frame named ..",
        lambda m: m["frames"][1].update(file=".."),
        "clip one: frame 1 skipped: one/..: it is a folder; expected a file",
        3,
        OTHERS,
    ),
    _manifest(
        "a frame with a name of 300 letters",
        lambda m: m["frames"][1].update(file="x" * 300),
        f"clip one: frame 1 skipped: one/{'x' * 300}: File name too long",
        3,
        OTHERS,
    ),
    _manifest(
        "no frames",
        lambda m: m.update(frames=[]),
        'one/manifest.json: frames and sequence are missing; expected one of them: a list of files, or a pattern of their names such as "f_####.exr"',
    ),
    _manifest(
        "frames and a sequence",
        lambda m: m.update(sequence="####.exr"),
        'one/manifest.json: sequence = "####.exr"; expected none beside frames, which lists the files',
    ),
    _manifest(
        "an index twice",
        lambda m: m["objects"][2].update(index=102),
        "one/manifest.json: objects[3].index = 102; expected each value once",
    ),
    _manifest(
        "an index past the last",
        lambda m: m["objects"][2].update(index=40000),
        "one/manifest.json: objects[2].index = 40000; expected at least 1 and at most 32767",
    ),
    _manifest(
        "an unknown material",
        lambda m: m["objects"][2].update(material="lava"),
        'one/manifest.json: objects[2].material = "lava"; expected one of acacia, baobab, crocodile, elephant, elephant_grass, giraffe, grass, hippopotamus, hookthorn, human, impala, lion, log, rhinoceros, road, rock, shrub, sky, soil, termite_mound, truck, water, wet_soil, zebra',
    ),
    _manifest(
        "an actor without category",
        lambda m: m["objects"][2].pop("category"),
        "one/manifest.json: objects[2].category is missing; expected one for every actor",
    ),
]


def _gap(folder: Path) -> None:
    document = passes.manifest() | {"sequence": "######.exr"}
    del document["frames"]
    (folder / "000002.exr").rename(folder / "1000000000.exr")
    passes.write_manifest(folder, document)


SEQUENCES = [
    BadInput(
        "sequence",
        "a gap of 10^9 frames",
        _gap,
        1,
        "one: 3 files have numbers from 0 to 1000000000 in steps of 1, so 999999998 are missing; expected at most 30 missing, or a manifest that lists the files in frames",
        NOTHING,
    ),
]


# --- configs ----------------------------------------------------------------------------------------------------------


def _config(name: str, content, told: str, option: str = "--config") -> BadInput:
    """A file of JSON, text or bytes, or what makes it of its path."""

    def spoil(folder: Path) -> None:
        file = folder.parent / "asked.json"
        if callable(content):
            content(file)
        else:
            file.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())

    return BadInput(option[2:], name, spoil, 2, told, NOTHING, (option, "asked.json"))


CONFIGS = [
    _config("missing", lambda file: None, "cannot read asked.json: No such file or directory"),
    _config("a folder", lambda file: file.mkdir(), "cannot read asked.json: Is a directory"),
    _config(
        "not JSON",
        b"seed = 5",
        "asked.json:1:1: not JSON: syntax error while parsing value - invalid literal; last read: 's'",
    ),
    _config(
        "100,000 brackets",
        b"[" * 100_000,
        "asked.json: lists and objects more than 64 deep in each other; expected fewer",
    ),
    _config(
        "not UTF-8",
        b'{"name": "\xff"}',
        "asked.json:1:11: not JSON: syntax error while parsing value - invalid string: ill-formed UTF-8 byte; last read: '\"\\xff'",
    ),
    _config("a list", [], "asked.json: document = a list of 0; expected an object"),
    _config(
        "a clip named ../x",
        {"name": "x", "clips": [{"id": "../x", "season": "winter", "frames": 3}]},
        'asked.json: clips[0].id = "../x"; expected letters, digits, _ and - only',
    ),
    _config(
        "not JSON",
        b"variants",
        "asked.json:1:1: not JSON: syntax error while parsing value - invalid literal; last read: 'v'",
        "--variants",
    ),
    _config(
        "a variant named ../x",
        {"variants": [{"name": "../x"}]},
        'asked.json: variants[0].name = "../x"; expected letters, digits, _ and - only',
        "--variants",
    ),
    _config(
        "a variant twice",
        {"variants": [{"name": "x"}, {"name": "x"}]},
        'asked.json: variants[1].name = "x"; expected each name once',
        "--variants",
    ),
]

BAD_INPUTS = [*FILES, *HEADERS, *CHANNELS, *PICTURES, *CRYPTOMATTES, *MANIFESTS, *SEQUENCES, *CONFIGS]
