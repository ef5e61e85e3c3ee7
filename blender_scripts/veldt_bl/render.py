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


def render_frames(
    folder: Path, frames: range, pose: Callable[[int], None], on_frame: Callable[[int], None]
) -> None:
    """Renders frames into the folder; pose(k) before frame k is rendered, on_frame(k) when it is whole.

    OSError if a frame cannot be written whole, or if Blender stops before the last one.
    """
    scene = bpy.context.scene
    scene.render.filepath = str(folder / f"{_PART}######")
    scene.frame_start, scene.frame_end = frames[0], frames[-1]
    done: list[int] = []
    failures: list[Exception] = []

    def finish(number: int) -> None:
        _finish_frame(folder, number)
        on_frame(number)
        done.append(number)

    before, after = _handler(pose, failures), _handler(finish, failures)
    bpy.app.handlers.frame_change_pre.append(before)
    bpy.app.handlers.render_write.append(after)
    try:
        bpy.ops.render.render(animation=True)
    finally:
        bpy.app.handlers.frame_change_pre.remove(before)
        bpy.app.handlers.render_write.remove(after)
    if failures:
        raise failures[0]
    if len(done) < len(frames):
        raise OSError(f"{folder}: Blender stopped after {len(done)} of {len(frames)} frames")


def _handler(act: Callable[[int], None], failures: list[Exception]) -> Callable:
    """Calls act(frame) for Blender until one of its handlers failed.

    Blender only prints what a handler raises, so a failure is kept, and rendering interrupted as by Ctrl-C.
    """

    def handle(scene: bpy.types.Scene, *_) -> None:
        if failures:
            return
        try:
            act(scene.frame_current)
        except Exception as error:  # pylint: disable=broad-exception-caught
            failures.append(error)
            signal.raise_signal(signal.SIGINT)

    return handle


def _finish_frame(folder: Path, number: int) -> None:
    """Gives a written frame its final name, if it is whole."""
    part = folder / f"{_PART}{frame_file(number)}"
    if not is_whole(part):
        raise OSError(f"{folder / frame_file(number)}: Blender could not write all of it; is the disk full?")
    os.replace(part, folder / frame_file(number))
