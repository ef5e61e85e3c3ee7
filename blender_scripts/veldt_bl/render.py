"""Render clips to multilayer EXR files, one per frame; a file gets its final name only when it is complete."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import bpy

from planner.blender_images import add_layer, is_whole_exr
from planner.camera import Intrinsics, pixel_aspect

from . import compat
from .scene import Stage

LAYER = "Scene"
ACTOR_LAYER = "Actors"
_PART = "part_"


def frame_file(number: int) -> str:
    """Name of a frame's passes."""
    return f"{number:06d}.exr"


def set_up_renderer(intrinsics: Intrinsics, supersample: int) -> None:
    """Render one ray per pixel, through its centre, and only the passes: indices, depth and normals.

    The picture has supersample x supersample pixels for each pixel of `intrinsics`.
    """
    scene = bpy.context.scene
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    cycles.device = "CPU"
    cycles.samples = 1
    # The single ray passes through the centre of its filter, which Cycles reads from a table: with the default filter,
    # it is 6e-4 px off the pixel's centre.
    cycles.pixel_filter_type = "BLACKMAN_HARRIS"
    cycles.filter_width = 0.01
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
    render.pixel_aspect_x, render.pixel_aspect_y = pixel_aspect(intrinsics)
    layer = bpy.context.view_layer
    layer.name = LAYER
    layer.use_pass_combined = False
    for name in ("object_index", "material_index", "z", "normal"):
        setattr(layer, f"use_pass_{name}", True)


def first_missing(folder: Path, frames: int) -> int:
    """Index of the first missing or damaged frame, or `frames`; removes leftovers of killed renders."""
    for leftover in folder.glob(f"{_PART}*"):
        leftover.unlink()
    return next((k for k in range(frames) if not is_whole_exr(folder / frame_file(k))), frames)


def render_frames(
    folder: Path, frames: range, pose: Callable[[int], None], on_frame: Callable[[int], None]
) -> None:
    """Render frames into the folder; calls pose(k) before frame k is rendered and on_frame(k) when it is complete.

    OSError if a frame cannot be written completely, or if Blender stops before the last one.
    """
    compat.write_multilayer_exr(bpy.context.scene.render.image_settings, packed=True)

    def finish(number: int) -> None:
        _finish_frame(folder / frame_file(number), _part(folder, number))
        on_frame(number)

    _animate(folder, frames, pose, finish)


def render_frames_and_actors(
    folder: Path, frames: range, stage: Stage, on_frame: Callable[[int], None]
) -> None:
    """Render frames like `render_frames`, each with an additional layer: the actors alone.

    Frames that may contain actors are rendered twice, the second time without the place.
    """
    compat.write_multilayer_exr(bpy.context.scene.render.image_settings, packed=False)

    def pose(number: int) -> None:
        stage.pose(number // 2)
        stage.show_place(number % 2 == 0)

    def finish(number: int) -> None:
        if number % 2 == 1 or not stage.has_actors(number // 2):
            _join_layers(folder, number // 2)
            on_frame(number // 2)

    for run in _runs(frames, stage.has_actors):
        step = 1 if stage.has_actors(run[0]) else 2
        _animate(folder, range(2 * run[0], 2 * run[-1] + 2, step), pose, finish)
        stage.show_place(True)


def _runs(frames: range, is_one_kind: Callable[[int], bool]) -> list[range]:
    """Frames split into the longest possible runs of one kind."""
    starts = [k for k in frames if k == frames[0] or is_one_kind(k) != is_one_kind(k - 1)]
    return [range(start, stop) for start, stop in zip(starts, [*starts[1:], frames.stop])]


def _join_layers(folder: Path, frame: int) -> None:
    """Combine Blender's frames 2 * frame and, if it exists, 2 * frame + 1 into one frame."""
    both, alone = _part(folder, 2 * frame), _part(folder, 2 * frame + 1)
    other = alone if alone.exists() else None
    for part in filter(None, (both, other)):
        _check_whole(folder / frame_file(frame), part)
    joined = folder / f"{_PART}joined.exr"
    add_layer(both, f"{ACTOR_LAYER}.IndexOB.X", other, f"{LAYER}.{compat.OBJECT_INDEX}", joined)
    both.unlink()
    alone.unlink(missing_ok=True)
    _finish_frame(folder / frame_file(frame), joined)


def _part(folder: Path, number: int) -> Path:
    return folder / f"{_PART}{frame_file(number)}"


def _animate(folder: Path, frames: range, pose: Callable[[int], None], finish: Callable[[int], None]) -> None:
    """Render frames to part files; calls pose(k) before frame k is rendered and finish(k) when it is written."""
    scene = bpy.context.scene
    scene.render.filepath = str(folder / f"{_PART}######")
    scene.frame_start, scene.frame_end, scene.frame_step = frames[0], frames[-1], frames.step
    done: list[int] = []
    failures: list[Exception] = []

    def pose_one(number: int) -> None:  # Blender also calls this for its current first frame
        pose(min(max(number, frames[0]), frames[-1]))

    def finish_one(number: int) -> None:
        finish(number)
        done.append(number)

    before, after = _handler(pose_one, failures), _handler(finish_one, failures)
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
    """A Blender handler that calls act(frame) until a handler has failed.

    Blender only prints exceptions of handlers, so a failure is stored and rendering is stopped.
    """

    def handle(scene: bpy.types.Scene, *_) -> None:
        if failures:
            return
        try:
            act(scene.frame_current)
        except Exception as error:  # pylint: disable=broad-exception-caught
            failures.append(error)
            compat.stop_rendering(scene)

    return handle


def _finish_frame(frame: Path, part: Path) -> None:
    """Give a written frame its final name if it is complete."""
    _check_whole(frame, part)
    os.replace(part, frame)


def _check_whole(frame: Path, part: Path) -> None:
    if not is_whole_exr(part):
        raise OSError(f"{frame}: Blender could not write all of it; is the disk full?")
