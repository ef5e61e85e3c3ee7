# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of a dataset in Blender's image editor."""

from __future__ import annotations

from pathlib import Path

import bpy

_IMAGE = "Veldt frames"


def first_frame(out: Path) -> Path:
    """The first frame of the dataset made last, of those that the panel makes below `out`. OSError if there is none."""
    frames = [
        frame for kind in ("dataset", "generated") for frame in (out / kind).glob("clips/*/ir8/000000.png")
    ]
    if not frames:
        raise OSError(f"{out}: no frames; expected a dataset, which Make Dataset makes")
    return max(frames, key=lambda frame: frame.stat().st_mtime_ns)


def show(context: bpy.types.Context, first: Path) -> bpy.types.Image:
    """Load a sequence of frames and show it in an image editor, if there is one or a window to make one in."""
    if (old := bpy.data.images.get(_IMAGE)) is not None:
        bpy.data.images.remove(old)
    image = bpy.data.images.load(str(first))
    image.name = _IMAGE
    image.source = "SEQUENCE"
    if (editor := _editor(context)) is not None:
        editor.image = image
        user = editor.image_user
        user.frame_duration = len(list(first.parent.glob("*.png")))
        user.frame_start, user.frame_offset = context.scene.frame_start, -1  # files are counted from 0
        user.use_auto_refresh = True
    return image


def _editor(context: bpy.types.Context) -> bpy.types.SpaceImageEditor | None:
    """An image editor of the screen; otherwise a new window of one; None without a window."""
    for area in context.screen.areas if context.screen else ():
        if area.type == "IMAGE_EDITOR":
            return area.spaces.active
    if bpy.app.background or context.window is None:
        return None
    bpy.ops.wm.window_new()
    area = context.window_manager.windows[-1].screen.areas[0]
    area.type = "IMAGE_EDITOR"
    return area.spaces.active
