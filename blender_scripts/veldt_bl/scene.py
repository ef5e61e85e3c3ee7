"""Builds a planned world in Blender, once, and sets it in motion clip by clip."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from veldt import ids
from veldt.land.covers import SOIL
from veldt.land.ground import build_ground
from veldt.geometry.shapes import Mesh, facets
from veldt.land.waters import Water
from veldt.world import WATER, World

from . import actors, camera, plants
from .meshes import add_twin, new_material, new_mesh, new_object

_SHEET_CORNERS = 64


@dataclass(frozen=True)
class Stage:
    """A world built in Blender's current scene."""

    world: World
    camera: bpy.types.Object
    troupe: actors.Troupe
    flora: plants.Flora

    def animate(self, clip: dict) -> None:
        """Replaces all motion by that of a clip, whose first frame is frame 0."""
        flight = self.world.flight(clip)
        for moving in (self.camera, self.flora.view):
            moving.animation_data_clear()
        for action in list(bpy.data.actions):
            bpy.data.actions.remove(action)
        camera.animate(self.camera, flight)
        plants.animate(self.flora, self.world, flight)
        self.troupe.rehearse(flight.time_s)
        self.pose(0)

    def pose(self, frame: int) -> None:
        """Puts the actors where they are in a frame of the clip; all else moves by itself when frames change."""
        self.troupe.pose(frame)


def build_stage(world: World) -> Stage:
    """The world as objects of an empty scene."""
    _empty_scene()
    materials = {
        (material, part): new_material(f"{material} {part}".strip(), index)
        for (material, part), index in world.material_indices.items()
    }
    _add_ground(world, materials)
    for water in world.terrain.waters:
        _add_water(water, materials[WATER, ""])
    flora = plants.add_flora(world, materials)
    troupe = actors.add_actors(world.actors, materials)
    return Stage(world, camera.add_camera(world.passes_intrinsics), troupe, flora)


def _empty_scene() -> None:
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.context.scene.world = None


def _add_ground(world: World, materials: dict) -> None:
    ground = build_ground(world.terrain, world.covers, SOIL)
    slots = [materials[material, ""] for material in ground.materials]
    mesh = new_mesh("ground", Mesh(ground.points_m, ground.triangles, ground.cover), slots)
    new_object("ground", mesh, ids.GROUND)
    # Cycles merges a mesh that only one object uses into the tree it rebuilds each frame, which for the ground takes
    # longer than the picture. A second user, deep down where no camera ray may meet it, keeps the ground's own tree.
    add_twin(mesh, ids.GROUND)


def _add_water(water: Water, material: bpy.types.Material) -> None:
    """A flat disc; its rim lies under the banks, so the shoreline is where the ground rises through it."""
    angle = 2.0 * np.pi * np.arange(_SHEET_CORNERS) / _SHEET_CORNERS
    rim = water.basin.centre_m + water.basin.disc_radius_m * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points = np.column_stack([rim, np.full(_SHEET_CORNERS, water.level_m)])
    fan = np.array([[0, k, k + 1] for k in range(1, _SHEET_CORNERS - 1)])
    new_object("water", new_mesh("water", facets(points, fan), [material]), ids.WATER)
