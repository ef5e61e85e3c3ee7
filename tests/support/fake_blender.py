"""Stands in for Blender: takes its command line, delivers made-up passes, and tells of them as render_passes.py does.

With it `generate` can be tested where there is no Blender, in no time, and under sanitizers; and it stops for good
after any frame it is told to, so that a run can be killed at a moment of the test's choosing, or dies there itself.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import sys
import time
from pathlib import Path

import passes
from pictures import write_exr


def install(folder: Path) -> Path:
    """Writes a program that runs this file, and returns its path."""
    program = folder / "fake_blender"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -B "{__file__}" "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    return program


def hold_after(clip: str, frame: int) -> dict:
    """Environment in which it stops after a frame of a clip; frame -1 is the manifest."""
    return {"FAKE_BLENDER_HOLDS_AFTER": f"{clip} {frame}"}


def die_after(folder: Path, clip: str, frame: int, times: int = 1) -> dict:
    """Environment in which it dies after a frame of a clip, as if out of memory.

    Frame -1 is the manifest, clip `scene` the moment before the scene is built. If it is to die more often than once,
    it does so after the next frame it renders.
    """
    return {
        "FAKE_BLENDER_DIES_AFTER": f"{clip} {frame} {times}",
        "FAKE_BLENDER_DEATHS": str(folder / "deaths.txt"),
    }


def _main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--config", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--clip", action="append", default=[])
    parser.add_argument("--preview", action="store_true")
    parser.add_argument("--events-fd", type=int, required=True)
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    frames = {clip["id"]: clip["frames"] for clip in json.loads(options.config.read_text())["clips"]}
    with open(options.events_fd, "w", encoding="utf-8", buffering=1) as events:
        _hold("scene", -1)
        print(json.dumps({"event": "scene_built", "seconds": 0}), file=events)
        if options.preview:
            _preview(options.out, events)
        for clip in options.clip:
            _render(options.out / clip, clip, frames[clip], events)


def _render(folder: Path, clip: str, frames: int, events) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    passes.write_manifest(folder, passes.manifest(clip, frames))
    first = next(k for k in range(frames + 1) if not (folder / f"{k:06d}.exr").exists())
    print(json.dumps({"event": "clip", "clip": clip, "first_frame": first, "frames": frames}), file=events)
    _hold(clip, -1)
    for frame in range(first, frames):
        write_exr(folder / "part.exr", {passes.OBJECTS: passes.object_index(frame)})
        os.replace(folder / "part.exr", folder / f"{frame:06d}.exr")
        print(json.dumps({"event": "frame", "clip": clip, "index": frame}), file=events)
        _hold(clip, frame)


def _preview(folder: Path, events) -> None:
    print(json.dumps({"event": "clip", "clip": "preview", "first_frame": 0, "frames": 2}), file=events)
    for frame, name in enumerate(("overview.png", "map.png")):
        (folder / name).write_bytes(b"a picture")
        print(json.dumps({"event": "frame", "clip": "preview", "index": frame}), file=events)
        _hold("preview", frame)


def _hold(clip: str, frame: int) -> None:
    _die(clip, frame)
    if os.environ.get("FAKE_BLENDER_HOLDS_AFTER") == f"{clip} {frame}":
        time.sleep(60)


def _die(clip: str, frame: int) -> None:
    """Each death leaves a byte in a file, which counts them."""
    fatal_clip, first_frame, times = os.environ.get("FAKE_BLENDER_DIES_AFTER", "- 0 0").split()
    if clip != fatal_clip or frame < int(first_frame):
        return
    deaths = Path(os.environ["FAKE_BLENDER_DEATHS"])
    if deaths.exists() and deaths.stat().st_size >= int(times):
        return
    with open(deaths, "ab") as file:
        file.write(b"x")
    os.kill(os.getpid(), signal.SIGKILL)


if __name__ == "__main__":
    _main()
