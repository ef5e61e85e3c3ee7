"""Render the passes of a plan's clips. Run by Blender:

    blender -b --factory-startup --disable-autoexec --python-exit-code 1 --python render_passes.py --
            --plan DIR --out DIR (--clip ID ... [--supersample N] [--actor-layer] | --preview) [--events-fd N]

For each clip, writes DIR/<clip>/000000.exr and so on; a file with such a name is complete. A second run resumes at a
clip's first missing frame. The thermal core writes the manifest beside them. Exit codes: 0 done, 1 failed, 2 the plan
has no such clip.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True  # write nothing into the scripts' folder
sys.path.insert(0, str(Path(__file__).resolve().parent))

# pylint: disable=wrong-import-position
from planner.events import Events
from veldt_bl.entry import own_arguments, reported_imports, run

with reported_imports():
    from planner.bake.baked import clip_of, read_plan, read_scene, read_sheet, read_track
    from veldt_bl.preview import pictures_of, render_pictures
    from veldt_bl.render import (
        first_missing,
        frame_file,
        render_frames,
        render_frames_and_actors,
        set_up_renderer,
    )
    from veldt_bl.scene import Stage, build_stage


def main(arguments: list[str]) -> int:
    """Run the command and return its exit code."""
    options = _parse(arguments)
    events = Events(options.events_fd)
    return run(lambda: _render(options, events), events)


def _parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="render_passes.py", description="Renders the passes of a plan's clips."
    )
    parser.add_argument("--plan", type=Path, required=True, help="the folder that plan_scene.py has written")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument(
        "--clip", action="extend", nargs="+", default=[], metavar="ID", help="the clips to render"
    )
    parser.add_argument("--supersample", type=int, default=1, help="rays along each side of a pixel")
    parser.add_argument("--actor-layer", action="store_true", help="also render the actors alone")
    parser.add_argument(
        "--preview", action="store_true", help="instead of passes: DIR/map.png and colour stills beside it"
    )
    parser.add_argument("--events-fd", type=int, help="write progress here, one JSON object a line")
    return parser.parse_args(arguments)


def _render(options: argparse.Namespace, events: Events) -> None:
    started_s = time.monotonic()
    clips = [clip_of(read_plan(options.plan), name) for name in options.clip]
    stage = build_stage(read_scene(options.plan / "scene"))
    events.report("scene_built", seconds=round(time.monotonic() - started_s, 3))
    if options.preview:
        _render_preview(stage, options.plan / "preview", options.out, events)
        return
    for clip in clips:
        _render_clip(stage, clip, options, events)


def _render_preview(stage: Stage, plan: Path, folder: Path, events: Events) -> None:
    """Write a map and stills, and report them as the frames of a clip `preview`."""
    pictures = pictures_of(stage, read_sheet(plan / "sheet"))
    events.report("clip", clip="preview", first_frame=0, frames=len(pictures))
    render_pictures(
        stage,
        read_track(plan / "moment", stage.scene),
        pictures,
        folder,
        lambda k: events.report("frame", clip="preview", index=k, file=pictures[k].file),
    )
    events.report("clip_done", clip="preview")


def _render_clip(stage: Stage, clip: dict, options: argparse.Namespace, events: Events) -> None:
    """Write the frames that a clip lacks."""
    name, frames, folder = clip["id"], clip["frames"], options.out / clip["id"]
    folder.mkdir(parents=True, exist_ok=True)
    first = first_missing(folder, frames)
    track = read_track(options.plan / "tracks" / name, stage.scene)
    events.report("clip", clip=name, first_frame=first, frames=frames)
    if first < frames:
        set_up_renderer(stage.scene.passes_of(track), options.supersample)
        stage.animate(track)
        left = range(first, frames)

        def on_frame(k: int) -> None:
            events.report("frame", clip=name, index=k, file=frame_file(k))

        if options.actor_layer:
            render_frames_and_actors(folder, left, stage, on_frame)
        else:
            render_frames(folder, left, stage.pose, on_frame)
    events.report("clip_done", clip=name)


if __name__ == "__main__":
    sys.exit(main(own_arguments()))
