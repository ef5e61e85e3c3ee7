# SPDX-License-Identifier: GPL-3.0-or-later
"""The tab Veldt in the sidebar of the 3D view."""

from __future__ import annotations

import bpy

from .assignments import unassigned
from .properties import preferences

_MOST_NAMES = 5


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Veldt"


class ProgramPanel(_Panel, bpy.types.Panel):
    """Which program does the work."""

    bl_idname = "VELDT_PT_program"
    bl_label = "1. Program"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw it."""
        said = preferences(context)
        if said.home:
            self.layout.label(text=f"veldt {said.version}", icon="CHECKMARK")
        else:
            self.layout.label(text="veldt was not found yet", icon="ERROR")
            self.layout.prop(said, "program")
        self.layout.operator("veldt.find_program")


class ObjectsPanel(_Panel, bpy.types.Panel):
    """What the objects are."""

    bl_idname = "VELDT_PT_objects"
    bl_label = "2. Objects"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw it."""
        layout, brush = self.layout, context.window_manager.veldt
        _draw_active(layout, context.object)
        for name in ("thing", "kind", "material"):
            layout.prop(brush, name)
        if brush.kind == "actor":
            layout.prop(brush, "category")
            layout.prop(brush, "is_one")
        row = layout.row(align=True)
        row.operator("veldt.assign")
        row.operator("veldt.clear")
        row = layout.row(align=True)
        row.operator("veldt.assign_collection")
        row.operator("veldt.clear_collection", text="Clear")
        layout.operator("veldt.guess_names")
        layout.prop(context.scene.veldt, "rest")
        _draw_unassigned(layout, context.scene)


class SettingsPanel(_Panel, bpy.types.Panel):
    """What is made."""

    bl_idname = "VELDT_PT_settings"
    bl_label = "3. Camera and Output"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw it."""
        layout, said = self.layout, context.scene.veldt
        for name in ("out", "clip", "preset", "lens", "supersample", "season", "time", "own_range"):
            layout.prop(said, name)
        if said.own_range:
            row = layout.row(align=True)
            row.prop(said, "frame_start")
            row.prop(said, "frame_end")
        if abs(context.scene.unit_settings.scale_length - 1) > 1e-6:
            layout.label(text="Unit scale is not 1: no depth", icon="INFO")


class MakePanel(_Panel, bpy.types.Panel):
    """Buttons, and how far they are."""

    bl_idname = "VELDT_PT_make"
    bl_label = "4. Make"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw it."""
        layout, said, running = self.layout, context.scene.veldt, context.window_manager.veldt
        layout.operator("veldt.make_dataset", icon="RENDER_ANIMATION")
        row = layout.row(align=True)
        row.operator("veldt.render_passes")
        row.operator("veldt.convert")
        layout.operator("veldt.show_frames", icon="IMAGE_DATA")
        if running.is_running:
            layout.progress(factor=running.progress, text=running.message)
            layout.label(text="Esc stops it")
        elif running.message:
            _draw_text(layout, running.message, "ERROR" if running.is_error else "INFO")
        layout.separator()
        for name in ("config", "engine"):
            layout.prop(said, name)
        layout.operator("veldt.generate")


def _draw_active(layout: bpy.types.UILayout, active: bpy.types.Object | None) -> None:
    if active is None:
        layout.label(text="No active object")
        return
    said = active.veldt
    what = said.category or said.material if said.kind != "unset" else "not assigned itself"
    layout.label(text=f"{active.name}: {what}", icon="OBJECT_DATA")


def _draw_unassigned(layout: bpy.types.UILayout, scene: bpy.types.Scene) -> None:
    names = unassigned(scene)
    if not names:
        return
    layout.label(text=f"{len(names)} not assigned: {scene.veldt.rest}", icon="ERROR")
    for name in names[:_MOST_NAMES]:
        layout.label(text=name)
    if len(names) > _MOST_NAMES:
        layout.label(text="…")


def _draw_text(layout: bpy.types.UILayout, text: str, icon: str) -> None:
    """Lines of a message; labels do not wrap."""
    column = layout.column(align=True)
    for number, line in enumerate(text.splitlines()):
        column.label(text=line, icon=icon if number == 0 else "BLANK1")


CLASSES = (ProgramPanel, ObjectsPanel, SettingsPanel, MakePanel)
