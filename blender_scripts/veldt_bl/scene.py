"""Build a baked scene in Blender once, and animate it clip by clip."""

from __future__ import annotations

import bpy
import numpy as np

from planner.bake.baked import BakedScene, BakedTrack

from . import actors, camera, plants
from .meshes import add_twin, new_material, new_mesh, new_object

_OUT_OF_SIGHT_M = -1e5  # several times the range of a camera


class Stage:
    """A baked scene, built in Blender's current scene."""

    def __init__(
        self,
        scene: BakedScene,
        place: list[bpy.types.Object],
        flora: plants.Flora,
        rigs: actors.ActorRigs,
        eye: bpy.types.Object,
    ):
        self.scene, self.place, self.flora, self.rigs, self.camera = scene, place, flora, rigs, eye
        self._track: BakedTrack | None = None
        self._circles = np.zeros((1, 2)), np.zeros(1)

    def animate(self, track: BakedTrack) -> None:
        """Select the track whose frames `pose` shows."""
        self._track = track
        intrinsics = self.scene.passes_of(track)
        camera.set_lens(self.camera, intrinsics)
        self._circles = plants.circles_needed(self.flora, self.scene, intrinsics, track.camera_to_world)

    def pose(self, frame: int) -> None:
        """Move the camera, and everything it may see, to their positions in a frame of the clip.

        Positions are set directly and not keyed: the keys of a long clip would fill memory and take longer than
        rendering.
        """
        camera.place(self.camera, self._track.camera_to_world[frame])
        centres_m, radii_m = self._circles
        plants.show_within(self.flora, centres_m[frame], radii_m[frame])
        self.rigs.pose(self._track, frame)

    def has_actors(self, frame: int) -> bool:
        """Whether actors may be in the picture."""
        return bool(self._track.posed[:, frame].any())

    def show_place(self, is_there: bool) -> None:
        """Move everything but the actors to its position, or out of sight, which is faster than hiding it."""
        height_m = 0.0 if is_there else _OUT_OF_SIGHT_M
        for thing in self.place:
            if thing.location.z != height_m:
                thing.location.z = height_m


def build_stage(scene: BakedScene) -> Stage:
    """Build a baked scene as objects of an empty one."""
    _empty_scene()
    materials = {
        entry["index"]: new_material(f"{entry['material']} {entry.get('part', '')}".strip(), entry["index"])
        for entry in scene.header["materials"]
    }
    meshes = [_add_mesh(scene, entry, materials) for entry in scene.header["meshes"]]
    place = [_add_surface(entry, meshes) for entry in scene.header["surfaces"]]
    flora = plants.add_flora(scene, meshes)
    rigs = actors.add_actors(scene, meshes)
    eye = camera.add_camera(scene.passes_intrinsics, scene.header["depth_range_m"])
    return Stage(scene, place + flora.places, flora, rigs, eye)


def _empty_scene() -> None:
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.context.scene.world = None


def _add_mesh(scene: BakedScene, entry: dict, materials: dict[int, bpy.types.Material]) -> bpy.types.Mesh:
    points_m, triangles, index = (
        scene.arrays[entry[key]] for key in ("points_m", "triangles", "material_index")
    )
    used, slot = np.unique(index, return_inverse=True)
    return new_mesh(
        entry["name"], points_m, triangles, slot, [materials[k] for k in used.tolist()], entry["smooth"]
    )


def _add_surface(entry: dict, meshes: list[bpy.types.Mesh]) -> bpy.types.Object:
    mesh = meshes[entry["mesh"]]
    # Cycles merges a mesh with a single user into the BVH that it rebuilds each frame, which for the ground takes
    # longer than rendering. A second user, far below where no camera ray hits it, keeps a separate BVH; also for
    # waters, for when everything but the actors is moved out of sight.
    add_twin(mesh, entry["object"])
    return new_object(mesh.name, mesh, entry["object"])
