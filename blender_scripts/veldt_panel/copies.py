# SPDX-License-Identifier: GPL-3.0-or-later
"""Instances of actors as objects of their own, because Blender gives all instances of an object one index."""

from __future__ import annotations

import bpy

from .targets import copy_of

_WITHOUT_SHAPE = {"EMPTY", "CAMERA", "LIGHT", "LIGHT_PROBE", "SPEAKER", "LATTICE", "ARMATURE"}


class Copies:
    """The copies of one scene, made anew for each frame."""

    def __init__(self, scene: bpy.types.Scene) -> None:
        self._scene = scene
        self._objects: list[bpy.types.Object] = []
        self._meshes: list[bpy.types.Mesh] = []

    def clear(self) -> None:
        """Remove all copies."""
        for each in self._objects:
            bpy.data.objects.remove(each)
        for each in self._meshes:
            bpy.data.meshes.remove(each)
        self._objects, self._meshes = [], []

    def bake(self, depsgraph: bpy.types.Depsgraph, stage) -> None:
        """Replace instancers of actors by copies of their instances, for the targets of Stage.target().

        Copies of an earlier frame must be gone. Copies are what the viewport shows: with its levels of subdivision and
        its share of particles.
        """
        replaced = {
            each.parent.original.name
            for each in depsgraph.object_instances
            if _is_copy(each) and self._target(each, stage).is_actor
        }
        meshes: dict[tuple[str, int], bpy.types.Mesh | None] = {}
        made = []
        for each in depsgraph.object_instances:
            maker = each.parent.original if each.is_instance else each.object.original
            if maker.name not in replaced or not _is_rendered(each):
                continue
            source = each.object.original
            key = (source.name, each.object.data.as_pointer() if each.object.data else 0)
            if key not in meshes:
                meshes[key] = self._mesh(each.object, depsgraph)
            if meshes[key] is None:
                continue
            target = self._target(each, stage) if _is_copy(each) else stage.target(maker)
            root = maker.evaluated_get(depsgraph) if _is_whole(maker) else each
            made.append((meshes[key], each.matrix_world.copy(), target, root.matrix_world.copy()))
        for mesh, matrix, target, root in made:
            index = stage.indices.index_of(target)
            self._add(mesh, matrix, index)
            if target.is_actor:
                stage.actors.setdefault(index, root)
        for name in replaced:
            bpy.data.objects[name].hide_render = True

    @staticmethod
    def _target(instance: bpy.types.DepsgraphObjectInstance, stage):
        """The instancer's target, if that is an actor; otherwise a copy's."""
        maker = instance.parent.original
        own = stage.target(maker)
        if own.is_actor:
            return own
        shown = stage.target(instance.object.original)
        return copy_of(shown, maker.name, _number(instance)) if shown.is_actor else shown

    def _mesh(self, evaluated: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bpy.types.Mesh | None:
        """The shape of an evaluated object; None if it has none."""
        if evaluated.type in _WITHOUT_SHAPE:
            return None
        try:
            mesh = bpy.data.meshes.new_from_object(
                evaluated, preserve_all_data_layers=True, depsgraph=depsgraph
            )
        except RuntimeError:  # hair and volumes
            return None
        self._meshes.append(mesh)
        return mesh

    def _add(self, mesh: bpy.types.Mesh, matrix, index: int) -> None:
        copy = bpy.data.objects.new("Veldt copy", mesh)
        copy.matrix_world = matrix
        copy.pass_index = index
        self._scene.collection.objects.link(copy)
        self._objects.append(copy)


def _is_copy(instance: bpy.types.DepsgraphObjectInstance) -> bool:
    """Whether an instance shows another object, not geometry of its instancer."""
    return instance.is_instance and instance.object.original != instance.parent.original


def _is_whole(maker: bpy.types.Object) -> bool:
    """Whether an object instances exactly one collection, once."""
    return maker.instance_type == "COLLECTION"


def _is_rendered(instance: bpy.types.DepsgraphObjectInstance) -> bool:
    """Whether it is rendered by its settings, which the viewport's dependency graph ignores."""
    if not instance.is_instance:
        return instance.object.original.show_instancer_for_render
    return not instance.object.original.hide_render


def _number(instance: bpy.types.DepsgraphObjectInstance) -> tuple[int, ...]:
    """Key of a copy among those of one instancer, the same for all parts of a copy.

    Found in Blender 4.5 and 5.0: particles and vertices count copies in the first number, geometry nodes count parts
    there and copies in the others.
    """
    numbers = [each for each in instance.persistent_id if each != 0x7FFFFFFF]
    maker = instance.parent.original
    if _is_whole(maker):
        return ()
    if instance.particle_system is not None or maker.instance_type in ("VERTS", "FACES"):
        return (numbers[0],)
    return tuple(numbers[1:])
