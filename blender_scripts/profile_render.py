"""Measures where the time of a clip's frames goes. Blender runs it:

    blender -b --factory-startup --python-exit-code 1 --python profile_render.py -- --config FILE
            [--clip ID] [--frames N] [--out DIR] [--events-fd N]

It tells one event `profile`: the mean seconds of a frame, and those of the steps of its making. Exit codes as
render_passes.py's.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

# pylint: disable=wrong-import-position
import bpy

from veldt.config import load
from veldt.events import Events
from veldt.faults import ConfigError
from veldt.plan import with_flights_cut
from veldt.world import clip_of, plan_world
from veldt_bl.entry import own_arguments, run
from veldt_bl.profile import profile_frames
from veldt_bl.render import set_up_renderer
from veldt_bl.scene import build_stage


def main(arguments: list[str]) -> int:
    """Runs the command and returns its exit code."""
    options = _parse(arguments)
    events = Events(options.events_fd)
    return run(lambda: _profile(options, events), events)


def _parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="profile_render.py", description="Measures where the time of frames goes."
    )
    parser.add_argument("--config", type=Path, required=True)
    parser.add_argument("--clip", metavar="ID", help="default the first")
    parser.add_argument("--frames", type=int, default=12, help="so many, the first of which is not counted")
    parser.add_argument("--out", type=Path, help="keep the frames here")
    parser.add_argument("--events-fd", type=int, help="write what was measured here, one JSON object a line")
    return parser.parse_args(arguments)


def _profile(options: argparse.Namespace, events: Events) -> None:
    if options.frames < 2:
        raise ConfigError(f"--frames = {options.frames}; expected 2 or more")
    started_s = time.monotonic()
    world = with_flights_cut(plan_world(load(options.config)))
    config = world.config
    clip = clip_of(config, options.clip) if options.clip else config["clips"][0]
    clip = {**clip, "frames": options.frames}
    stage = build_stage(world)
    events.tell("scene_built", seconds=round(time.monotonic() - started_s, 3))
    set_up_renderer(stage.world.passes_intrinsics, config["render"]["supersample"])
    stage.animate(clip)
    with tempfile.TemporaryDirectory() as passing:
        told = profile_frames(options.out or Path(passing), range(clip["frames"]), stage.pose, time.monotonic)
    render = bpy.context.scene.render
    pixels = render.resolution_x * render.resolution_y
    events.tell("profile", clip=clip["id"], pixels=pixels, objects=len(bpy.context.scene.objects), **told)


if __name__ == "__main__":
    sys.exit(main(own_arguments()))
