"""Run render_passes.py, but clear Blender's cached scene after each frame. Run by Blender, for a test."""

import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "blender_scripts"))

# pylint: disable=wrong-import-position
import render_passes
from veldt_bl.entry import own_arguments

_set_up = render_passes.set_up_renderer


def _set_up_without_memory(*arguments) -> None:
    _set_up(*arguments)
    bpy.context.scene.render.use_persistent_data = False


render_passes.set_up_renderer = _set_up_without_memory
sys.exit(render_passes.main(own_arguments()))
