"""Bones: rigid segments connected by joints, built from the lists of a species file.

A file draws all bones in one standing pose, in the axes of the whole body; each bone's mesh is stored relative to its
joint.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .. import models
from ..asset_checks import is_named
from ..geometry.shapes import Mesh, joined
from ..geometry.solids import solid_of

SIDES = {"left": 1.0, "right": -1.0}


@dataclass(frozen=True)
class Bone:
    """A segment: joint_m (3,) in body axes, its mesh relative to the joint, the index of its parent or -1.

    stretch: scale of this bone in its variant, relative to the drawing, about the joint, which was drawn at drawn_m;
    one number, or (3,) along x, y and z.
    """

    name: str
    parent: int
    joint_m: np.ndarray
    mesh: Mesh
    stretch: np.ndarray
    drawn_m: np.ndarray

    def placed(self, drawn_m) -> np.ndarray:
        """A point (3,) of this bone in body axes."""
        return self.joint_m + self.stretch * (np.asarray(drawn_m, float) - self.drawn_m)


def part_names(data: dict) -> tuple[str, ...]:
    """Names of a species' parts, of all variants, in the order in which its file first mentions them."""
    if "model" in data:
        return models.part_names(data)
    shapes = [shape for bone in data["bones"].values() for shape in bone["shapes"]]
    return tuple(
        dict.fromkeys(entry["part"] for shape in shapes for entry in [shape, *shape.get("patches", [])])
    )


def is_in(entry: Mapping, variant: str, posture: str) -> bool:
    """Whether this bone, shape or move exists in a variant and posture."""
    return "only" not in entry or is_named(variant, entry["only"]) or is_named(posture, entry["only"])


def has_own_shapes(data: dict, posture: str) -> bool:
    """Whether a posture has shapes of its own, such as a stool."""
    bones = data.get("bones", {}).values()
    return any(
        is_named(posture, entry.get("only", [])) for bone in bones for entry in [bone, *bone["shapes"]]
    )


def build_bones(data: dict, variant: str, posture: str) -> tuple[Bone, ...]:
    """A variant's bones, every parent before its children; a bone drawn once for both sides appears twice.

    A model from a file is a single bone, whose mesh here is its bounding box.
    """
    if "model" in data:
        return (
            Bone(
                "model", -1, np.zeros(3), models.box_mesh(data["model"]["size_m"]), np.ones(()), np.zeros(3)
            ),
        )
    parts, stretch = part_names(data), data["variants"][variant].get("stretch", {})
    bones: list[Bone] = []
    place: dict[str, int] = {}
    for name, entry in data["bones"].items():
        if not is_in(entry, variant, posture):
            continue
        drawn = joined([m for s in entry["shapes"] if is_in(s, variant, posture) for m in _solids(s, parts)])
        for side in SIDES if entry.get("mirror", False) else ("",):
            mesh, joint = _on_side(drawn, entry["joint_m"], side)
            parent, grown, at = _parent(entry, side, place), np.array(stretch.get(name, 1.0)), joint
            if parent >= 0:
                grown, at = grown * bones[parent].stretch, bones[parent].placed(joint)
            place[_sided(name, side)] = len(bones)
            bones.append(Bone(_sided(name, side), parent, at, mesh.moved(-joint).scaled(grown), grown, joint))
    return tuple(bones)


def _sided(name: str, side: str) -> str:
    return f"{name}.{side}" if side else name


def _parent(entry: dict, side: str, place: dict[str, int]) -> int:
    """The parent on the same side, or else the central one; -1 for the root."""
    if "parent" not in entry:
        return -1
    sided = _sided(entry["parent"], side)
    return place[sided if sided in place else entry["parent"]]


def _on_side(mesh: Mesh, joint_m, side: str) -> tuple[Mesh, np.ndarray]:
    """A bone's mesh and joint, mirrored for the right side."""
    joint = np.asarray(joint_m, float)
    return (mesh.mirrored(), joint * [1.0, -1.0, 1.0]) if side == "right" else (mesh, joint)


def _solids(shape: dict, parts: tuple[str, ...]) -> list[Mesh]:
    """A shape's mesh in its part's slot, and its mirror image if it has one."""
    mesh = solid_of(shape).with_slot(parts.index(shape["part"]))
    for patch in shape.get("patches", []):
        mesh = mesh.painted(patch["from_m"], patch["to_m"], parts.index(patch["part"]))
    return [mesh, mesh.mirrored()] if shape.get("mirror", False) else [mesh]
