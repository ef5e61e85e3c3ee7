"""The layer with actors alone, and actors outside the picture."""

import shutil

import numpy as np
import pytest

from rendering import PLANES, Run, render
from scenes import tiny
from planner import ids

pytestmark = pytest.mark.blender

LAYER = "Actors.IndexOB.X"
CLIPS = ("down", "side")


def _with_layer(config: dict) -> None:
    config["render"] = {"actor_layer": True}


@pytest.fixture(scope="module", name="layered")
def _layered(tmp_path_factory) -> Run:
    run = render(tmp_path_factory.mktemp("layered"), tiny(_with_layer))
    assert run.code == 0, run.log
    return run


def test_the_layer_changes_nothing_else(full, layered):
    for clip in CLIPS:
        for frame in range(3):
            plain, more = full.planes(clip, frame), layered.planes(clip, frame)
            assert set(more) == {*PLANES, LAYER}
            assert all(np.array_equal(plain[name], more[name]) for name in PLANES)
    assert [event["event"] for event in layered.events] == [event["event"] for event in full.events]


def _thicket(config: dict) -> None:
    """A low view through trees."""
    config["scene"]["plants"] = {"acacia": {"per_ha": 400}}
    config["clips"] = [config["clips"][1]]
    config["clips"][0]["flight"] = config["clips"][0]["flight"] | {"look_angle_deg": 15}


def test_the_layer_shows_actors_whole(tmp_path):
    """Actors behind trees look as in a place without trees."""

    def bare(config: dict) -> None:
        _thicket(config)
        config["scene"]["plants"] = {}

    def layered(config: dict) -> None:
        _thicket(config)
        _with_layer(config)

    runs = [render(tmp_path / "bare", tiny(bare), threads=1), render(tmp_path / "thicket", tiny(layered))]
    assert [run.code for run in runs] == [0, 0], runs[0].log + runs[1].log
    hidden = 0
    for frame in range(3):
        shown, planes = runs[0].planes("side", frame)[PLANES[0]], runs[1].planes("side", frame)
        alone, seen = planes[LAYER], planes[PLANES[0]]
        for index in (shown, seen):
            is_actor = index >= ids.FIRST_ACTOR
            assert is_actor.any() and np.array_equal(alone[is_actor], index[is_actor])
        assert set(np.unique(alone)) <= {0, *range(ids.FIRST_ACTOR, ids.FIRST_ACTOR + 10)}
        hidden += np.count_nonzero((alone > 0) & (seen < ids.FIRST_ACTOR))
    assert hidden > 20


def test_a_layered_clip_goes_on_where_it_stopped(layered, tmp_path):
    first = render(tmp_path, tiny(_with_layer), "--clip", "side", threads=1)
    (first.out / "side" / "000001.exr").unlink()
    again = render(tmp_path / "again", tiny(_with_layer), "--clip", "side", out=first.out)
    assert again.code == 0, again.log
    for frame in range(3):
        one, other = again.planes("side", frame), layered.planes("side", frame)
        assert all(np.array_equal(one[name], other[name]) for name in (*PLANES, LAYER))


def _leaving(config: dict) -> None:
    """A camera that flies back and forth over the place and passes its actors now and then."""
    config["scene"]["plants"] = {}
    flight = {"area_m": [-25, -25, 25, 25], "altitude_m": 30, "lane_spacing_m": 15, "speed_m_s": 8}
    clip = config["clips"][0]
    clip |= {"frames": 16, "frame_rate_hz": 0.4, "flight": clip["flight"] | flight}
    config["clips"] = [clip]


def test_actors_that_left_the_picture_are_not_seen(tmp_path):
    """Frames rendered in sequence, in which actors come and go, equal those rendered on their own."""
    whole = render(tmp_path / "whole", tiny(_leaving))
    assert whole.code == 0, whole.log
    counts = [np.count_nonzero(whole.planes("down", k)[PLANES[0]] >= ids.FIRST_ACTOR) for k in range(16)]
    assert 0 in counts and max(counts) > 0
    out = tmp_path / "whole" / "out"
    for start in range(2, 16, 3):
        one = tmp_path / str(start)
        shutil.copytree(out, one / "out")
        for k in range(start, 16):
            (one / "out" / "down" / f"{k:06d}.exr").unlink()
        again = render(one, tiny(_leaving))
        assert again.code == 0, again.log
        for k in range(start, 16):
            first, other = again.planes("down", k), whole.planes("down", k)
            assert all(np.array_equal(first[name], other[name]) for name in PLANES)
