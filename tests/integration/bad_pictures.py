"""Invalid PNGs of indices or colours, and invalid cryptomattes."""

# Messages are whole, however long.
# pylint: disable=line-too-long

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

import mattes
import passes
from bad_exr import FLAT
from bad_input import FRAME, OTHERS, BadInput
from raw_png import GREY, RGB, RGBA, png_bytes


def _picture(name: str, content: bytes, reason: str, colours: bool = False) -> BadInput:
    """A PNG instead of frame 1 of a clip of PNGs: of indices, or of colours."""

    def spoil(folder: Path) -> None:
        document = passes.manifest()
        if colours:
            for place, entry in enumerate(document["objects"]):
                entry["colour"] = [place + 1, 0, 0]
        for frame, entry in enumerate(document["frames"]):
            (folder / entry["file"]).unlink()
            entry["file"] = f"{frame:06d}.png"
            indices = passes.object_index(frame).astype(np.uint8)
            picture = png_bytes(_colours(frame), RGB) if colours else png_bytes(indices)
            (folder / entry["file"]).write_bytes(picture)
        (folder / "000001.png").write_bytes(content)
        passes.write_manifest(folder, document)

    return BadInput("PNG", name, spoil, 3, f"clip one: frame 1 skipped: one/000001.png: {reason}", OTHERS)


def _colours(frame: int, change: int | None = None) -> np.ndarray:
    """A frame's objects as colours: (place in the manifest + 1, 0, 0); one pixel is (255, 0, `change`)."""
    index = passes.object_index(frame)
    picture = np.zeros((*index.shape, 3), np.uint8)
    for place, entry in enumerate(passes.manifest()["objects"]):
        picture[index == entry["index"], 0] = place + 1
    if change is not None:
        picture[2, 3] = (255, 0, change)
    return picture


_INDICES = passes.object_index(1).astype(np.uint8)
_ALPHA = np.concatenate([_colours(1), np.full((*_INDICES.shape, 1), 128, np.uint8)], axis=-1)

PICTURES = [
    _picture("empty", b"", "not a PNG file, or its header is damaged"),
    _picture("text", b"not a PNG", "not a PNG file, or its header is damaged"),
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
        "bits per channel = 16; expected 8 in a picture of colours",
        True,
    ),
    _picture(
        "half transparent colours",
        png_bytes(_ALPHA, RGBA),
        "alpha at pixel (0, 0) = 128; expected 0 (sky) or 255, because a pixel belongs to one object",
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
_NAMES = {entry["index"]: entry["name"] for entry in passes.manifest()["objects"]}


def _write_matte(
    file: Path, names: np.ndarray, planes: dict | None = None, texts: dict | None = None, **how
) -> None:
    """A frame of names; `planes` and `texts` replace channels and metadata, or remove them if None."""
    ranks = [(names, (names != "").astype(np.float32))]
    metadata = mattes.texts_of(tuple(_NAMES.values()), _MATTE)
    key = next(iter(metadata)).rsplit("/", 1)[0]
    metadata |= {f"{key}/{name}": text for name, text in (texts or {}).items()}
    channels = mattes.planes_of(ranks, _MATTE) | (planes or {})
    kept = {name: plane for name, plane in channels.items() if plane is not None}
    mattes.write_exr_with_texts(
        file, kept, {name: text for name, text in metadata.items() if text is not None}, **how
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
        'cryptomatte = "CryptoObject"; expected a file with cryptomattes; this one has none',
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
