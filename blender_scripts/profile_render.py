"""Measure where the time of a clip's frames goes. Run by Blender:

    blender -b --factory-startup --python-exit-code 1 --python profile_render.py -- --plan DIR
            [--clip ID] [--frames N] [--out DIR] [--supersample N] [--events-fd N]

Writes one event `profile`: the mean seconds per frame, and per step of rendering a frame. The exit codes are those of
render_passes.py.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True  # nothing is written into the folder of the scripts, whoever owns it
sys.path.insert(0, str(Path(__file__).resolve().parent))

# pylint: disable=wrong-import-position
from veldt.events import Events
from veldt.faults import ConfigError
from veldt_bl.entry import own_arguments, reported_imports, run

with reported_imports():
    import bpy

    from veldt.bake.baked import clip_of, read_plan, read_scene, read_track
    from veldt_bl.profile import profile_frames
    from veldt_bl.render import set_up_renderer
    from veldt_bl.scene import build_stage


def main(arguments: list[str]) -> int:
    """Run the command and return its exit code."""
    options = _parse(arguments)
    events = Events(options.events_fd)
    return run(lambda: _profile(options, events), events)


def _parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="profile_render.py", description="Measure where the time of frames goes."
    )
    parser.add_argument("--plan", type=Path, required=True, help="the folder that plan_scene.py has written")
    parser.add_argument("--clip", metavar="ID", help="default the first")
    parser.add_argument("--supersample", type=int, default=1, help="rays along each side of a pixel")
    parser.add_argument("--frames", type=int, default=12, help="number of frames; the first is not counted")
    parser.add_argument("--out", type=Path, help="keep the frames here")
    parser.add_argument("--events-fd", type=int, help="write the measurements here, one JSON object per line")
    return parser.parse_args(arguments)


def _profile(options: argparse.Namespace, events: Events) -> None:
    if options.frames < 2:
        raise ConfigError(f"--frames = {options.frames}; expected 2 or more")
    started_s = time.monotonic()
    plan = read_plan(options.plan)
    clip = clip_of(plan, options.clip) if options.clip else plan["clips"][0]
    frames = range(min(options.frames, clip["frames"]))
    stage = build_stage(read_scene(options.plan / "scene"))
    events.report("scene_built", seconds=round(time.monotonic() - started_s, 3))
    set_up_renderer(stage.scene.passes_intrinsics, options.supersample)
    stage.animate(read_track(options.plan / "tracks" / clip["id"], stage.scene))
    with tempfile.TemporaryDirectory() as passing:
        timings = profile_frames(options.out or Path(passing), frames, stage.pose, time.monotonic)
    render = bpy.context.scene.render
    pixels = render.resolution_x * render.resolution_y
    events.report(
        "profile", clip=clip["id"], pixels=pixels, objects=len(bpy.context.scene.objects), **timings
    )


if __name__ == "__main__":
    sys.exit(main(own_arguments()))
