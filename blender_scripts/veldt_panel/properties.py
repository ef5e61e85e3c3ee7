# SPDX-License-Identifier: GPL-3.0-or-later
"""Data of the add-on: assignments in objects and collections, settings in scenes, the program in preferences."""

# No postponed annotations: Blender reads them as properties.

from pathlib import Path

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from .catalogue import Catalogue, read_catalogue

KINDS = (
    ("unset", "Not assigned", "Background of the material of the rest"),
    ("actor", "Actor", "Labelled: an animal, a person or a vehicle"),
    ("ground", "Ground", "Background"),
    ("plant", "Plant", "Background: plants and anything else that stands on the ground"),
    ("water", "Water", "Background"),
)


def preferences(context: bpy.types.Context) -> "Preferences":
    """Those of this add-on."""
    return context.preferences.addons[__package__].preferences


def catalogue(context: bpy.types.Context) -> Catalogue:
    """The assets of the found program; empty before that."""
    home = preferences(context).home
    try:
        return read_catalogue(Path(home)) if home else Catalogue({}, (), {})
    except (OSError, ValueError, KeyError):
        return Catalogue({}, (), {})


def _matching(names, text: str) -> list[str]:
    return [name for name in names if text.lower() in name.lower()]


def _things(_, context, text):
    return _matching(catalogue(context).things, text)


def _materials(_, context, text):
    return _matching(catalogue(context).materials, text)


def _presets(_, context, text):
    return _matching(catalogue(context).presets, text)


def _categories(_, context, text):
    return _matching(sorted({each.category for each in catalogue(context).things.values()} - {""}), text)


def _take_thing(brush: "Brush", context: bpy.types.Context) -> None:
    """Fill in the properties of an asset."""
    if (thing := catalogue(context).things.get(brush.thing)) is not None:
        brush.kind, brush.material, brush.category = thing.kind, thing.material, thing.category


class Assignment(bpy.types.PropertyGroup):
    """Meaning of an object or a collection."""

    kind: EnumProperty(name="Kind", items=KINDS)
    material: StringProperty(name="Material", search=_materials)
    category: StringProperty(name="Category", search=_categories)
    species: StringProperty(name="Species")
    target: StringProperty(
        name="Target", description="Objects with the same name here are one target; empty: each is one"
    )


class Brush(bpy.types.PropertyGroup):
    """The next assignment, and the running job; stored in the window manager, so in no file."""

    thing: StringProperty(
        name="What it is", description="A thing that Veldt knows", search=_things, update=_take_thing
    )
    kind: EnumProperty(name="Kind", items=KINDS[1:])
    material: StringProperty(name="Material", description="Of its surface", search=_materials)
    category: StringProperty(name="Category", description="What labels call it", search=_categories)
    is_one: BoolProperty(name="One Target", description="All selected objects are parts of one actor")
    is_running: BoolProperty()
    progress: FloatProperty(min=0, max=1, subtype="FACTOR")
    message: StringProperty()
    is_error: BoolProperty()


class Settings(bpy.types.PropertyGroup):
    """Settings of a scene."""

    out: StringProperty(
        name="Output", description="Folder of passes and dataset", subtype="DIR_PATH", default="//veldt/"
    )
    clip: StringProperty(name="Clip", description="Name of the clip; empty: that of the file")
    own_range: BoolProperty(name="Own Frames", description="Other frames than the scene renders")
    frame_start: IntProperty(name="First", default=1, min=0)
    frame_end: IntProperty(name="Last", default=1, min=0)
    preset: StringProperty(name="Camera", default="boson_640_14mm", search=_presets)
    lens: EnumProperty(
        name="Lens",
        items=(
            ("PRESET", "Preset's", "Lens and size of the picture of the thermal camera"),
            ("SCENE", "Scene's", "Lens of the scene's camera, and the size that the scene renders"),
        ),
    )
    supersample: IntProperty(
        name="Rays",
        description="Rays along each side of a pixel: more give smoother edges",
        default=2,
        min=1,
        max=8,
    )
    season: EnumProperty(
        name="Season", items=(("winter", "Winter", "Dry and cool"), ("summer", "Summer", "Wet and warm"))
    )
    time: StringProperty(name="Time", description="Solar time, such as 03:00; empty: that of the season")
    rest: StringProperty(
        name="The Rest", description="Material of what is not assigned", default="soil", search=_materials
    )
    config: StringProperty(name="Config", description="A config.json of Veldt", subtype="FILE_PATH")
    engine: EnumProperty(
        name="Engine",
        items=(
            ("auto", "Automatic", "Embree wherever it can draw the config"),
            ("embree", "Embree", "Fast"),
            ("blender", "Blender", "Needs Blender as a program"),
        ),
    )


class Preferences(bpy.types.AddonPreferences):
    """Where the program is."""

    bl_idname = __package__

    program: StringProperty(
        name="Program", description="The program veldt; empty: the one on PATH", subtype="FILE_PATH"
    )
    home: StringProperty(name="Assets")  # of the program that was found
    version: StringProperty(name="Version")

    def draw(self, _) -> None:
        """Draw the preferences."""
        self.layout.prop(self, "program")
        self.layout.operator("veldt.find_program")
        self.layout.label(text=f"veldt {self.version}, {self.home}" if self.home else "Not found yet")


CLASSES = (Assignment, Brush, Settings, Preferences)


def register() -> None:
    """Register all properties."""
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.veldt = PointerProperty(type=Assignment)
    bpy.types.Collection.veldt = PointerProperty(type=Assignment)
    bpy.types.Scene.veldt = PointerProperty(type=Settings)
    bpy.types.WindowManager.veldt = PointerProperty(type=Brush)


def unregister() -> None:
    """Undo `register`."""
    for holder in (bpy.types.Object, bpy.types.Collection, bpy.types.Scene, bpy.types.WindowManager):
        del holder.veldt
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
