"""Measure how long it takes to plan a config's place, and Blender to build and render it, with and without its plants.

    python3 tests/bench/measure_place.py [configs/savanna.json] [--frames 12]

Prints the seconds to plan, to build and to the first frame, the seconds per frame (without the first of each clip,
which builds BVHs), and peak memory. The plan is made by the built program.
"""

from __future__ import annotations

import argparse
import json
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

_ROOT = Path(__file__).resolve().parents[2]
_VELDT = _ROOT / "build" / "release" / "bin" / "veldt"


def measure(config: dict, folder: Path) -> dict:
    """Seconds to plan, to build and to the first frame, seconds of each frame of each clip, and the peak memory in MiB
    of any program so far."""
    (folder / "config.json").write_text(json.dumps(config), encoding="utf-8")
    started_s = time.monotonic()
    subprocess.run([_VELDT, "plan", folder / "config.json", "--out", folder / "plan", "--quiet"], check=True)
    begun_s = time.monotonic()
    built_s, first_s, clips, last_s = 0.0, 0.0, [], 0.0
    for event, at_s in _events(folder, [clip["id"] for clip in config["clips"]]):
        if event["event"] == "scene_built":
            built_s = event["seconds"]
        elif event["event"] == "clip":
            clips.append([])
        elif event["event"] == "frame":
            clips[-1].append(at_s - last_s)
            first_s = first_s or at_s - begun_s
        last_s = at_s
    peak_mib = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    seconds = {"planned_s": begun_s - started_s, "built_s": built_s, "first_s": first_s}
    return {**seconds, "clips_s": clips, "peak_mib": peak_mib}


def _events(folder: Path, clips: list[str]) -> Iterator[tuple[dict, float]]:
    """The events of Blender while it renders the plan in folder/plan, with their times."""
    command = ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "-t", "2"]
    command += ["--python", str(_ROOT / "blender_scripts" / "render_passes.py"), "--"]
    command += ["--plan", str(folder / "plan"), "--out", str(folder / "passes"), "--events-fd", "1"]
    command += ["--clip", *clips]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as blender:
        for line in blender.stdout:
            if line.startswith('{"event"'):
                yield json.loads(line), time.monotonic()
    if blender.returncode != 0:
        sys.exit(f"Blender ended with {blender.returncode}")


def _in_words(measured: dict) -> str:
    frames_s = [frame_s for clip in measured["clips_s"] for frame_s in clip[1:]]
    return (
        f"{measured['planned_s']:.1f} s to plan, {measured['built_s']:.1f} to build,"
        f" {measured['first_s']:.1f} to the first frame; {statistics.mean(frames_s):.2f} s a frame,"
        f" {min(frames_s):.2f} to"
        f" {max(frames_s):.2f}; {measured['peak_mib']:.0f} MiB at most"
    )


def main() -> None:
    """Measure the bare place first: memory is the peak of all runs so far."""
    parser = argparse.ArgumentParser(description="Measures building and rendering of a config's place.")
    parser.add_argument("config", type=Path, nargs="?", default=_ROOT / "configs" / "savanna.json")
    parser.add_argument("--frames", type=int, default=12, help="of each clip")
    options = parser.parse_args()
    config = json.loads(options.config.read_text(encoding="utf-8"))
    for clip in config["clips"]:
        clip["frames"] = options.frames
    bare = {**config, "scene": {**config["scene"], "plants": {}}}
    for name, place in (("without plants", bare), ("with plants", config)):
        with tempfile.TemporaryDirectory() as folder:
            print(f"{name}: {_in_words(measure(place, Path(folder)))}", flush=True)


if __name__ == "__main__":
    main()
