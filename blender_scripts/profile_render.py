"""Profile the rendering of a clip's frames. Run by Blender:

    blender -b --factory-startup --python-exit-code 1 --python profile_render.py -- --plan DIR
            [--clip ID ...] [--frames N] [--out DIR] [--supersample N ...] [--events-fd N]

Writes an event `profile` for each clip and supersampling, all clips of one supersampling first: the mean seconds per
frame, per step of rendering a frame, and the peak memory so far. The exit codes are those of render_passes.py.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True  # write nothing into the scripts' folder
sys.path.insert(0, str(Path(__file__).resolve().parent))

# pylint: disable=wrong-import-position
from planner.events import Events
from planner.faults import ConfigError
from veldt_bl.entry import own_arguments, reported_imports, run

with reported_imports():
    import bpy

    from planner.bake.baked import clip_of, read_plan, read_scene, read_track
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
    parser.add_argument("--clip", nargs="+", default=[], metavar="ID", help="default the first")
    parser.add_argument(
        "--supersample", type=int, nargs="+", default=[1], metavar="N", help="rays along each side of a pixel"
    )
    parser.add_argument("--frames", type=int, default=12, help="number of frames; the first is not counted")
    parser.add_argument("--out", type=Path, help="keep the frames in DIR/CLIP/NxN")
    parser.add_argument("--events-fd", type=int, help="write the measurements here, one JSON object per line")
    return parser.parse_args(arguments)


def _profile(options: argparse.Namespace, events: Events) -> None:
    if options.frames < 2:
        raise ConfigError(f"--frames = {options.frames}; expected 2 or more")
    started_s = time.monotonic()
    plan = read_plan(options.plan)
    clips = [clip_of(plan, name) for name in options.clip] or plan["clips"][:1]
    stage = build_stage(read_scene(options.plan / "scene"))
    events.report("scene_built", seconds=round(time.monotonic() - started_s, 3))
    with tempfile.TemporaryDirectory() as passing:
        for supersample in options.supersample:
            for clip in clips:
                folder = (options.out or Path(passing)) / clip["id"] / f"{supersample}x{supersample}"
                track = read_track(options.plan / "tracks" / clip["id"], stage.scene)
                set_up_renderer(stage.scene.passes_of(track), supersample)
                stage.animate(track)
                frames = range(min(options.frames, clip["frames"]))
                timings = profile_frames(folder, frames, stage.pose, time.monotonic)
                events.report("profile", clip=clip["id"], supersample=supersample, **_size(), **timings)


def _size() -> dict[str, int]:
    """Size of a frame, and the peak memory of this process. On Linux, ru_maxrss includes that of the program which
    started it.
    """
    render = bpy.context.scene.render
    status = Path("/proc/self/status").read_text(encoding="ascii")
    peak_kib = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM"))
    pixels = render.resolution_x * render.resolution_y
    return {
        "pixels": pixels,
        "objects": len(bpy.context.scene.objects),
        "peak_mb": 1024 * peak_kib // 10**6,
    }


if __name__ == "__main__":
    sys.exit(main(own_arguments()))
