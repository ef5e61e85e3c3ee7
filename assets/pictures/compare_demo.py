"""What there is to look at in build/demo, for `./run demo`: also one clip by the published model and, if the demo is
as its config has it, passes by Blender beside those of the ray caster.

    python3 assets/pictures/compare_demo.py [ARGS of veldt generate…]
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))

from pictures import read_planes  # pylint: disable=wrong-import-position

CONFIG = "configs/demo.json"
DEMO = Path("build/demo")
ENGINES = ("blender", "embree")


def veldt(*arguments: object, **how) -> None:
    """Run the program, or end as it ends."""
    done = subprocess.run(["build/release/bin/veldt", *map(str, arguments)], check=False, **how)
    if done.returncode:
        sys.exit(done.returncode)


def say(path: object, what: str) -> None:
    """One line of the list."""
    print(f"  {path!s:52} {what}", flush=True)


def list_pictures() -> None:
    """What the dataset has."""
    print("\nLook at")
    for clip in sorted((DEMO / "clips").glob("*/")):
        say(f"{clip}/ir8/", f"{len(list(clip.glob('ir8/*.png')))} frames, 8-bit")
        say(clip / "preview.mp4", "the same frames as a video")
    say(DEMO / "annotations.json", "boxes and masks of every actor (COCO)")


def compare_models(arguments: list[str]) -> None:
    """One clip of the demo once more, by the published model, next to the physical one."""
    clip, published, video = "summer_follow_61m", "build/demo_published", "build/demo.mp4"
    if not (DEMO / "clips" / clip).is_dir():
        return
    preset = ("--clips", clip, "--set", "sensor.preset=airsim_w")
    veldt("generate", CONFIG, "--out", published, *arguments, *preset)
    marks = ("--palette", "ironbow", "--boxes", "--scale", "--side-by-side", published)
    veldt("video", DEMO / "clips" / clip, "--out", video, *marks)
    say(video, "the physical and the published model, side by side")


def indices(file: Path) -> np.ndarray:
    """Objects and materials (2, height, width) of a frame's passes."""
    planes = read_planes(file)
    return np.array([planes[f"Scene.Index{of}.X"] for of in ("OB", "MA")])


def compare_engines() -> None:
    """The start of the demo's first clip by Blender, which leaves its passes, and where the ray caster's differ.

    One plan serves both; less land around the flight, and one ray per pixel, because 16 would take Blender 4 s a frame.
    """
    clip, passes = "winter_zigzag_61m", Path("build/demo_passes")
    shutil.rmtree(passes, ignore_errors=True)
    shown = DEMO / "passes" / clip
    less = "--set scene.terrain.size_m=600 clips[0].frames=8 clips[1].frames=1 render.supersample=1".split()
    veldt("plan", CONFIG, "--out", passes / "blender/plan", *less, "--quiet", stdout=subprocess.DEVNULL)
    shutil.copytree(passes / "blender/plan", passes / "embree/plan", copy_function=os.link)
    for engine in ENGINES:
        veldt("render", CONFIG, "--out", passes / engine, "--clips", clip, "--engine", engine, *less)
    blender, embree = (passes / engine / "passes" / clip for engine in ENGINES)
    pairs = [(indices(file), indices(embree / file.name)) for file in sorted(blender.glob("*.exr"))]
    frames = [(one != other).any(axis=0) for one, other in pairs]
    differing = [int(frame.sum()) for frame in frames]
    shutil.rmtree(shown.parent, ignore_errors=True)
    shutil.move(blender.parent, shown.parent)
    shutil.rmtree(passes)
    say(f"{shown}/", "passes by Blender, one ray per pixel (EXR)")
    print(
        f"  Where the ray caster shows another object or material: {max(differing)} of {frames[0].size} pixels"
        f" of a frame at most, {sum(differing)} in all {len(frames)} frames"
    )


if __name__ == "__main__":
    list_pictures()
    compare_models(sys.argv[1:])
    if not sys.argv[1:]:
        compare_engines()
