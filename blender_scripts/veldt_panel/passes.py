# SPDX-License-Identifier: GPL-3.0-or-later
"""How passes are rendered: one ray through each pixel's centre, so that no index is a mixture of two."""

from __future__ import annotations

from pathlib import Path

import bpy

from .manifest import LAYER

_IS_5 = bpy.app.version >= (5, 0, 0)


def set_up(scene: bpy.types.Scene) -> None:
    """Set a scene of ours, with one view layer, up for passes: indices, depth in Blender's units, normals."""
    _set_up_cycles(scene)
    render = scene.render
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1
    for name in (
        *("use_border", "use_crop_to_border", "use_compositing", "use_freestyle", "use_motion_blur"),
        *("use_multiview", "use_persistent_data", "use_sequencer"),
    ):
        setattr(render, name, False)
    render.use_file_extension = render.use_overwrite = True
    scene.frame_step = 1
    _set_up_layer(scene.view_layers[0])
    _write_exr(render.image_settings)


def render_frame(scene: bpy.types.Scene, file: Path) -> None:
    """Render the current frame of a scene that is set up. RuntimeError or OSError if no file was written.

    As an animation of one frame: a still would show what is animated as it is in the window, which shows another scene.
    """
    scene.frame_start = scene.frame_end = scene.frame_current
    scene.render.filepath = str(file.with_name("rendered_######"))
    bpy.ops.render.render(animation=True, scene=scene.name)
    rendered = list(file.parent.glob("rendered_*"))
    if len(rendered) != 1:
        raise OSError(f"{file}: Blender has not written it; is the disk full?")
    rendered[0].replace(file)


def _set_up_cycles(scene: bpy.types.Scene) -> None:
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = 1
    # The only ray passes through the middle of its filter; with the default filter 6e-4 px beside the pixel's centre.
    cycles.pixel_filter_type = "BLACKMAN_HARRIS"
    cycles.filter_width = 0.01
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_animated_seed = False
    cycles.max_bounces = 0  # rays still pass through transparent surfaces
    cycles.seed = 0


def _set_up_layer(layer: bpy.types.ViewLayer) -> None:
    for settings in (layer, layer.cycles):
        for name in settings.bl_rna.properties.keys():
            if name.startswith("use_pass_"):
                setattr(settings, name, False)
    layer.name = LAYER
    layer.use = True
    layer.samples = 0  # those of the scene
    for name in ("object_index", "z", "normal"):
        setattr(layer, f"use_pass_{name}", True)


def _write_exr(settings: bpy.types.ImageFormatSettings) -> None:
    if _IS_5:
        settings.media_type = "MULTI_LAYER_IMAGE"
        settings.use_exr_interleave = True
    settings.file_format = "OPEN_EXR_MULTILAYER"
    settings.color_depth = "32"
    settings.exr_codec = "ZIP"  # lossless
