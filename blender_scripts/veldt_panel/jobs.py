# SPDX-License-Identifier: GPL-3.0-or-later
"""The buttons' jobs, as generators that yield progress: an operator runs them step by step, or all at once.

Closing a generator stops it and restores its changes in Blender.
"""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bpy

from .catalogue import Catalogue
from .manifest import Frame, build_manifest, clip_name, frame_file
from .passes import render_frame
from .program import Job, Progress, run
from .stage import Stage

_SENSOR_MM = 36.0


@dataclass(frozen=True)
class Request:
    """The settings of a scene, checked."""

    scene: bpy.types.Scene
    view_layer: bpy.types.ViewLayer
    out: Path
    clip: str
    frames: range
    preset: str
    focal_mm: float | None  # None: the scene's camera
    size_px: tuple[int, int]
    supersample: int
    rest: str
    settings: list[str]

    @property
    def passes(self) -> Path:
        """The folder of the clip's passes."""
        return self.out / "passes" / self.clip

    @property
    def dataset(self) -> Path:
        """The folder of the dataset."""
        return self.out / "dataset"


def request_of(scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer, known: Catalogue) -> Request:
    """The request of the settings. ValueError with a text for the user if they are invalid."""
    said = scene.veldt
    if scene.camera is None:
        raise ValueError("scene.camera is missing; expected a camera")
    if not said.out:
        raise ValueError("output folder is missing; expected a folder")
    if said.preset not in known.presets:
        raise ValueError(f'camera preset = "{said.preset}"; expected one of {", ".join(known.presets)}')
    if said.rest not in known.materials:
        raise ValueError(f'material of the rest = "{said.rest}"; expected a file in assets/materials')
    frames = range(scene.frame_start, scene.frame_end + 1, scene.frame_step)
    if said.own_range:
        frames = range(said.frame_start, said.frame_end + 1)
    if not frames:
        raise ValueError(
            f"frames = {frames.start} to {frames.stop - 1}; expected the last at or after the first"
        )
    preset = known.presets[said.preset]
    size_px, focal_mm = (preset.width_px, preset.height_px), preset.focal_px * _SENSOR_MM / preset.width_px
    if said.lens == "SCENE":
        share = scene.render.resolution_percentage / 100
        size_px = (int(scene.render.resolution_x * share), int(scene.render.resolution_y * share))
        focal_mm = None
    return Request(
        scene=scene,
        view_layer=view_layer,
        out=Path(bpy.path.abspath(said.out)),
        clip=clip_name(said.clip or Path(bpy.data.filepath).stem or scene.name),
        frames=frames,
        preset=said.preset,
        focal_mm=focal_mm,
        size_px=size_px,
        supersample=said.supersample,
        rest=said.rest,
        settings=_settings(said),
    )


def _settings(said) -> list[str]:
    if said.time and not re.fullmatch(r"([01][0-9]|2[0-3]):[0-5][0-9]", said.time):
        raise ValueError(f'time of day = "{said.time}"; expected HH:MM, such as 03:00')
    time = [f"weather.time={said.time}"] if said.time else []
    return [f"sensor.preset={said.preset}", f"season={said.season}", *time]


def render_passes(request: Request) -> Job:
    """Render the passes of a clip and write its manifest. The folder of an earlier run is replaced at the end."""
    _check_replaceable(request.passes)
    with _new_folder(request.passes) as folder:
        with Stage(request.scene, request.view_layer, request.rest) as stage:
            yield from _render_frames(request, stage, folder)
    return f"{len(request.frames)} frames of passes in {request.passes}"


def _render_frames(request: Request, stage: Stage, folder: Path) -> Iterator[Progress]:
    rate_hz = request.scene.render.fps / request.scene.render.fps_base
    unit_m = request.scene.unit_settings.scale_length
    stage.set_size(*request.size_px, request.supersample)
    # Depth is in Blender's units, whose length a manifest cannot state.
    stage.scene.view_layers[0].use_pass_z = abs(unit_m - 1) < 1e-6
    frames: list[Frame] = []
    intrinsics = None
    for number, moment in enumerate(request.frames):
        yield Progress(number / len(request.frames), f"passes: frame {moment}")
        stage.pose(moment, camera_at(request.scene, moment), request.focal_mm)
        seen = stage.intrinsics(*request.size_px)
        if seen != (intrinsics := intrinsics or seen):
            raise ValueError(
                f"lens at frame {moment} = {seen.fx_px:.3f} px; expected {intrinsics.fx_px:.3f} px, as before"
            )
        render_frame(stage.scene, folder / frame_file(number))
        actors = {index: _in_metres(root, unit_m) for index, root in stage.actors.items()}
        time_s = (moment - request.frames[0]) / rate_hz
        frames.append(Frame(frame_file(number), time_s, _in_metres(stage.camera_matrix, unit_m), actors))
    manifest = build_manifest(
        request.clip,
        rate_hz / request.frames.step,
        request.supersample,
        intrinsics,
        stage.indices.objects(),
        frames,
    )
    (folder / "manifest.json").write_text(json.dumps(manifest, indent=1) + "\n", encoding="utf-8")


def convert(request: Request, program: str) -> Job:
    """Convert the clip's passes to a dataset."""
    if not (request.passes / "manifest.json").is_file():
        raise ValueError(f"{request.passes}: no passes; expected those that Render Passes makes")
    arguments = ["convert", str(request.passes), "--out", str(request.dataset), "--set", *request.settings]
    return (yield from run(program, arguments))


def make_dataset(request: Request, program: str) -> Job:
    """Render passes, then convert them."""
    yield from render_passes(request)
    return (yield from convert(request, program))


def generate(program: str, config: str, out: Path, engine: str) -> Job:
    """Make a dataset of a config, without the scene."""
    return (yield from run(program, ["generate", config, "--out", str(out), "--engine", engine]))


def camera_at(scene: bpy.types.Scene, frame: int) -> bpy.types.Object:
    """The camera of a frame: that of the last marker at or before it, otherwise that of the scene."""
    marked = [each for each in scene.timeline_markers if each.camera is not None and each.frame <= frame]
    return max(marked, key=lambda each: each.frame).camera if marked else scene.camera


def _in_metres(matrix, unit_m: float) -> list[list[float]]:
    rows = [list(row) for row in matrix]
    for row in rows[:3]:
        row[3] *= unit_m
    return rows


def _check_replaceable(folder: Path) -> None:
    """Check that a folder holds nothing but passes, so that it may be replaced."""
    if folder.exists() and not (folder / "manifest.json").is_file():
        raise ValueError(f"{folder}: not a folder of passes; expected passes, or nothing")


@contextmanager
def _new_folder(folder: Path) -> Iterator[Path]:
    """A folder to write into, which replaces `folder` once it is complete, and is removed otherwise."""
    # Clip names have no dots, so these folders are always ours.
    part = folder.with_name(folder.name + ".part")
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    try:
        yield part
        old = folder.with_name(folder.name + ".old")
        shutil.rmtree(old, ignore_errors=True)
        if folder.exists():
            os.replace(folder, old)
        os.replace(part, folder)
        shutil.rmtree(old, ignore_errors=True)
    finally:
        shutil.rmtree(part, ignore_errors=True)
