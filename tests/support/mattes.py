"""Write cryptomattes, independently of the program: hashes, metadata and ranks as the specification has them."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import OpenImageIO

Rank = tuple[np.ndarray, np.ndarray]  # names (height, width), "" for nothing, and coverages


def _rotated(value: int, bits: int) -> int:
    return (value << bits | value >> (32 - bits)) & 0xFFFFFFFF


def _scrambled(block: bytes) -> int:
    value = int.from_bytes(block, "little") * 0xCC9E2D51 & 0xFFFFFFFF
    return _rotated(value, 15) * 0x1B873593 & 0xFFFFFFFF


def murmur_hash(name: str) -> int:
    """MurmurHash3_x86_32 of a name, seed 0 (A. Appleby, public domain)."""
    data = name.encode("utf-8")
    value, whole = 0, len(data) // 4 * 4
    for begin in range(0, whole, 4):
        value = (_rotated(value ^ _scrambled(data[begin : begin + 4]), 13) * 5 + 0xE6546B64) & 0xFFFFFFFF
    value ^= _scrambled(data[whole:]) ^ len(data)
    value = (value ^ value >> 16) * 0x85EBCA6B & 0xFFFFFFFF
    value = (value ^ value >> 13) * 0xC2B2AE35 & 0xFFFFFFFF
    return value ^ value >> 16


def hash_in_float(value: int) -> int:
    """The hash as pixels hold it: no float that is zero, denormal, infinite or NaN (specification, "ID Generation")."""
    return value ^ 1 << 23 if (value >> 23) & 0xFF in (0, 0xFF) else value


def matte_hash(name: str) -> int:
    """The number that stands for a name in pixels."""
    return hash_in_float(murmur_hash(name))


def _plane(names: np.ndarray) -> np.ndarray:
    """Hashes of names as floats."""
    plane = np.zeros(names.shape, np.uint32)
    for name in set(names.ravel()) - {""}:
        plane[names == name] = matte_hash(name)
    return plane.view(np.float32)


def planes_of(ranks: Sequence[Rank], matte: str = "ViewLayer.CryptoObject") -> dict[str, np.ndarray]:
    """Channels of a cryptomatte, two ranks a layer."""
    empty = (np.full_like(ranks[0][0], ""), np.zeros_like(ranks[0][1]))
    ranks = [*ranks, empty] if len(ranks) % 2 else ranks
    planes = {}
    for k, (names, coverage) in enumerate(ranks):
        hash_of, cover = ("r", "g") if k % 2 == 0 else ("b", "a")
        planes[f"{matte}{k // 2:02}.{hash_of}"] = _plane(names)
        planes[f"{matte}{k // 2:02}.{cover}"] = coverage.astype(np.float32)
    return planes


def texts_of(names: Sequence[str] | None, matte: str = "ViewLayer.CryptoObject") -> dict[str, str]:
    """Metadata of a cryptomatte; None: without a manifest."""
    key = f"cryptomatte/{matte_hash(matte):08x}"[:-1]
    texts = {"name": matte, "hash": "MurmurHash3_32", "conversion": "uint32_to_float32"}
    if names is not None:
        inside = ",".join(f'"{name}":"{murmur_hash(name):08x}"' for name in names)
        texts["manifest"] = f"{{{inside}}}"
    return {f"{key}/{field}": text for field, text in texts.items()}


def write_exr_with_texts(
    file: Path, planes: Mapping[str, np.ndarray], texts: Mapping[str, str], compression: str = "zip"
) -> None:
    """Write planes (height, width) as float channels, bit by bit, with attributes of text."""
    height, width = next(iter(planes.values())).shape
    spec = OpenImageIO.ImageSpec(width, height, len(planes), "float")
    spec.channelnames = tuple(planes)
    spec.attribute("compression", compression)
    for name, text in texts.items():
        spec.attribute(name, text)
    out = OpenImageIO.ImageOutput.create(str(file))
    assert out.open(str(file), spec), out.geterror()
    assert out.write_image(np.stack(list(planes.values()), axis=-1).astype(np.float32)), out.geterror()
    out.close()


def float_bits(value: float) -> int:
    """The bits of a single-precision number."""
    return struct.unpack("<I", struct.pack("<f", value))[0]
