# SPDX-License-Identifier: GPL-3.0-or-later
"""A temporary copy of the user's scene for rendering passes; the user's own scene is unchanged.

The copy has the same objects, and render settings, view layers, markers and a camera of its own. Two settings of
objects change while it exists, and are restored: the pass index, and the visibility of instancers of actors.
"""

from __future__ import annotations

import bpy
import mathutils

from . import copies
from .manifest import Intrinsics, Lens, intrinsics_of
from .passes import set_up
from .targets import Indices, Target, owner_of, target_of

DRAWN = {"MESH", "CURVE", "SURFACE", "META", "FONT", "CURVES", "VOLUME", "POINTCLOUD"}


class Stage:
    """A context manager; inside, `pose` prepares one frame after another."""

    def __init__(self, scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer, rest: str) -> None:
        """`rest` is the material of unassigned objects."""
        self._user, self._layer_name, self._rest = scene, view_layer.name, rest
        self.indices = Indices()
        self.actors: dict[int, mathutils.Matrix] = {}  # root of each actor in the current frame, by index
        self.scene: bpy.types.Scene | None = None
        self._camera: bpy.types.Object | None = None
        self._saved: list[tuple[bpy.types.Object, int, bool]] = []
        self._copies: copies.Copies | None = None
        self._around = collections_around()

    def __enter__(self) -> Stage:
        self._saved = [(each, each.pass_index, each.hide_render) for each in bpy.data.objects]
        try:
            self.scene = self._user.copy()
            self.scene.name = "Veldt passes"
            for layer in [each for each in self.scene.view_layers if each.name != self._layer_name]:
                self.scene.view_layers.remove(layer)
            self.scene.timeline_markers.clear()  # they may switch cameras
            self._copies = copies.Copies(self.scene)
            self._camera = bpy.data.objects.new("Veldt camera", bpy.data.cameras.new("Veldt camera"))
            self.scene.collection.objects.link(self._camera)
            self.scene.camera = self._camera
            set_up(self.scene)
            self._number_objects()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_) -> None:
        if self._copies is not None:
            self._copies.clear()
        if self._camera is not None:
            bpy.data.cameras.remove(self._camera.data)  # removes the object as well
        if self.scene is not None:
            bpy.data.scenes.remove(self.scene)
        for thing, index, is_hidden in self._saved:
            if thing.pass_index != index:
                thing.pass_index = index
            if thing.hide_render != is_hidden:
                thing.hide_render = is_hidden

    def target(self, thing: bpy.types.Object) -> Target:
        """The target that an object is part of."""
        return target_of(self.owner(thing), self._rest)

    def owner(self, thing: bpy.types.Object):
        """The object or collection whose assignment applies to an object; None if it has none."""
        return owner_of(thing, lambda each: self._around.get(each.name, []))

    def set_size(self, width_px: int, height_px: int, supersample: int) -> None:
        """Set the size of the picture."""
        render = self.scene.render
        render.resolution_x, render.resolution_y = supersample * width_px, supersample * height_px

    def pose(self, frame: int, camera: bpy.types.Object, fixed_focal_mm: float | None) -> None:
        """Move everything to a frame of the user's scene. `fixed_focal_mm` replaces the lens of the camera."""
        self._copies.clear()  # before anything is evaluated, which would still refer to them
        self.scene.frame_set(frame)
        depsgraph = self.scene.view_layers[0].depsgraph
        self._place_camera(camera.evaluated_get(depsgraph), fixed_focal_mm)
        self.actors = {}
        for thing in self.scene.view_layers[0].objects:
            if thing.type in DRAWN and (target := self.target(thing)).is_actor:
                root = self.owner(thing)
                root = root if isinstance(root, bpy.types.Object) else thing
                self.actors.setdefault(
                    self.indices.index_of(target), root.evaluated_get(depsgraph).matrix_world.copy()
                )
        self._copies.bake(depsgraph, self)
        self.scene.view_layers[0].update()

    def intrinsics(self, width_px: int, height_px: int) -> Intrinsics:
        """Those of the camera in the current frame."""
        lens = self._camera.data
        return intrinsics_of(
            Lens(
                lens.lens, lens.sensor_width, lens.sensor_height, lens.sensor_fit, lens.shift_x, lens.shift_y
            ),
            width_px,
            height_px,
        )

    @property
    def camera_matrix(self) -> mathutils.Matrix:
        """Matrix of the camera in the current frame, in Blender's units."""
        return self._camera.matrix_world

    def _place_camera(self, camera: bpy.types.Object, fixed_focal_mm: float | None) -> None:
        """Copy position and lens of a camera, but not its depth of field, which would blur indices."""
        if camera.data.type != "PERSP":
            raise ValueError(f"camera {camera.name} = {camera.data.type}; expected PERSP")
        data = self._camera.data
        for name in ("sensor_fit", "sensor_width", "sensor_height", "lens", "shift_x", "shift_y"):
            setattr(data, name, getattr(camera.data, name))
        for name in ("clip_start", "clip_end"):
            setattr(data, name, getattr(camera.data, name))
        if fixed_focal_mm is not None:
            data.sensor_fit, data.sensor_width, data.lens = "HORIZONTAL", 36.0, fixed_focal_mm
            data.shift_x = data.shift_y = 0
        self._camera.matrix_world = camera.matrix_world.normalized()  # Blender's cameras have no scale

    def _number_objects(self) -> None:
        """Assign object indices, in the order of the targets' names."""
        drawn = [each for each in bpy.data.objects if each.type in DRAWN]
        names = set(self.scene.view_layers[0].objects.keys())
        of = {each: self.target(each) for each in drawn}
        placed = {of[each] for each in drawn if each.name in names or not of[each].is_actor}
        for target in sorted(placed, key=lambda each: (each.is_actor, each.name, each.kind)):
            self.indices.index_of(target)
        for each, target in of.items():
            if target in placed:
                each.pass_index = self.indices.index_of(target)


def collections_around() -> dict[str, list[bpy.types.Collection]]:
    """The collections around each object, nearest first, but not the scene's own; those outside the scene too."""
    parents: dict[str, bpy.types.Collection] = {}
    for each in bpy.data.collections:
        for child in each.children:
            parents.setdefault(child.name, each)
    around: dict[str, list[bpy.types.Collection]] = {}
    for each in bpy.data.collections:
        line = [each]
        while (above := parents.get(line[-1].name)) is not None:
            line.append(above)
        for thing in each.objects:
            around.setdefault(thing.name, []).extend(line)
    return around
