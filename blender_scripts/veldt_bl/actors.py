"""Actors in Blender: a rigid trunk, and limbs parented to it that turn in their joints."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from veldt import assets
from veldt.actors import Actor, track
from veldt.bodies import Body
from veldt.terrain import Terrain

from .meshes import new_mesh, new_object


@dataclass(frozen=True)
class Puppet:
    """An actor's objects: the trunk carries place and heading, the limbs their swing."""

    actor: Actor
    trunk: bpy.types.Object
    limbs: list[bpy.types.Object]


def add_actors(actors: list[Actor], materials: dict[tuple[str, str], bpy.types.Material]) -> list[Puppet]:
    """Puts all actors into the scene; those of one species share their meshes."""
    meshes = {}
    for actor in actors:
        if actor.species not in meshes:
            meshes[actor.species] = _species_meshes(actor.species, actor.body, materials)
    return [_puppet(actor, meshes[actor.species]) for actor in actors]


def animate(puppet: Puppet, terrain: Terrain, time_s: np.ndarray) -> None:
    """Keys the actor's pose on frames 0, 1, … for each of the times."""
    walk = track(puppet.actor, terrain, time_s)
    headings_rad = np.unwrap(walk.heading_rad)
    for frame in range(len(time_s)):
        puppet.trunk.location = walk.position_m[frame]
        puppet.trunk.rotation_euler.z = headings_rad[frame]
        puppet.trunk.keyframe_insert("location", frame=frame)
        puppet.trunk.keyframe_insert("rotation_euler", index=2, frame=frame)
        angles_rad = puppet.actor.body.limb_angles_rad(walk.strides[frame])
        for limb, angle_rad in zip(puppet.limbs, angles_rad):
            limb.rotation_euler.y = angle_rad
            limb.keyframe_insert("rotation_euler", index=1, frame=frame)


def _species_meshes(
    species: str, body: Body, materials: dict[tuple[str, str], bpy.types.Material]
) -> list[bpy.types.Mesh]:
    """Meshes of the trunk and of each limb."""
    material = assets.load("species", species)["material"]
    slots = [materials[material, part] for part in body.parts]
    return [new_mesh(species, mesh, slots) for mesh in (body.trunk, *(limb.mesh for limb in body.limbs))]


def _puppet(actor: Actor, meshes: list[bpy.types.Mesh]) -> Puppet:
    trunk = new_object(actor.name, meshes[0], actor.index)
    trunk.scale = (actor.scale,) * 3
    limbs = []
    for limb, mesh in zip(actor.body.limbs, meshes[1:]):
        part = new_object(f"{actor.name} limb", mesh, actor.index)
        part.parent = trunk
        part.location = limb.joint_m
        limbs.append(part)
    return Puppet(actor, trunk, limbs)
