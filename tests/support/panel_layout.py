"""Stands in for Blender's layout: records what a panel shows, and checks that all of it exists."""

from __future__ import annotations

import bpy


class Layout:
    """What is shown, line by line; rows and columns share it."""

    def __init__(self, shown: list[str] | None = None):
        self.shown = [] if shown is None else shown

    def row(self, **_) -> Layout:
        """As Blender's."""
        return Layout(self.shown)

    column = row

    def label(self, text: str, icon: str = "NONE") -> None:
        """As Blender's."""
        icons = bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
        assert icon in icons.keys()
        self.shown.append(text)

    def prop(self, data, name: str) -> None:
        """As Blender's."""
        assert name in data.bl_rna.properties.keys(), name
        self.shown.append(f"[{name}]")

    def operator(self, name: str, text: str = "", icon: str = "NONE") -> None:
        """As Blender's."""
        assert icon in bpy.types.UILayout.bl_rna.functions["operator"].parameters["icon"].enum_items.keys()
        label = getattr(bpy.ops.veldt, name.removeprefix("veldt.")).get_rna_type().name
        self.shown.append(f"({text or label})")

    def progress(self, factor: float, text: str) -> None:
        """As Blender's."""
        assert "progress" in bpy.types.UILayout.bl_rna.functions.keys()
        self.shown.append(f"{text} {factor:.0%}")

    def separator(self) -> None:
        """As Blender's."""
