"""Models from the user's files, .glb, .obj or .blend: everything that can be determined without Blender.

A plan represents a model by its bounding box, standing on the ground; `veldt_bl.models` reads the shape itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from .faults import ConfigError, did_you_mean, listing
from .geometry.shapes import Mesh, facets
from .model_files import SUFFIXES, Unreadable, survey

# Rotation of a model, deg, that turns its forward axis to +x.
FORWARD = {"x": 0.0, "-x": 180.0, "y": -90.0, "-y": 90.0}
_MOST_M = 200.0  # of a side; the tallest tree is 116 m high
_CORNERS = np.array([[i, j, k] for i in (-0.5, 0.5) for j in (-0.5, 0.5) for k in (0.0, 1.0)])
_SIDES = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def part_names(data: Mapping) -> tuple[str, ...]:
    """Parts of a species or plant with a model, in the order its map first mentions them."""
    return tuple(dict.fromkeys(data["model"]["parts"].values()))


def box_mesh(size_m) -> Mesh:
    """A box of the given length, width and height on the ground, centred on the origin."""
    return facets(_CORNERS * np.asarray(size_m, float), np.concatenate([_SIDES[:, :3], _SIDES[:, [0, 2, 3]]]))


def in_body_axes(points_m: np.ndarray, model: Mapping) -> np.ndarray:
    """Points (n, 3) of a file as Blender imports it, z up, rotated to face +x and scaled, but not moved."""
    angle = np.radians(FORWARD[model["forward"]])
    cos, sin = np.round([np.cos(angle), np.sin(angle)])  # exact for quarter turns
    return model["scale"] * points_m @ np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])


def checked(where: str, folder: Path, entry, parts: Mapping) -> dict:
    """A `model` entry of the asset file `where` in `folder`, with defaults, the full `path` of its file and size_m.

    `parts` are those of its material. ConfigError names the key, or the file and its fault.
    """
    model = {"scale": 1.0, **entry}
    if Path(model["file"]).suffix.lower() not in SUFFIXES:
        raise ConfigError(
            f'{where}: model.file = "{model["file"]}"; expected a file ending in {", ".join(SUFFIXES)}'
        )
    _check_parts(where, model["parts"], parts)
    path = (folder / model["file"]).absolute()
    found = _survey(where, model["file"], path)
    for name in found.materials:
        check_mapped(f'{where}: model.file = "{model["file"]}"', name, model["parts"])
    if "size_m" not in model:
        if found.box_m is None:
            raise ConfigError(
                f"{where}: model.size_m is missing; expected [length, width, height], since only Blender can"
                f' measure "{model["file"]}"'
            )
        model["size_m"] = np.ptp(in_body_axes(found.box_m, model), axis=0).tolist()
    if max(model["size_m"]) > _MOST_M:
        size = " x ".join(f"{side:g}" for side in model["size_m"])
        raise ConfigError(
            f'{where}: model.file = "{model["file"]}", {size} m large; expected at most {_MOST_M:g} m each way, with'
            " model.scale in metres per unit of the file"
        )
    return model | {"path": str(path)}


def check_mapped(where: str, name: str, parts: Mapping) -> None:
    """Raise ConfigError if a material or object of a model's file is not in the map of parts."""
    if name not in parts:
        raise ConfigError(
            f'{where}: "{name}" has no part; expected it in model.parts, which has {listing(parts)}'
            f"{did_you_mean(name, parts)}"
        )


def _check_parts(where: str, parts: Mapping, known: Mapping) -> None:
    for name, part in parts.items():
        if part not in ["", *known]:
            raise ConfigError(
                f'{where}: model.parts["{name}"] = "{part}"; expected a part of its material: {listing(known)},'
                f' or "" for the material\'s own temperature{did_you_mean(part, known)}'
            )


def _survey(where: str, name: str, path: Path):
    try:
        return survey(path)
    except OSError as error:
        reason = error.strerror
    except Unreadable as error:
        reason = str(error)
    raise ConfigError(f'{where}: model.file = "{name}"; expected a readable {path.suffix} file ({reason})')
