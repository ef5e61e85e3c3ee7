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
    if "shapes" in data:
        part = {name: slot for slot, name in enumerate(data["materials"])}
        return [joined([solid_of(shape).with_slot(part[shape["part"]]) for shape in data["shapes"]])]
    form = FORMS[data["form"]]
    return [_fitted(form(data, stream(seed, f"plant/{name}", k)), data) for k in range(data["variants"])]


def _fitted(mesh: Mesh, data: dict) -> Mesh:
    """The mesh scaled to be exactly height_m high and crown_diameter_m across at its widest, keeping z = 0."""
    points = mesh.points_m
    across_m = np.ptp(points[:, :2], axis=0).max()
    stretch = np.array([*[data["crown_diameter_m"] / across_m] * 2, data["height_m"] / points[:, 2].max()])
    return Mesh(points * stretch, mesh.triangles, mesh.slot)
