"""Actors in Blender: one object a bone, put where it belongs frame by frame."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import mathutils
import numpy as np

from veldt import assets
from veldt.groups.actors import Actor, poses

from . import models
from .meshes import new_mesh, new_object

_AT_ONCE = 64  # frames posed together: one by one numpy is slow, all of a long clip take gigabytes


@dataclass(frozen=True)
class Puppet:
    """An actor and its objects, one for each bone that has a mesh: (place of the bone, object)."""

    actor: Actor
    bones: list[tuple[int, bpy.types.Object]]


class Troupe:
    """All puppets, and their poses in the frames of a clip.

    Objects are set outright and not keyed: keys of a long clip would fill the memory, and take longer than rendering.
    """

    def __init__(self, puppets: list[Puppet]):
        self.puppets = puppets
        self._time_s = np.zeros(1)
        self._first = -1
        self._matrices: list[np.ndarray] = []

    def rehearse(self, time_s: np.ndarray) -> None:
        """Frames 0, 1, … shall show the times (n,) from now on."""
        self._time_s, self._first = time_s, -1

    def pose(self, frame: int) -> None:
        """Puts all actors where they are in a frame; frames past the clip show its last."""
        frame = int(np.clip(frame, 0, len(self._time_s) - 1))
        first = frame - frame % _AT_ONCE
        if first != self._first:
            time_s = self._time_s[first : first + _AT_ONCE]
            self._matrices = [_matrices(puppet, time_s) for puppet in self.puppets]
            self._first = first
        for puppet, matrices in zip(self.puppets, self._matrices):
            for (_, shown), matrix in zip(puppet.bones, matrices[frame - first].tolist()):
                shown.matrix_basis = mathutils.Matrix(matrix)


def add_actors(actors: list[Actor], materials: dict[tuple[str, str], bpy.types.Material]) -> Troupe:
    """Puts all actors into the scene; those of one variant of a species share their meshes."""
    meshes: dict[tuple[str, str], list[bpy.types.Mesh | None]] = {}
    for actor in actors:
        kind = actor.species, actor.variant
        if kind not in meshes:
            meshes[kind] = _meshes(actor, materials)
    return Troupe([_puppet(actor, meshes[actor.species, actor.variant]) for actor in actors])


def _meshes(
    actor: Actor, materials: dict[tuple[str, str], bpy.types.Material]
) -> list[bpy.types.Mesh | None]:
    """The mesh of each bone of an actor's body; None of bones without."""
    data = assets.load("species", actor.species)
    slots = [materials[data["material"], part] for part in actor.body.parts]
    if "model" in data:
        mesh = models.load(f"assets/species/{actor.species}.json", data)
        return [new_mesh(f"{actor.species} model", mesh, slots, smooth=False)]
    return [
        new_mesh(f"{actor.species} {bone.name}", bone.mesh, slots) if len(bone.mesh.triangles) else None
        for bone in actor.body.bones
    ]


def _puppet(actor: Actor, meshes: list[bpy.types.Mesh | None]) -> Puppet:
    return Puppet(
        actor,
        [
            (k, new_object(f"{actor.name} {bone.name}", mesh, actor.index))
            for k, (bone, mesh) in enumerate(zip(actor.body.bones, meshes))
            if mesh is not None
        ],
    )


def _matrices(puppet: Puppet, time_s: np.ndarray) -> np.ndarray:
    """World matrices (n, bones with a mesh, 4, 4) of an actor's objects."""
    bones = [bone for bone, _ in puppet.bones]
    posed = poses(puppet.actor, time_s)
    matrices = np.zeros((len(time_s), len(bones), 4, 4))
    matrices[..., :3, :3] = posed.scale * posed.rotation[:, bones]
    matrices[..., :3, 3] = posed.position_m[:, bones]
    matrices[..., 3, 3] = 1.0
    return matrices
