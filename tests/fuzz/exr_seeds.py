"""EXR files of 8 x 8 and 32 x 32 pixels, one a kind of file that we read; pass_manifests.h has their manifests."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import OpenImageIO

SIDE = 8
COMPRESSIONS = ("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab")
PLAIN, SCENE, ACTORS, CHANNELS, SUPERSAMPLED, OBJECTS, MATERIALS = range(7)  # places in small_manifests()
INDEX, MATERIAL, DEPTH, NORMAL = "IndexOB.X", "IndexMA.X", "Depth.Z", ("Normal.X", "Normal.Y", "Normal.Z")

Planes = dict[str, np.ndarray]
Change = Callable[[OpenImageIO.ImageSpec], None]


def object_index(scale: int = 1) -> np.ndarray:
    """A walker beside a shrub on the ground, below the sky, scaled up by an integer factor."""
    plane = np.ones((SIDE, SIDE), np.float32)
    plane[:2] = 0
    plane[3:7, 2:4] = 101
    plane[4:6, 5:8] = 4
    return plane.repeat(scale, 0).repeat(scale, 1)


def planes(prefix: str = "", scale: int = 1) -> Planes:
    """What Blender writes of a layer."""
    index = object_index(scale)
    depth = np.where(index == 0, 1e10, 40).astype(np.float32)
    normal = dict(zip(NORMAL, (0 * index, 0 * index, 1 + 0 * index)))
    return {
        prefix + name: plane
        for name, plane in ({INDEX: index, MATERIAL: 0 * index, DEPTH: depth} | normal).items()
    }


def spec_of(part: Planes, kind: str = "float", **attributes) -> OpenImageIO.ImageSpec:
    """The spec of a part for OpenImageIO; compression="none" and the like are attributes."""
    height, width = next(iter(part.values())).shape
    spec = OpenImageIO.ImageSpec(width, height, len(part), kind)
    spec.channelnames = tuple(part)
    spec.attribute("DateTime", "2026:01:01 00:00:00")  # or else it is now
    for name, value in attributes.items():
        spec.attribute(name, value)
    return spec


def write_parts(file: Path, parts: list[tuple[OpenImageIO.ImageSpec, Planes]], choice: int) -> None:
    """Write one part after another, then the byte that chooses a manifest."""
    out = OpenImageIO.ImageOutput.create(str(file))
    specs = [spec for spec, _ in parts]
    assert out.open(str(file), specs if len(specs) > 1 else specs[0]), out.geterror()
    for k, (spec, part) in enumerate(parts):
        assert k == 0 or out.open(str(file), spec, "AppendSubimage"), out.geterror()
        pixels = np.ascontiguousarray(np.stack(list(part.values()), axis=-1).astype(np.float32))
        assert out.write_image(pixels), out.geterror()
    out.close()
    with open(file, "ab") as end:
        end.write(bytes([choice]))


def write_one(
    file: Path, part: Planes, choice: int, change: Change = lambda spec: None, **attributes
) -> None:
    """Write a file of one part after changing its spec."""
    spec = spec_of(part, **attributes)
    change(spec)
    write_parts(file, [(spec, part)], choice)


def murmur3(text: str) -> int:
    """MurmurHash3_x86_32 with seed 0 (Austin Appleby, public domain), for names whose length is a multiple of 4."""
    value = 0
    for word in np.frombuffer(text.encode(), "<u4").tolist():
        word = word * 0xCC9E2D51 & 0xFFFFFFFF
        word = (word << 15 | word >> 17) * 0x1B873593 & 0xFFFFFFFF
        value ^= word
        value = ((value << 13 | value >> 19) & 0xFFFFFFFF) * 5 + 0xE6546B64 & 0xFFFFFFFF
    value ^= len(text)
    value = (value ^ value >> 16) * 0x85EBCA6B & 0xFFFFFFFF
    value = (value ^ value >> 13) * 0xC2B2AE35 & 0xFFFFFFFF
    return value ^ value >> 16


def cryptomatte(layer: str, names: dict[float, str]) -> tuple[Planes, dict[str, str]]:
    """Two ranks of a cryptomatte, the second the shrub at a quarter, and its attributes; names by object index."""
    hashes = {index: murmur3(name) for index, name in names.items()}
    ids = {index: np.array(value, np.uint32).view(np.float32) for index, value in hashes.items()}
    index, part = object_index(), {}
    second = np.full((SIDE, SIDE), ids[4], np.float32)
    part[f"{layer}00.R"] = np.vectorize(lambda i: ids.get(i, np.float32(0)), otypes=[np.float32])(index)
    part[f"{layer}00.G"] = np.where(index == 0, 0, np.where(index == 101, 0.75, 1)).astype(np.float32)
    part[f"{layer}00.B"] = np.where(index == 101, second, 0).astype(np.float32)
    part[f"{layer}00.A"] = np.where(index == 101, 0.25, 0).astype(np.float32)
    key = f"cryptomatte/{murmur3(layer.ljust(20)):08x}"[:19]
    table = json.dumps({names[index]: f"{value:08x}" for index, value in hashes.items()})
    about = {"name": layer, "hash": "MurmurHash3_32", "conversion": "uint32_to_float32", "manifest": table}
    return part, {f"{key}/{word}": value for word, value in about.items()}


def _tiled(spec: OpenImageIO.ImageSpec) -> None:
    spec.tile_width = spec.tile_height = 4


def _offset(spec: OpenImageIO.ImageSpec) -> None:
    """Its data window begins 3 to the right of and 2 above the display window."""
    spec.x, spec.y = 3, -2
    spec.full_x, spec.full_y, spec.full_width, spec.full_height = 0, 0, SIDE, SIDE


def _write_windows_and_types(folder: Path) -> None:
    write_one(folder / "tiled.exr", planes(), PLAIN, _tiled)
    write_one(folder / "offset.exr", planes(), PLAIN, _offset)
    write_one(folder / "half.exr", planes(), PLAIN, kind="half")
    write_one(folder / "uint.exr", {INDEX: object_index()}, PLAIN + 96, kind="uint")
    named = {"id": INDEX, "mat": MATERIAL, "far": DEPTH, "N.X": NORMAL[0], "N.Y": NORMAL[1], "N.Z": NORMAL[2]}
    part = {name: planes()[usual] for name, usual in named.items()}
    write_one(folder / "channels.exr", part, CHANNELS)


def _write_layers(folder: Path) -> None:
    scene, actors = planes("Scene."), {f"Actors.{INDEX}": object_index()}
    write_one(folder / "layer.exr", scene, SCENE)
    write_one(folder / "layers.exr", scene | actors, ACTORS)
    parts = [(spec_of(part, name=name), part) for name, part in (("Scene", scene), ("Actors", actors))]
    write_parts(folder / "parts.exr", parts, ACTORS)


def _write_cryptomattes(folder: Path) -> None:
    objects, about = cryptomatte("CryptoObject", {1: "ground__", 4: "shrub_01", 101: "walker__"})
    write_one(folder / "mattes.exr", objects | {"Depth.Z": planes()[DEPTH]}, OBJECTS + 32, **about)
    layer = "ViewLayer.CryptoMaterial"
    materials, about = cryptomatte(layer, {1: "ground__", 4: "shrub_02", 101: "walker__"})
    write_one(folder / "material_mattes.exr", materials, MATERIALS + 96, **about)


def write_exr_seeds(folder: Path) -> None:
    """Write all of them into an existing folder."""
    for compression in COMPRESSIONS:
        write_one(folder / f"{compression}.exr", planes(), PLAIN, compression=compression)
        write_one(folder / f"tiled_{compression}.exr", planes(), PLAIN, _tiled, compression=compression)
    for compression in (
        "piz",
        "pxr24",
        "b44",
        "b44a",
        "dwaa",
    ):  # of few or float pixels, these make nothing less
        half = {"kind": "half", "compression": compression}
        write_one(folder / f"large_{compression}.exr", planes(scale=4), SUPERSAMPLED, **half)
    _write_windows_and_types(folder)
    _write_layers(folder)
    _write_cryptomattes(folder)
