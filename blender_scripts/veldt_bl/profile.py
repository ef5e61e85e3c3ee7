"""Measure the time of the steps of rendering a frame."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np

from .render import render_frames


def profile_frames(
    folder: Path, frames: range, pose: Callable[[int], None], clock_s: Callable[[], float]
) -> dict:
    """Mean seconds per frame: `frame_s` in total, `split_s` by step. The first frame is not counted.

    Renders into the folder, saves the last picture once more, and then renders a single pixel of each frame, which
    needs every step but tracing and writing; its output is discarded.
    """
    folder.mkdir(parents=True, exist_ok=True)
    whole = _spans_s(folder, frames, pose, clock_s)
    write_s = _write_s(folder / "again.exr", clock_s)
    with tempfile.TemporaryDirectory() as passing:
        pixel = _spans_s(Path(passing), frames, pose, clock_s, only_a_pixel=True)
    sync_s = min(pixel["render"], whole["render"] - write_s)
    split_s = {
        "pose": whole["pose"],
        "scene": whole["scene"],
        "sync_and_trees": sync_s,
        "trace": whole["render"] - write_s - sync_s,
        "write": write_s,
    }
    return {
        "frames": len(frames) - 1,
        "split_s": {name: round(span_s, 5) for name, span_s in split_s.items()},
        "frame_s": round(sum(whole.values()), 5),
    }


def _spans_s(
    folder: Path,
    frames: range,
    pose: Callable[[int], None],
    clock_s: Callable[[], float],
    only_a_pixel: bool = False,
) -> dict[str, float]:
    """Mean seconds of all frames but the first: in `pose`, until the scene is updated, and until the file exists."""
    rows: list[tuple[float, ...]] = []
    at_s = {}

    def pose_timed(frame: int) -> None:
        at_s["begun"] = clock_s()
        pose(frame)
        at_s["posed"] = clock_s()

    def update(*_) -> None:
        at_s["updated"] = clock_s()

    def finish(_) -> None:
        rows.append((at_s["begun"], at_s["posed"], at_s["updated"], clock_s()))

    bpy.app.handlers.frame_change_post.append(update)
    _crop(only_a_pixel)
    try:
        render_frames(folder, frames, pose_timed, finish)
    finally:
        _crop(False)
        bpy.app.handlers.frame_change_post.remove(update)
    begun, posed, updated, written = np.array(rows).T
    between = begun[1:] - written[:-1]
    return {
        "pose": float(np.mean((posed - begun)[1:])),
        "scene": float(np.mean((updated - posed)[1:] + between)),
        "render": float(np.mean((written - updated)[1:])),
    }


def _crop(only_a_pixel: bool) -> None:
    """Restrict rendering to one pixel in the middle of the picture, or render all of it."""
    render = bpy.context.scene.render
    render.use_border = render.use_crop_to_border = only_a_pixel
    for side, size_px in (("x", render.resolution_x), ("y", render.resolution_y)):
        setattr(render, f"border_min_{side}", 0.5)
        setattr(render, f"border_max_{side}", 0.5 + 1.0 / size_px)


def _write_s(file: Path, clock_s: Callable[[], float]) -> float:
    """Seconds needed to write the last picture; the file is removed afterwards."""
    started_s = clock_s()
    bpy.data.images["Render Result"].save_render(str(file))
    written_s = clock_s() - started_s
    file.unlink()
    return written_s
