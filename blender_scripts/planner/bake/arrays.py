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


def read(path: Path) -> tuple[dict, dict[str, np.ndarray]]:
    """The header and the arrays of `path`.json and `path`.bin, which are memory-mapped. `veldt` has checked them."""
    header = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
    data = np.memmap(path.with_suffix(".bin"), np.uint8, "r") if header["bytes"] else np.zeros(0, np.uint8)
    return header, {name: _array(entry, data) for name, entry in header["arrays"].items()}


def _array(entry: dict, data: np.ndarray) -> np.ndarray:
    kind = np.dtype(entry["type"])
    end = entry["offset"] + math.prod(entry["shape"]) * kind.itemsize
    return data[entry["offset"] : end].view(kind).reshape(entry["shape"])
