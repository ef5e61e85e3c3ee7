"""Renders clips to multilayer EXR files, one a frame, each of which appears under its name only when it is whole."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path

import bpy

from veldt.camera import Intrinsics
from veldt.exr_files import is_whole
from veldt.manifest import LAYER, frame_file

from . import compat

_PART = "part_"


def set_up_renderer(intrinsics: Intrinsics, supersample: int) -> None:
    """One ray a pixel, through its centre, and nothing but the passes: indices, depth, normals.

    The picture has supersample x supersample pixels for each of those of `intrinsics`.
    """
    scene = bpy.context.scene
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    cycles.device = "CPU"
    cycles.samples = 1
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.max_bounces = 0
    cycles.seed = 0
    render.use_motion_blur = False
    render.use_persistent_data = True
    render.use_compositing = False
    render.use_sequencer = False
    render.use_file_extension = True
    render.resolution_x = supersample * intrinsics.width_px
    render.resolution_y = supersample * intrinsics.height_px
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1.0
    compat.write_multilayer_exr(render.image_settings)
    layer = bpy.context.view_layer
    layer.name = LAYER
    layer.use_pass_combined = False
    for name in ("object_index", "material_index", "z", "normal"):
        setattr(layer, f"use_pass_{name}", True)


def first_missing(folder: Path, frames: int) -> int:
    """Number of the first frame not there yet, `frames` if all are; leftovers of killed renders are removed."""
    for leftover in folder.glob(f"{_PART}*"):
        leftover.unlink()
    return next((k for k in range(frames) if not (folder / frame_file(k)).exists()), frames)


def render_frames(folder: Path, first: int, frames: int, on_frame: Callable[[int], None]) -> None:
    """Renders frames first, first + 1, … frames - 1 into the folder; on_frame(k) when frame k is whole.

    OSError if a frame cannot be written whole, or if Blender stops before the last one.
    """
    scene = bpy.context.scene
    scene.render.filepath = str(folder / f"{_PART}######")
    scene.frame_start, scene.frame_end = first, frames - 1
    done: list[int] = []
    failures: list[Exception] = []

    def finish(rendered: bpy.types.Scene, *_) -> None:
        """Blender only prints what a handler raises, so a failure is kept, and rendering interrupted as by Ctrl-C."""
        if failures:
            return
        try:
            _finish_frame(folder, rendered.frame_current)
            on_frame(rendered.frame_current)
            done.append(rendered.frame_current)
        except Exception as error:  # pylint: disable=broad-exception-caught
            failures.append(error)
            signal.raise_signal(signal.SIGINT)

    bpy.app.handlers.render_write.append(finish)
    try:
        bpy.ops.render.render(animation=True)
    finally:
        bpy.app.handlers.render_write.remove(finish)
    if failures:
        raise failures[0]
    if len(done) < frames - first:
        raise OSError(f"{folder}: Blender stopped after {len(done)} of {frames - first} frames")


def _finish_frame(folder: Path, number: int) -> None:
    """Gives a written frame its final name, if it is whole."""
    part = folder / f"{_PART}{frame_file(number)}"
    if not is_whole(part):
        raise OSError(f"{folder / frame_file(number)}: Blender could not write all of it; is the disk full?")
    os.replace(part, folder / frame_file(number))
