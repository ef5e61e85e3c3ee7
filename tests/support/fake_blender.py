"""A stand-in for Blender: takes its command line, writes made-up passes, and reports them as render_passes.py does.

With it `generate` can be tested without Blender, quickly, and under sanitizers. It can block or crash after any given
frame, so that a test can kill a run at a chosen moment.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import sys
import time
from pathlib import Path

import numpy as np

import passes
from processes import HELD_S
from program import Ended, Veldt
from raw_exr import write_exr

# Orders lie beside the program: its environment is not that of the test.
_HOLDS, _DIES = "blender_holds_after.txt", "blender_dies_after.txt"


def install(folder: Path) -> Path:
    """Write a program that runs this file, and return its path."""
    program = folder / "fake_blender"
    program.write_text(
        f'#!/bin/sh\nexec "{sys.executable}" -B "{__file__}" "{folder}" "$@"\n', encoding="utf-8"
    )
    program.chmod(0o755)
    return program


def generate(veldt: Veldt, blender: Path, *options, out="out", **how) -> Ended:
    """Run `veldt generate config.json` with this stand-in."""
    return veldt("generate", "config.json", "--out", out, "--blender", blender, *options, **how)


def hold_after(folder: Path, clip: str, frame: int) -> None:
    """Has the program of `folder` stop, once, after a frame of a clip; -1 is before the first."""
    (folder / _HOLDS).write_text(f"{clip} {frame}", encoding="utf-8")


def is_held(folder: Path) -> bool:
    """Whether the program of `folder` has stopped as hold_after() ordered."""
    return not (folder / _HOLDS).exists()


def die_after(folder: Path, clip: str, frame: int, times: int = 1) -> None:
    """Makes the program of `folder` crash after a frame of a clip, as if out of memory.

    Frame -1 is before the first, clip `scene` the moment before the scene is built. If it is to die more than once,
    it does so after the next frame it renders.
    """
    (folder / _DIES).write_text(f"{clip} {frame} {times}", encoding="utf-8")


def _main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--plan", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--clip", action="append", default=[])
    parser.add_argument("--supersample", type=int)
    parser.add_argument("--actor-layer", action="store_true")
    parser.add_argument("--preview", action="store_true")
    parser.add_argument("--events-fd", type=int, required=True)
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    plan = json.loads((options.plan / "plan.json").read_text())
    clips = {clip["id"]: clip for clip in plan["clips"]}
    with open(options.events_fd, "w", encoding="utf-8", buffering=1) as events:
        _hold("scene", -1)
        print(json.dumps({"event": "scene_built", "seconds": 0}), file=events)
        if options.preview:
            _preview(options.out, events)
        for clip in options.clip:
            _render(options, clips[clip], events)


def _render(options: argparse.Namespace, planned: dict, events) -> None:
    clip, frames = planned["id"], planned["frames"]
    folder = options.out / clip
    folder.mkdir(parents=True, exist_ok=True)
    scene = json.loads((options.plan / "scene.json").read_text())
    height, width = (
        options.supersample * (scene["camera"][side] + 2 * scene["view_margin_px"])
        for side in ("height_px", "width_px")
    )
    kinds = {passes.OBJECTS: passes.object_index}
    kinds |= {passes.ACTORS: passes.actor_index} if options.actor_layer else {}
    first = next(k for k in range(frames + 1) if not (folder / f"{k:06d}.exr").exists())
    print(json.dumps({"event": "clip", "clip": clip, "first_frame": first, "frames": frames}), file=events)
    _hold(clip, -1)
    for frame in range(first, frames):
        planes = {name: _stretched(index(frame), height, width) for name, index in kinds.items()}
        write_exr(folder / "part.exr", planes)
        os.replace(folder / "part.exr", folder / f"{frame:06d}.exr")
        print(json.dumps({"event": "frame", "clip": clip, "index": frame}), file=events)
        _hold(clip, frame)


def _stretched(plane: np.ndarray, height: int, width: int) -> np.ndarray:
    """The same picture in another size."""
    rows, columns = (np.arange(size) * own // size for size, own in zip((height, width), plane.shape))
    return plane[np.ix_(rows, columns)]


def _preview(folder: Path, events) -> None:
    print(json.dumps({"event": "clip", "clip": "preview", "first_frame": 0, "frames": 2}), file=events)
    for frame, name in enumerate(("overview.png", "map.png")):
        (folder / name).write_bytes(b"a picture")
        print(json.dumps({"event": "frame", "clip": "preview", "index": frame}), file=events)
        _hold("preview", frame)


def _hold(clip: str, frame: int) -> None:
    folder = Path(sys.argv[1])
    _die(folder, clip, frame)
    if _order(folder / _HOLDS) == f"{clip} {frame}":
        (folder / _HOLDS).unlink()
        time.sleep(HELD_S)


def _die(folder: Path, clip: str, frame: int) -> None:
    """Each death leaves a byte in a file, which counts them."""
    fatal_clip, first_frame, times = (_order(folder / _DIES) or "- 0 0").split()
    if clip != fatal_clip or frame < int(first_frame):
        return
    deaths = folder / "deaths.txt"
    if deaths.exists() and deaths.stat().st_size >= int(times):
        return
    with open(deaths, "ab") as file:
        file.write(b"x")
    os.kill(os.getpid(), signal.SIGKILL)


def _order(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except FileNotFoundError:
        return ""


if __name__ == "__main__":
    _main()
