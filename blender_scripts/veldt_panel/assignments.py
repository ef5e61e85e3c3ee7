# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that assign meanings to objects and collections."""

from __future__ import annotations

import bpy

from .catalogue import Thing, guess
from .properties import catalogue
from .stage import DRAWN, collections_around
from .targets import owner_of


class Assign(bpy.types.Operator):
    """Say what the selected objects are. What has a selected parent is part of that"""

    bl_idname = "veldt.assign"
    bl_label = "Assign to Selected"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether anything is selected."""
        return bool(context.selected_objects)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Assign."""
        brush = context.window_manager.veldt
        if (fault := _fault(context)) is not None:
            self.report({"ERROR"}, fault)
            return {"CANCELLED"}
        tops = [each for each in context.selected_objects if not _has_selected_parent(each)]
        for each in context.selected_objects:
            _clear(each)
        for each in tops:
            _set(each, _brushed(context))
            each.veldt.target = tops[0].name if brush.is_one and brush.kind == "actor" else ""
        return {"FINISHED"}


class AssignCollection(bpy.types.Operator):
    """Say what the active collection is: as an actor, all of it is one target, and each of its instances is one"""

    bl_idname = "veldt.assign_collection"
    bl_label = "Assign to Collection"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a collection is active, other than that of the scene."""
        return context.collection is not None and context.collection != context.scene.collection

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Assign."""
        if (fault := _fault(context)) is not None:
            self.report({"ERROR"}, fault)
            return {"CANCELLED"}
        _set(context.collection, _brushed(context))
        return {"FINISHED"}


class Clear(bpy.types.Operator):
    """Forget what the selected objects are"""

    bl_idname = "veldt.clear"
    bl_label = "Clear"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Clear."""
        for each in context.selected_objects:
            _clear(each)
        return {"FINISHED"}


class ClearCollection(bpy.types.Operator):
    """Forget what the active collection is"""

    bl_idname = "veldt.clear_collection"
    bl_label = "Clear Collection"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Clear."""
        if context.collection is not None and context.collection != context.scene.collection:
            _clear(context.collection)
        return {"FINISHED"}


class GuessNames(bpy.types.Operator):
    """Assign what is not assigned yet by the words of its name, as `veldt inspect` does"""

    bl_idname = "veldt.guess_names"
    bl_label = "Guess by Names"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Guess."""
        things = catalogue(context).things
        if not things:
            self.report({"ERROR"}, "veldt was not found yet; press Find Program first")
            return {"CANCELLED"}
        instanced = {each.instance_collection for each in context.scene.objects if each.instance_collection}
        holders = [*sorted(instanced, key=lambda each: each.name), *_parents_first(context.scene)]
        around = collections_around()
        guessed = 0
        for each in holders:
            if each.veldt.kind != "unset" or _is_in_actor(each, around):
                continue
            if (thing := guess(things, each.name)) is not None:
                _set(each, thing)
                guessed += 1
        self.report({"INFO"}, f"{guessed} assigned by name")
        return {"FINISHED"}


def unassigned(scene: bpy.types.Scene) -> list[str]:
    """Names of the objects with a shape that are background because they have no assignment, sorted."""
    around = collections_around()
    drawn = [each for each in scene.objects if each.type in DRAWN and not each.hide_render]
    return sorted(each.name for each in drawn if owner_of(each, lambda one: around.get(one.name, [])) is None)


def _is_in_actor(holder, around: dict) -> bool:
    """Whether an object is part of an actor already."""
    if not isinstance(holder, bpy.types.Object):
        return False
    owner = owner_of(holder, lambda one: around.get(one.name, []))
    return owner is not None and owner.veldt.kind == "actor"


def _parents_first(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    def depth(thing) -> int:
        return 0 if thing.parent is None else 1 + depth(thing.parent)

    named = [each for each in scene.objects if each.type in DRAWN | {"EMPTY", "ARMATURE"}]
    return sorted(named, key=lambda each: (depth(each), each.name))


def _fault(context: bpy.types.Context) -> str | None:
    """The fault of the brush; None if it is valid."""
    brush, known = context.window_manager.veldt, catalogue(context)
    if not known.materials:
        return "veldt was not found yet; press Find Program first"
    if brush.material not in known.materials:
        return f'material = "{brush.material}"; expected a file in assets/materials'
    if brush.kind == "actor" and not brush.category:
        return 'category = ""; expected one for an actor'
    return None


def _brushed(context: bpy.types.Context) -> Thing:
    """The assignment of the brush; with a species only while its category is unchanged."""
    brush = context.window_manager.veldt
    if brush.kind != "actor":
        return Thing(brush.kind, brush.material)
    known = catalogue(context).things.get(brush.thing)
    species = known.species if known is not None and known.category == brush.category else ""
    return Thing(brush.kind, brush.material, brush.category, species)


def _has_selected_parent(thing: bpy.types.Object) -> bool:
    above = thing.parent
    while above is not None and not above.select_get():
        above = above.parent
    return above is not None


def _set(holder, thing: Thing) -> None:
    said = holder.veldt
    said.kind, said.material, said.category = thing.kind, thing.material, thing.category
    said.species = thing.species


def _clear(holder) -> None:
    for name in ("kind", "material", "category", "species", "target"):
        holder.veldt.property_unset(name)


CLASSES = (Assign, AssignCollection, Clear, ClearCollection, GuessNames)
