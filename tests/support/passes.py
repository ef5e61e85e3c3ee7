"""Passes of a clip made up by the tests: small, and known to the last pixel."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from raw_exr import write_exr

WIDTH, HEIGHT, FRAMES = 24, 16, 3
GROUND, SHRUB, WALKER, ELEPHANT = 1, 4, 101, 102
OBJECTS, DEPTH, ACTORS = "Scene.IndexOB.X", "Scene.Depth.Z", "Actors.IndexOB.X"


def manifest(clip: str = "one", frames: int = FRAMES) -> dict:
    """What the indices of a clip mean."""
    actor = {"class": "actor"}
    return {
        "format": "veldt-passes",
        "version": 1,
        "clip": clip,
        "scene": "made_up",
        "seed": 5,
        "camera": {"width_px": WIDTH, "height_px": HEIGHT, "fx_px": 30, "fy_px": 30, "cx_px": 12, "cy_px": 8},
        "objects": [
            {"index": GROUND, "name": "ground", "class": "ground", "material": "soil"},
            {"index": SHRUB, "name": "shrub", "class": "plant", "material": "shrub"},
            actor
            | {"index": WALKER, "name": "walker", "material": "human", "category": "human", "track_id": 7},
            actor
            | {
                "index": ELEPHANT,
                "name": "cow",
                "material": "elephant",
                "category": "elephant",
                "track_id": 9,
            },
        ],
        "materials": [],
        "frames": [{"file": f"{k:06d}.exr", "time_s": k / 9} for k in range(frames)],
    }


def object_index(frame: int) -> np.ndarray:
    """A walker on its way to the right, half of an elephant at the left border, a shrub, sky above."""
    plane = np.full((HEIGHT, WIDTH), GROUND, np.float32)
    plane[:2] = 0
    plane[10:14, 0:5] = ELEPHANT
    plane[5:9, 8 + frame : 10 + frame] = WALKER
    plane[7:10, 9:12] = SHRUB  # hides a part of the walker
    return plane


def write_clip(folder: Path, clip: str = "one", frames: int = FRAMES, has_depth: bool = True) -> Path:
    """Write a clip's passes and manifest into a new folder."""
    folder.mkdir()
    for frame in range(frames):
        depth = np.full((HEIGHT, WIDTH), 40.0 + frame)
        depth[:2] = 1e10  # what Blender writes for the sky
        planes = {OBJECTS: object_index(frame)} | ({DEPTH: depth} if has_depth else {})
        write_exr(folder / f"{frame:06d}.exr", planes)
    write_manifest(folder, manifest(clip, frames))
    return folder


def actor_index(frame: int) -> np.ndarray:
    """The actors of a frame alone: the walker as it is behind the shrub."""
    plane = np.zeros((HEIGHT, WIDTH), np.float32)
    plane[10:14, 0:5] = ELEPHANT
    plane[5:9, 8 + frame : 10 + frame] = WALKER
    return plane


def add_actor_layer(folder: Path, frames: Iterable[int] = range(FRAMES)) -> None:
    """Rewrite some frames of a clip with the actors alone in an additional layer, and name it in the manifest."""
    for frame in frames:
        planes = {OBJECTS: object_index(frame), ACTORS: actor_index(frame)}
        write_exr(folder / f"{frame:06d}.exr", planes)
    write_manifest(folder, manifest(folder.name) | {"actor_layer": "Actors"})


def write_manifest(folder: Path, document: dict) -> None:
    """Write a manifest beside the passes."""
    (folder / "manifest.json").write_text(json.dumps(document, indent=1), encoding="utf-8")


def change_index(folder: Path, frame: int, value: float, x_px: int = 3, y_px: int = 2) -> None:
    """Rewrite a frame with another value in one pixel of its object index."""
    plane = object_index(frame)
    plane[y_px, x_px] = value
    write_exr(folder / f"{frame:06d}.exr", {OBJECTS: plane})
