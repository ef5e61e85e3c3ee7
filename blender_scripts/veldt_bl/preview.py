"""Render a preview of a dataset: a map of the scene, and colour stills."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np

from planner.bake.baked import BakedScene, BakedSheet, BakedTrack
from planner.blender_images import is_whole_png
from planner.camera import look
from planner.preview.colours import SKY, linear, surface_colour
from planner.preview.views import INTRINSICS

from . import compat
from .camera import add_camera, place
from .map_objects import add_sheet
from .meshes import new_object
from .plants import EVERYWHERE_M, show_within
from .scene import Stage

_MAP_WIDTH_PX = 1920
_MAP_SAMPLES, _STILL_SAMPLES = 8, 16
_SUN_DEG = 45.0, 0.0, 45.0  # from the north-west, as on maps
_SUN_W_M2, _SKY_STRENGTH = 2.3, 0.7
_SUN_DISC_RAD = 0.0093
_CLEARANCE_M = 50.0  # of the sheet above all plants


@dataclass(frozen=True)
class Picture:
    """A picture to render: its file name, and the function that sets up the scene for it."""

    file: str
    set_up: Callable[[], None]


def pictures_of(stage: Stage, sheet: BakedSheet) -> list[Picture]:
    """The stills and then the map."""
    return [
        *(
            Picture(f"{still['name']}.png", lambda still=still: _set_up_still(still))
            for still in sheet.header["stills"]
        ),
        # Last, because the map's objects stay in the scene.
        Picture("map.png", lambda: _set_up_map(stage, sheet)),
    ]


def render_pictures(
    stage: Stage, moment: BakedTrack, pictures: list[Picture], folder: Path, on_picture: Callable[[int], None]
) -> None:
    """Write NAME.png for each picture, with all actors as in the only frame of `moment`, and call on_picture(k) when
    the k-th is complete. OSError if writing fails."""
    folder.mkdir(parents=True, exist_ok=True)
    _remove_pictures(folder)
    _set_up_colours(stage.scene)
    _set_up_renderer()
    _add_light()
    stage.rigs.pose(moment, 0)
    show_within(stage.flora, np.zeros(2), EVERYWHERE_M)
    for k, picture in enumerate(pictures):
        picture.set_up()
        _render(folder / picture.file)
        on_picture(k)


def _remove_pictures(folder: Path) -> None:
    """Remove the pictures of an earlier preview, which may be of another config."""
    for pattern in ("map.png", "overview.png", "close_*.png", "part_*.png"):
        for picture in folder.glob(pattern):
            picture.unlink()


def _render(picture: Path) -> None:
    part = picture.with_name(f"part_{picture.name}")
    bpy.context.scene.render.filepath = str(part)
    try:
        bpy.ops.render.render(write_still=True)
    except RuntimeError as error:  # its text ends with a line break
        raise OSError(f"{picture}: {str(error).strip()}") from error
    if not is_whole_png(part):
        raise OSError(f"{picture}: Blender could not write all of it; is the disk full?")
    os.replace(part, picture)


def _set_up_renderer() -> None:
    scene = bpy.context.scene
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    cycles.device = "CPU"
    cycles.use_denoising = False
    cycles.seed = 0
    cycles.transparent_max_bounces = 8
    render.use_compositing = render.use_sequencer = False
    render.resolution_percentage = 100
    compat.write_png(render.image_settings)
    scene.view_settings.view_transform = "Standard"


def _set_up_colours(scene: BakedScene) -> None:
    """Give every surface a matte colour."""
    pairs = {
        entry["index"]: (entry["material"], entry.get("part", "")) for entry in scene.header["materials"]
    }
    for material in bpy.data.materials:
        if material.pass_index in pairs:
            tree = compat.use_nodes(material)
            matte = tree.nodes.new("ShaderNodeBsdfDiffuse")
            matte.inputs["Color"].default_value = (*linear(surface_colour(*pairs[material.pass_index])), 1.0)
            output = tree.nodes.new("ShaderNodeOutputMaterial")
            tree.links.new(matte.outputs["BSDF"], output.inputs["Surface"])


def _add_light() -> None:
    """Add a sun and a sky."""
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = _SUN_W_M2, _SUN_DISC_RAD
    shining = new_object("sun", sun, 0)
    shining.rotation_euler = np.radians(_SUN_DEG)
    sky = bpy.data.worlds.new("sky")
    tree = compat.use_nodes(sky)
    glow, output = tree.nodes.new("ShaderNodeBackground"), tree.nodes.new("ShaderNodeOutputWorld")
    glow.inputs["Color"].default_value = (*linear(SKY), 1.0)
    glow.inputs["Strength"].default_value = _SKY_STRENGTH
    tree.links.new(glow.outputs["Background"], output.inputs["Surface"])
    bpy.context.scene.world = sky


def _set_up_still(still: dict) -> None:
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = INTRINSICS.width_px, INTRINSICS.height_px
    scene.cycles.samples, scene.cycles.max_bounces = _STILL_SAMPLES, 1
    place(add_camera(INTRINSICS), np.array(still["camera_to_world"]))


def _set_up_map(stage: Stage, sheet: BakedSheet) -> None:
    scene = bpy.context.scene
    width_m, height_m = sheet.header["width_m"], sheet.header["height_m"]
    scene.render.resolution_x = _MAP_WIDTH_PX
    scene.render.resolution_y = round(_MAP_WIDTH_PX * height_m / width_m)
    scene.cycles.samples, scene.cycles.max_bounces = _MAP_SAMPLES, 0
    _, ground_m = stage.scene.heights_m
    top_m = add_sheet(sheet, ground_m + stage.flora.reach_m + _CLEARANCE_M)
    camera = add_camera(INTRINSICS)
    camera.data.type, camera.data.ortho_scale = "ORTHO", width_m
    above_m = np.array([[*sheet.header["centre_m"], top_m + _CLEARANCE_M]])
    place(camera, look(above_m, np.array([[0.0, 1.0]]), np.array([0.5 * np.pi]))[0])
