"""Passes as other programs write them: a cryptomatte, pictures of numbers and of colours."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import OpenImageIO

SKY, GROUND, ELEPHANT = (0, 0, 0), (0, 255, 0), (255, 0, 0)
COLOURS = [[SKY, GROUND, GROUND], [GROUND, ELEPHANT, ELEPHANT]]

# Hashes are read from a file's manifest, so any that are valid floats will do.
HASHES = {"Ground": 0x3F000001, "Elephant.001": 0x3F000002, "thin wire": 0x3F000003}
MATTES = {"Ground": 3, "Elephant.001": 2, "thin wire": 0}  # pixels of which each fills most


def _write(file: Path, spec: OpenImageIO.ImageSpec, pixels: np.ndarray) -> None:
    out = OpenImageIO.ImageOutput.create(str(file))
    assert out.open(str(file), spec), out.geterror()
    assert out.write_image(pixels), out.geterror()
    out.close()


def write_png(file: Path, pixels: np.ndarray) -> None:
    """Write a grey picture (height, width) or one of three colours, of 8 or 16 bits."""
    height, width = pixels.shape[:2]
    planes = pixels.reshape(height, width, -1)
    kind = "uint16" if pixels.dtype == np.uint16 else "uint8"
    _write(file, OpenImageIO.ImageSpec(width, height, planes.shape[2], kind), np.ascontiguousarray(planes))


def write_colours(file: Path) -> None:
    """Write a picture of one pixel of sky, three of ground and two of an elephant."""
    write_png(file, np.array(COLOURS, np.uint8))


def write_cryptomatte(
    file: Path,
    names: dict[str, str] | None = None,
    more: dict[str, int] | None = None,
    planes: dict[str, np.ndarray] | None = None,
    fields: dict[str, str] | None = None,
) -> None:
    """Write two ranks: sky, ground and an elephant as in the colours; a wire fills a quarter of one pixel of ground.
    `names` changes what things are called; `more`, hashes by name, adds a column for each, with sky below;
    `planes` are further channels, and `fields` changes the metadata."""
    hashes = {(names or {}).get(name, name): number for name, number in HASHES.items()} | (more or {})
    ground, elephant, wire, *others = np.array(list(hashes.values()), np.uint32).view(np.float32)
    ranks = np.zeros((2, 3 + len(others), 4), np.float32)
    for y, x, value in ((0, 1, ground), (0, 2, ground), (1, 0, ground), (1, 1, elephant), (1, 2, elephant)):
        ranks[y, x, :2] = value, 1
    ranks[0, 1, 1:] = 0.75, wire, 0.25
    for k, value in enumerate(others):
        ranks[0, 3 + k, :2] = value, 1
    channels = {f"ViewLayer.CryptoObject00.{letter}": ranks[..., k] for k, letter in enumerate("rgba")} | (
        planes or {}
    )
    spec = OpenImageIO.ImageSpec(ranks.shape[1], 2, len(channels), "float")
    spec.channelnames = tuple(channels)
    texts = {
        "name": "ViewLayer.CryptoObject",
        "hash": "MurmurHash3_32",
        "conversion": "uint32_to_float32",
        "manifest": json.dumps({name: f"{number:08x}" for name, number in hashes.items()}),
    }
    for key, text in (texts | (fields or {})).items():
        spec.attribute(f"cryptomatte/1234567/{key}", text)
    _write(file, spec, np.stack(list(channels.values()), axis=-1).astype(np.float32))
