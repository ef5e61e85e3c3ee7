"""Actors in Blender: one object per bone, positioned frame by frame."""

from __future__ import annotations

import bpy
import mathutils

from planner.bake.baked import BakedScene, BakedTrack

from .meshes import add_twin, new_object

_PARK = mathutils.Matrix.Translation((0.0, 0.0, -1e5))  # m; several times the range of a camera


class ActorRigs:
    """The objects of all actors, and their poses in the frames of a track.

    Actors that cannot be in the picture are kept far below, which avoids posing and synchronising them.
    """

    def __init__(self, rigs: list[list[bpy.types.Object]]):
        self._rigs = rigs  # the objects of each actor, one per bone
        self._parked = [False] * len(rigs)

    def pose(self, track: BakedTrack, frame: int) -> None:
        """Move the actors that a frame may show to their positions, and the others out of sight."""
        for k, rig in enumerate(self._rigs):
            if track.posed[k, frame]:
                for shown, matrix in zip(rig, track.bones(k, frame).tolist()):
                    shown.matrix_basis = mathutils.Matrix([*matrix, (0.0, 0.0, 0.0, 1.0)])
            elif not self._parked[k]:
                for shown in rig:
                    shown.matrix_basis = _PARK
            self._parked[k] = not track.posed[k, frame]


def add_actors(scene: BakedScene, meshes: list[bpy.types.Mesh]) -> ActorRigs:
    """Put all actors of a baked scene into Blender's."""
    twins: set[int] = set()
    for actor in scene.header["actors"]:
        for bone in actor["bones"]:
            if bone["mesh"] not in twins:
                # If a mesh has a single user, Cycles synchronises it again whenever that user moves, and all other
                # meshes with it, including the ground. A second user, which no camera ray meets, prevents this.
                add_twin(meshes[bone["mesh"]], actor["object"])
                twins.add(bone["mesh"])
    return ActorRigs([_rig(actor, meshes) for actor in scene.header["actors"]])


def _rig(actor: dict, meshes: list[bpy.types.Mesh]) -> list[bpy.types.Object]:
    return [
        new_object(f"{actor['name']} {bone['name']}", meshes[bone["mesh"]], actor["object"])
        for bone in actor["bones"]
    ]
