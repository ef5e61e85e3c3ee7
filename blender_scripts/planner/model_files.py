"""Inspect .glb, .obj and .blend files without Blender."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .regular_files import read_regular

_MOST_BYTES = 1 << 30
_BLEND_STARTS = (b"BLENDER", b"\x28\xb5\x2f\xfd", b"\x1f\x8b")  # uncompressed, zstd, gzip
_LARGEST = {
    5120: 127.0,
    5121: 255.0,
    5122: 32767.0,
    5123: 65535.0,
}  # of normalized integers, by component type
_SHAPES = ("KHR_mesh_quantization", "KHR_draco_mesh_compression")
_LOOKS = ("KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_")
_INSTANCES = "EXT_mesh_gpu_instancing"
_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])  # y up to z up: (x, -z, y)


class Unreadable(Exception):
    """A file that does not match its name; the text gives the reason."""


@dataclass(frozen=True)
class Survey:
    """Names of the materials in use; box_m (2, 3), z up, in the file's unit, or None if only Blender can measure it."""

    materials: tuple[str, ...]
    box_m: np.ndarray | None


def survey(path: Path) -> Survey:
    """The content of a model's file. OSError or Unreadable if it cannot be read."""
    data = read_regular(path, _MOST_BYTES)
    if not data:
        raise Unreadable("it is empty")
    return SUFFIXES[path.suffix.lower()](data)


def _survey_blend(data: bytes) -> Survey:
    if not data.startswith(_BLEND_STARTS):
        raise Unreadable("it does not begin as a .blend file does")
    return Survey((), None)


def _survey_obj(data: bytes) -> Survey:
    points, materials, faces = [], {}, 0
    for line in data.decode("utf-8", "replace").splitlines():
        word, *rest = line.split(None, 1)[:2] or [""]
        if word == "v":
            points.append(_numbers("".join(rest)))
        elif word == "usemtl":
            materials["".join(rest).strip()] = 0
        elif word == "f":
            faces += 1
    if not faces or not points:
        raise Unreadable("it has no faces")
    return Survey(tuple(materials), _box(np.array(points) @ _UP))


def _box(points: np.ndarray) -> np.ndarray:
    low, high = points.min(axis=0), points.max(axis=0)
    if not ((high - low > 0) & np.isfinite(high - low)).all():
        raise Unreadable(f"it is {' x '.join(f'{side:g}' for side in high - low)} units large")
    return np.stack([low, high])


def _numbers(text: str) -> list[float]:
    try:
        x, y, z = (float(word) for word in text.split()[:3])
    except ValueError as error:
        raise Unreadable(f'"v {text}" is not a point') from error
    if not np.isfinite([x, y, z]).all():
        raise Unreadable(f'"v {text}" is not a point')
    return [x, y, z]


def _survey_glb(data: bytes) -> Survey:
    """Uses nodes, meshes, the bounds of their positions, names of materials and extensions.

    Refuses extensions that it requires and that may change shapes, unless Blender reads them.
    """
    gltf = _gltf(data)
    try:
        _check_extensions(gltf)
        used, boxes = _walk(gltf)
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
        raise Unreadable("its description of meshes is inconsistent") from error
    if not used:
        raise Unreadable("it has no mesh")
    names = [gltf["materials"][k].get("name", f"Material_{k}") for k in dict.fromkeys(used) if k is not None]
    if boxes is None or "skins" in gltf:
        return Survey(tuple(names), None)
    return Survey(tuple(names), _box(np.concatenate(boxes) @ _UP))


def _gltf(data: bytes) -> dict:
    """The JSON chunk of a .glb file (glTF 2.0, section 4.4)."""
    if data[:4] != b"glTF" or len(data) < 20:
        raise Unreadable("it does not begin as a .glb file does")
    version, length, size, kind = struct.unpack("<III4s", data[4:20])
    if version != 2:
        raise Unreadable(f"it is glTF {version}, not 2")
    if length > len(data):
        raise Unreadable(f"it is cut short: {len(data)} of {length} bytes")
    try:
        gltf = json.loads(data[20 : 20 + size]) if kind == b"JSON" else None
    except ValueError:
        gltf = None
    if not isinstance(gltf, dict):
        raise Unreadable("its first chunk is not JSON")
    return gltf


def _check_extensions(gltf: dict) -> None:
    for name in gltf.get("extensionsRequired", []):
        if name not in _SHAPES and not name.startswith(_LOOKS):
            raise Unreadable(f"it requires {name}, and of shapes only {' and '.join(_SHAPES)} are supported")
    if any(_INSTANCES in node.get("extensions", {}) for node in gltf.get("nodes", [])):
        raise Unreadable(f"it has instances of {_INSTANCES}, which are not supported")


def _walk(gltf: dict) -> tuple[list[int | None], list[np.ndarray] | None]:
    """Material indices of all primitives, and the corners (8, 3) of their boxes; None if one has no box."""
    nodes, used, boxes = gltf.get("nodes", []), [], []
    children = [child for node in nodes for child in node.get("children", [])]
    if len(set(children)) < len(children):
        raise ValueError("a node has two parents or is its own ancestor")
    waiting = [(k, np.eye(4)) for k in range(len(nodes)) if k not in children]
    while waiting:
        number, parent = waiting.pop()
        placed = parent @ _matrix(nodes[number])
        waiting += [(child, placed) for child in nodes[number].get("children", [])]
        if "mesh" in nodes[number]:
            for primitive in gltf["meshes"][nodes[number]["mesh"]]["primitives"]:
                used.append(primitive.get("material"))
                boxes.append(_corners(gltf["accessors"][primitive["attributes"]["POSITION"]], placed))
    return used, None if any(box is None for box in boxes) else boxes


def _corners(accessor: dict, placed: np.ndarray) -> np.ndarray | None:
    if "min" not in accessor or "max" not in accessor:
        return None
    sides = np.array([accessor["min"], accessor["max"]], float)
    if accessor.get("normalized", False):  # the bounds are not, unlike the positions
        sides = np.maximum(sides / _LARGEST[accessor["componentType"]], -1.0)
    corners = [[sides[i, 0], sides[j, 1], sides[k, 2], 1.0] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    return (np.array(corners) @ placed.T)[:, :3]


def _turn(quaternion: list) -> np.ndarray:
    """The rotation (3, 3) of a unit quaternion x, y, z, w."""
    x, y, z, w = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _matrix(node: dict) -> np.ndarray:
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    matrix = np.eye(4)
    matrix[:3, :3] = _turn(node.get("rotation", [0, 0, 0, 1])) * np.array(node.get("scale", [1, 1, 1]))
    matrix[:3, 3] = node.get("translation", [0, 0, 0])
    return matrix


SUFFIXES = {".glb": _survey_glb, ".obj": _survey_obj, ".blend": _survey_blend}
