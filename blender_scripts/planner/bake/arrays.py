"""Flat arrays in a binary file, described by a JSON header beside it.

NAME.bin holds little-endian arrays, each at an offset that is a multiple of 64 bytes. NAME.json has their types, shapes
and offsets in `arrays`, the size of the binary file in `bytes`, and further keys of its writer.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np

_ALIGNMENT_BYTES = 64
TYPES = ("<f8", "<f4", "<u4", "<u2", "|u1")


class BadBake(Exception):
    """A plan's file that is damaged, or of another version: the file, the actual and the expected value."""


def write(path: Path, header: Mapping, arrays: Mapping[str, np.ndarray]) -> None:
    """Write `path`.bin and then `path`.json: `header` with the description of `arrays`, which have one of TYPES."""
    table, offset = {}, 0
    with open(path.with_suffix(".bin"), "wb") as file:
        for name, array in arrays.items():
            array = np.ascontiguousarray(array)
            kind = array.dtype.str
            assert kind in TYPES, f"{name}: {kind}"
            table[name] = {"type": kind, "shape": list(array.shape), "offset": offset}
            file.write(array.data if array.size else b"")
            offset += array.nbytes
            file.write(bytes(-offset % _ALIGNMENT_BYTES))
            offset += -offset % _ALIGNMENT_BYTES
    text = json.dumps({**header, "bytes": offset, "arrays": table}, indent=1, allow_nan=False)
    path.with_suffix(".json").write_text(text + "\n", encoding="utf-8")


def read(path: Path, form: str, version: int) -> tuple[dict, dict[str, np.ndarray]]:
    """The header and the arrays of `path`.json and `path`.bin, which are memory-mapped.

    BadBake unless they are complete, consistent, and of this format and version.
    """
    named = path.with_suffix(".json")
    header = read_header(named, form, version)
    binary = path.with_suffix(".bin")
    found = binary.stat().st_size
    if found != header["bytes"]:
        raise BadBake(f"{binary}: {found} bytes; expected {header['bytes']}")
    data = np.memmap(binary, np.uint8, "r") if found else np.zeros(0, np.uint8)
    return header, {name: _array(named, name, entry, data) for name, entry in header["arrays"].items()}


def read_header(path: Path, form: str, version: int) -> dict:
    """A JSON file of a plan. BadBake unless it is of this format and version."""
    try:
        header = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise BadBake(f"{path}: expected JSON ({error})") from error
    if not isinstance(header, dict) or header.get("format") != form:
        raise BadBake(f'{path}: format; expected "{form}"')
    if header.get("version") != version:
        raise BadBake(f"{path}: version = {header.get('version')}; expected {version}")
    return header


def check_finite(path: Path, name: str, array: np.ndarray) -> None:
    """BadBake if an array has a value that is NaN or infinite."""
    if not np.isfinite(array).all():
        raise BadBake(f"{path}: arrays.{name} has values that are not finite; expected numbers")


def _array(path: Path, name: str, entry: dict, data: np.ndarray) -> np.ndarray:
    where = f"{path}: arrays.{name}"
    if entry["type"] not in TYPES:
        raise BadBake(f'{where}.type = "{entry["type"]}"; expected one of {", ".join(TYPES)}')
    kind = np.dtype(entry["type"])
    shape, offset = entry["shape"], entry["offset"]
    size = math.prod(shape) * kind.itemsize
    if offset % _ALIGNMENT_BYTES or offset < 0 or min(shape, default=0) < 0 or offset + size > len(data):
        raise BadBake(
            f"{where}.offset = {offset} with {size} bytes; expected a multiple of {_ALIGNMENT_BYTES}"
            f" within the {len(data)} bytes of {path.with_suffix('.bin').name}"
        )
    return data[offset : offset + size].view(kind).reshape(shape)
