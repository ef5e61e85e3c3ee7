"""Meshes of plants and other objects, by the form named in their file in `assets/plants`."""

from __future__ import annotations

import numpy as np

from .. import models
from ..geometry.shapes import Mesh, joined
from ..geometry.solids import solid_of
from ..noise import stream
from . import still_shapes, tree_shapes

FORMS = {
    "umbrella": tree_shapes.umbrella,
    "many_stemmed": tree_shapes.many_stemmed,
    "bush": tree_shapes.bush,
    "bottle": tree_shapes.bottle,
    "tussock": tree_shapes.tussock,
    "mound": still_shapes.mound,
    "rock": still_shapes.rock,
    "log": still_shapes.log,
}


_WAVES = np.array([1, 2, 3, 5, 8, 13])  # around an uneven outline
_WOODY = ("umbrella", "many_stemmed")  # forms with stems that have a slot of their own beside the leaves


def slots_of(data: dict) -> list[tuple[str, str]]:
    """(material, part) of a plant's or structure's meshes by slot: from its shapes or its model, or its material as a
    whole and, for trees in leaf, their wood.
    """
    if "shapes" in data:
        return [(slot, "") if isinstance(slot, str) else tuple(slot) for slot in data["materials"].values()]
    if "model" in data:
        return [(data["material"], part) for part in models.part_names(data)]
    return [(data["material"], part) for part in (("", "wood") if data["form"] in _WOODY else ("",))]


def build_variants(name: str, data: dict, seed: int) -> list[Mesh]:
    """Meshes of a plant's or structure's variants at its drawn size, standing at the origin, z up."""
    streams = [stream(seed, f"plant/{name}", k) for k in range(data.get("variants", 1))]
    if "shapes" in data:
        return [_built(data, k, rng) for k, rng in enumerate(streams)]
    form = FORMS[data["form"]]
    return [_fitted(form(data, rng), data) for rng in streams]


def _built(data: dict, k: int, rng: np.random.Generator) -> Mesh:
    """Those of the listed solids that variant k has, with its proportions and uneven outlines."""
    slot, count = {part: number for number, part in enumerate(data["materials"])}, data.get("variants", 1)
    shapes = [s for j, s in enumerate(data["shapes"]) if (k + j) % count < s.get("share", 1.0) * count]
    solids = [
        _ragged(solid_of(shape), shape.get("ragged", 0.0), rng).with_slot(slot[shape["part"]])
        for shape in shapes
    ]
    return joined(solids).scaled(1.0 + data.get("proportions", 0.0) * rng.uniform(-1.0, 1.0, 3))


def _ragged(mesh: Mesh, by: float, rng: np.random.Generator) -> Mesh:
    """The mesh with an outline, seen from above, that is uneven by about this share of its reach."""
    angle = np.arctan2(mesh.points_m[:, 1], mesh.points_m[:, 0])[:, None]
    phase_rad = rng.uniform(0.0, 2.0 * np.pi, len(_WAVES))
    out = 1.0 + by * (np.cos(angle * _WAVES + phase_rad) / np.sqrt(_WAVES)).sum(axis=1) / np.sqrt(2.0)
    return mesh.scaled(np.column_stack([out, out, np.ones(len(out))]))


def _fitted(mesh: Mesh, data: dict) -> Mesh:
    """The mesh scaled to be exactly height_m high and crown_diameter_m across at its widest, keeping z = 0."""
    points = mesh.points_m
    across_m = np.ptp(points[:, :2], axis=0).max()
    stretch = np.array([*[data["crown_diameter_m"] / across_m] * 2, data["height_m"] / points[:, 2].max()])
    return Mesh(points * stretch, mesh.triangles, mesh.slot)
