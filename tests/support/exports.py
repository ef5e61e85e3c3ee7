"""A dataset of three clips, and exports of it."""

from pathlib import Path

import numpy as np

import passes
from pictures import write_exr
from program import Veldt

CLIPS = ("one", "two", "three")


def with_three_clips(folder: Path) -> Veldt:
    """A folder with a dataset of three clips, in `data`; the last frame of `three` is empty."""
    veldt = Veldt(folder)
    clips = [passes.write_clip(veldt.folder / clip, clip) for clip in CLIPS]
    ground = np.full((passes.HEIGHT, passes.WIDTH), passes.GROUND, np.float32)
    write_exr(clips[2] / f"{passes.FRAMES - 1:06d}.exr", {passes.OBJECTS: ground, passes.DEPTH: ground * 40})
    done = veldt("convert", *clips, "--out", "data", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt


def export(veldt: Veldt, out, *options, source="data"):
    """What the command did."""
    return veldt("export", source, "--out", out, "--progress", "none", *options)


def export_whole(veldt: Veldt, out, *options, source="data") -> Path:
    """The folder of an export that succeeds."""
    done = export(veldt, out, *options, "--quiet", source=source)
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt.folder / out
