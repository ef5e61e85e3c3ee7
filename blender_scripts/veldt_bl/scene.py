"""Build a planned world in Blender once, and animate it clip by clip."""

from __future__ import annotations

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
_OUT_OF_SIGHT_M = -1e5  # several times the range of a camera


class Stage:
    """A world built in Blender's current scene."""

    def __init__(
        self,
        world: World,
        place: list[bpy.types.Object],
        flora: plants.Flora,
        troupe: actors.Troupe,
        eye: bpy.types.Object,
    ):
        self.world, self.place, self.flora, self.troupe, self.camera = world, place, flora, troupe, eye
        self._camera_to_world = np.eye(4)[None]
        self._circles = np.zeros((1, 2)), np.zeros(1)

    def animate(self, clip: dict) -> None:
        """Select the clip whose frames, counted from 0, `pose` shows."""
        flight = self.world.flight(clip)
        self._camera_to_world = flight.camera_to_world
        self._circles = plants.circles_needed(self.flora, self.world, flight.camera_to_world)
        self.troupe.rehearse(flight.time_s, actors.needed(self.world, flight))

    def pose(self, frame: int) -> None:
        """Move the camera, and everything it may see, to their positions in a frame of the clip.

        Positions are set directly and not keyed: the keys of a long clip would fill memory and take longer than
        rendering.
        """
        camera.place(self.camera, self._camera_to_world[frame])
        centres_m, radii_m = self._circles
        plants.show_within(self.flora, centres_m[frame], radii_m[frame])
        self.troupe.pose(frame)

    def has_actors(self, frame: int) -> bool:
        """Whether actors may be in the picture."""
        return bool(self.troupe.needed[:, frame].any())

    def show_place(self, is_there: bool) -> None:
        """Move everything but the actors to its position, or out of sight, which is faster than hiding it."""
        height_m = 0.0 if is_there else _OUT_OF_SIGHT_M
        for thing in self.place:
            if thing.location.z != height_m:
                thing.location.z = height_m


def build_stage(world: World) -> Stage:
    """Build the world as objects of an empty scene."""
    _empty_scene()
    materials = {
        (material, part): new_material(f"{material} {part}".strip(), index)
        for (material, part), index in world.material_indices.items()
    }
    place = [_add_ground(world, materials)]
    place += [_add_water(water, materials[WATER, ""]) for water in world.terrain.waters]
    flora = plants.add_flora(world, materials)
    troupe = actors.add_actors(world.actors, materials)
    return Stage(world, place + flora.places, flora, troupe, camera.add_camera(world.passes_intrinsics))


def _empty_scene() -> None:
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.context.scene.world = None


def _add_ground(world: World, materials: dict) -> bpy.types.Object:
    ground = build_ground(world.terrain, world.covers, SOIL)
    slots = [materials[material, ""] for material in ground.materials]
    mesh = new_mesh("ground", Mesh(ground.points_m, ground.triangles, ground.cover), slots)
    ground = new_object("ground", mesh, ids.GROUND)
    # Cycles merges a mesh with a single user into the BVH that it rebuilds each frame, which for the ground takes
    # longer than rendering. A second user, far below where no camera ray meets it, keeps a separate BVH.
    add_twin(mesh, ids.GROUND)
    return ground


def _add_water(water: Water, material: bpy.types.Material) -> bpy.types.Object:
    """Add a flat disc; its rim lies below the banks, so the shoreline is where the ground rises through it."""
    angle = 2.0 * np.pi * np.arange(_SHEET_CORNERS) / _SHEET_CORNERS
    rim = water.basin.centre_m + water.basin.disc_radius_m * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points = np.column_stack([rim, np.full(_SHEET_CORNERS, water.level_m)])
    fan = np.array([[0, k, k + 1] for k in range(1, _SHEET_CORNERS - 1)])
    mesh = new_mesh("water", facets(points, fan), [material])
    add_twin(mesh, ids.WATER)  # the same as the ground's, for when the place is moved out of sight
    return new_object("water", mesh, ids.WATER)
