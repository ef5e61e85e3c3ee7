"""A planned map sheet as Blender objects with emissive colours that cast no shadow."""

from __future__ import annotations

import bpy
import numpy as np

from planner.bake.baked import BakedSheet
from planner.ids import GROUND
from planner.preview.colours import INK, linear

from . import compat
from .meshes import new_mesh, new_object

_STEP_M = 1.0  # between layers


def add_sheet(sheet: BakedSheet, height_m: float) -> float:
    """Add all layers above a height, with the labels on top; return the height of the labels."""
    for k, layer in enumerate(sheet.header["layers"]):
        _add_layer(layer, *sheet.mesh(k), height_m + k * _STEP_M)
    top_m = height_m + len(sheet.header["layers"]) * _STEP_M
    ink = _glow("ink", INK, 1.0)
    for label in sheet.header["labels"]:
        if label["text"]:
            _add_label(label, top_m, ink)
    return top_m


def _add_layer(layer: dict, points_m: np.ndarray, triangles: np.ndarray, height_m: float) -> None:
    if len(triangles) > 0:
        glow = _glow(layer["name"], layer["colour"], layer["opacity"])
        slot = np.zeros(len(triangles), np.int32)
        mesh = new_mesh(layer["name"], points_m, triangles, slot, [glow], smooth=False)
        _float(new_object(layer["name"], mesh, GROUND), height_m)


def _add_label(label: dict, height_m: float, ink: bpy.types.Material) -> None:
    words = bpy.data.curves.new(f"label {label['text']}", "FONT")
    words.body, words.size = label["text"], label["size_m"]
    words.align_x, words.align_y = "LEFT", "CENTER"
    words.materials.append(ink)
    shown = new_object(f"label {label['text']}", words, GROUND)
    shown.location.x, shown.location.y = label["x_m"], label["y_m"]
    _float(shown, height_m)


def _float(shown: bpy.types.Object, height_m: float) -> None:
    shown.location.z = height_m
    shown.visible_shadow = shown.visible_diffuse = False


def _glow(name: str, colour: str, opacity: float) -> bpy.types.Material:
    """An emissive material with this colour, independent of light."""
    material = bpy.data.materials.new(f"map {name}")
    tree = compat.use_nodes(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    glow = tree.nodes.new("ShaderNodeEmission")
    glow.inputs["Color"].default_value = (*linear(colour), 1.0)
    if opacity == 1.0:
        tree.links.new(glow.outputs["Emission"], output.inputs["Surface"])
        return material
    mix, clear = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeBsdfTransparent")
    mix.inputs[
        0
    ].default_value = opacity  # the next two sockets have the same name and differ only in their index
    tree.links.new(clear.outputs["BSDF"], mix.inputs[1])
    tree.links.new(glow.outputs["Emission"], mix.inputs[2])
    tree.links.new(mix.outputs["Shader"], output.inputs["Surface"])
    return material
