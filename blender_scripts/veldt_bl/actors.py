"""Actors in Blender: one object per bone, positioned frame by frame."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import mathutils
import numpy as np

from veldt import assets
from veldt.flight.poses import Flight
from veldt.frusta import frusta_of
from veldt.groups.actors import Actor, poses
from veldt.sightings import may_be_in_frame
from veldt.world import World

from . import models
from .meshes import add_twin, new_mesh, new_object

_AT_ONCE = 64  # frames posed together: single frames are slow in NumPy, whole clips take gigabytes
_SLACK = 1.2  # of the size of bodies: allowance beyond their boxes, which are sampled in time
_PARK = mathutils.Matrix.Translation((0.0, 0.0, -1e5))  # m; several times the range of a camera


@dataclass(frozen=True)
class Puppet:
    """An actor and its objects, one for each bone that has a mesh: (index of the bone, object)."""

    actor: Actor
    bones: list[tuple[int, bpy.types.Object]]


class Troupe:
    """All puppets, and their poses in the frames of a clip.

    Actors that cannot be in the picture are kept far below, which avoids posing and synchronising them.
    """

    def __init__(self, puppets: list[Puppet]):
        self.puppets = puppets
        self._time_s = np.zeros(1)
        self.needed = np.ones((len(puppets), 1), bool)
        self._parked = [False] * len(puppets)
        self._first = -1
        self._matrices: dict[int, np.ndarray] = {}

    def rehearse(self, time_s: np.ndarray, needed: np.ndarray | None = None) -> None:
        """Set the times (n,) of frames 0, 1, …; needed (actors, n): frames in which each is posed, default all."""
        everybody = np.ones((len(self.puppets), len(time_s)), bool)
        self._time_s, self.needed, self._first = time_s, everybody if needed is None else needed, -1

    def pose(self, frame: int) -> None:
        """Move the actors needed in a frame to their positions, and the others out of sight."""
        first = frame - frame % _AT_ONCE
        if first != self._first:
            self._matrices, self._first = {}, first
        for k, puppet in enumerate(self.puppets):
            if self.needed[k, frame]:
                self._place(k, frame)
            elif not self._parked[k]:
                for _, shown in puppet.bones:
                    shown.matrix_basis = _PARK
            self._parked[k] = not self.needed[k, frame]

    def _place(self, k: int, frame: int) -> None:
        if k not in self._matrices:
            self._matrices[k] = _matrices(self.puppets[k], self._time_s[self._first : self._first + _AT_ONCE])
        matrices = self._matrices[k][frame - self._first].tolist()
        for (_, shown), matrix in zip(self.puppets[k].bones, matrices):
            shown.matrix_basis = mathutils.Matrix(matrix)


def add_actors(actors: list[Actor], materials: dict[tuple[str, str], bpy.types.Material]) -> Troupe:
    """Put all actors into the scene; those of one variant of a species share their meshes."""
    meshes: dict[tuple[str, str], list[bpy.types.Mesh | None]] = {}
    for actor in actors:
        kind = actor.species, actor.variant
        if kind not in meshes:
            meshes[kind] = _meshes(actor, materials)
            for mesh in filter(None, meshes[kind]):
                # If a mesh has a single user, Cycles synchronises it again whenever that user moves, and all other
                # meshes with it, including the ground. A second user, which no camera ray meets, prevents this.
                add_twin(mesh, actor.index)
    return Troupe([_puppet(actor, meshes[actor.species, actor.variant]) for actor in actors])


def needed(world: World, flight: Flight) -> np.ndarray:
    """Mask (actors, n) of the frames of a flight in which each actor may be in the picture."""
    frusta = frusta_of(world.passes_intrinsics, flight.camera_to_world)
    seen = [may_be_in_frame(frusta, flight.time_s, actor, _SLACK) for actor in world.actors]
    return np.array(seen, bool).reshape(len(world.actors), len(flight.time_s))


def _meshes(
    actor: Actor, materials: dict[tuple[str, str], bpy.types.Material]
) -> list[bpy.types.Mesh | None]:
    """The mesh of each bone of an actor's body, or None."""
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
