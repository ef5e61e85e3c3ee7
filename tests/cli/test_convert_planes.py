"""Depth and normals that no term can compute with are counted, named and, above a share, exit 3."""

import math

import numpy as np
import pytest

import passes
from pictures import write_exr

STRAIGHT_DOWN = [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 50, 0, 0, 0, 1]
PHYSICAL = ["--set", "sensor.model=physical"]
PHYSICAL += [
    word for term in ("variation", "sky", "angular", "path") for word in ("--set", f"terms.{term}=on")
]
SURFACES = (passes.HEIGHT - 2) * passes.WIDTH  # of a frame; two rows are sky


def _write_clip(folder, depth_m=(), normal=()):
    """Passes of one frame from 50 m above. `depth_m` and `normal` are put into surfaces, from the last pixel back; all
    of the sky is NaN."""
    folder.mkdir()
    document = passes.manifest(folder.name, 1)
    document["frames"][0] |= {"camera_to_world": STRAIGHT_DOWN, "agl_m": 50}
    depth = np.full((passes.HEIGHT, passes.WIDTH), 50.0)
    normals = np.zeros((3, passes.HEIGHT, passes.WIDTH))
    normals[2] = 1
    depth[:2] = normals[:, :2] = math.nan
    for k, value in enumerate(depth_m):
        depth.ravel()[-1 - k] = value
    for k, value in enumerate(normal):
        normals.reshape(3, -1)[:, -1 - k] = value
    planes = {passes.OBJECTS: passes.object_index(0), passes.DEPTH: depth}
    planes |= {f"Scene.Normal.{axis}": plane for axis, plane in zip("XYZ", normals)}
    write_exr(folder / "000000.exr", planes)
    passes.write_manifest(folder, document)


def _convert(veldt, *more):
    return veldt("convert", "one", "--out", "out", "--progress", "none", *PHYSICAL, *more)


def _shares(veldt):
    (clip,) = veldt.read("out/dataset.json")["clips"]
    return clip["unusable_depth_share"], clip["unusable_normal_share"]


def test_good_planes_are_counted_as_such_and_the_sky_is_not_looked_at(veldt):
    _write_clip(veldt.folder / "one")
    done = _convert(veldt)
    assert (done.code, done.err) == (0, "")
    assert _shares(veldt) == (0, 0)


def test_more_than_one_percent_is_named_and_exits_3(veldt):
    _write_clip(veldt.folder / "one", [math.nan] * (SURFACES // 4), [(math.nan, 0, 1)] * (SURFACES // 8))
    done = _convert(veldt)
    rule = "expected at most 0.01 (--max-unusable-share)\n"
    message = (
        f"veldt: clip one: unusable_depth_share = 0.25; {rule}"
        f"veldt: clip one: unusable_normal_share = 0.125; {rule}"
    )
    assert (done.code, done.err) == (3, message)
    assert done.out.startswith("out: 1 clip made, 1 frame\n")
    assert _shares(veldt) == (0.25, 0.125)
    again = _convert(veldt)  # a dataset that is there says the same
    assert (again.code, again.err) == (3, message)
    accepted = "at most 0.25 (--max-unusable-share) is accepted\n"
    accepting = _convert(veldt, "--max-unusable-share", "0.25")
    assert (accepting.code, accepting.err) == (
        0,
        f"veldt: warning: clip one: unusable_depth_share = 0.25, {accepted}"
        f"veldt: warning: clip one: unusable_normal_share = 0.125, {accepted}",
    )


def test_a_pixel_is_warned_of(veldt):
    _write_clip(veldt.folder / "one", [math.nan])
    done = _convert(veldt)
    assert (done.code, done.err) == (
        0,
        "veldt: warning: clip one: unusable_depth_share = 0.00298,"
        " at most 0.01 (--max-unusable-share) is accepted\n",
    )
    assert _shares(veldt) == (1 / SURFACES, 0)


def test_what_is_unusable(veldt):
    """Sky's depth on a surface, none, behind the camera, past any horizon; normals of no length, but not short ones."""
    depth_m = [math.nan, math.inf, -math.inf, 0, -3, 1e10, 1e-3, 9e4, 9e8]
    normal = [(0, 0, 0), (math.inf, 0, 0), (0, math.nan, 1), (0.1, 0, 0), (0, 0, -1)]
    _write_clip(veldt.folder / "one", depth_m, normal)
    assert _convert(veldt).code == 3
    assert _shares(veldt) == (7 / SURFACES, 3 / SURFACES)


def test_planes_that_no_term_reads_are_not_counted(veldt):
    _write_clip(veldt.folder / "one", [math.nan] * SURFACES)
    done = veldt("convert", "one", "--out", "out", "--progress", "none")  # the published model
    assert (done.code, done.err) == (0, "")
    assert not [key for key in veldt.read("out/dataset.json")["clips"][0] if key.startswith("unusable")]


@pytest.mark.parametrize("share", ["-0.1", "1.5", "nan"])
def test_shares_that_cannot_be_meant(veldt, share):
    _write_clip(veldt.folder / "one")
    done = _convert(veldt, "--max-unusable-share", share)
    assert (done.code, done.out) == (2, "")
    assert done.err == f"veldt: --max-unusable-share = {share}; expected from 0 to 1\n"
