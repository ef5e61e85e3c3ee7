"""Flights cut into clips."""

import numpy as np
import pytest

from planner.cuts import clips_of, cut

FLIGHT = {
    "id": "flight",
    "season": "winter",
    "start_s": 5.0,
    "duration_s": 100,
    "frame_rate_hz": 10,
    "clip_length_s": 30,
    "keep": "all",
    "negatives": 0,
    "flight": {"pattern": "transect"},
}
FRAMES = 1000


def _seen(*stretches) -> np.ndarray:
    seen = np.zeros(FRAMES, bool)
    for begin, end in stretches:
        seen[begin:end] = True
    return seen


def _cut(seen, **changes):
    return cut(FLIGHT | changes, seen, 1)


def test_all_of_a_flight_is_cut_into_as_few_equal_clips_as_fit():
    assert _cut(_seen()) == [(0, 250), (250, 250), (500, 250), (750, 250)]
    assert _cut(_seen(), clip_length_s=100) == [(0, FRAMES)]
    assert [frames for _, frames in _cut(_seen(), clip_length_s=33)] == [250] * 4


def test_a_clip_is_never_longer_than_asked_for():
    for length_s in np.linspace(0.1, 100, 60):
        stretches = _cut(_seen(), clip_length_s=length_s)
        assert max(frames for _, frames in stretches) <= length_s * 10 + 1e-9
        assert sum(frames for _, frames in stretches) == FRAMES


def test_only_stretches_with_actors_are_kept():
    seen = _seen((100, 180), (400, 900))
    stretches = _cut(seen, keep="with_actors")
    assert stretches == [(100, 80), (400, 250), (650, 250)]


def test_a_gap_of_two_seconds_ends_no_clip_and_a_longer_one_does():
    assert _cut(_seen((100, 150), (170, 200)), keep="with_actors") == [(100, 100)]
    assert _cut(_seen((100, 150), (171, 200)), keep="with_actors") == [(100, 50), (171, 29)]


def test_empty_ends_are_no_gaps():
    assert _cut(_seen((10, 990)), keep="with_actors", clip_length_s=100) == [(10, 980)]


@pytest.mark.parametrize("share", [0.1, 0.25, 0.5])
def test_negatives_have_the_requested_share_and_show_no_actor(share):
    seen = _seen((100, 400))
    stretches = _cut(seen, keep="with_actors", negatives=share)
    frames = np.concatenate([np.arange(first, first + count) for first, count in stretches])
    assert len(frames) == len(set(frames.tolist()))
    assert seen[frames].sum() == 300
    assert (~seen[frames]).sum() == round(300 * share / (1 - share))


def test_there_are_no_more_negatives_than_empty_frames():
    stretches = _cut(_seen((100, 900)), keep="with_actors", negatives=0.9)
    assert sum(frames for _, frames in stretches) == FRAMES


def test_the_choice_of_negatives_depends_only_on_seed_and_flight():
    seen, asked = _seen((100, 130)), {"keep": "with_actors", "negatives": 0.5, "clip_length_s": 2}
    assert cut(FLIGHT | asked, seen, 1) == cut(FLIGHT | asked, seen, 1)
    assert cut(FLIGHT | asked, seen, 1) != cut(FLIGHT | asked, seen, 2)
    assert cut(FLIGHT | asked, seen, 1) != cut(FLIGHT | asked | {"id": "other"}, seen, 1)


def test_a_flight_without_actors_gives_no_clip():
    assert not _cut(_seen(), keep="with_actors", negatives=0.5)


def test_clips_have_the_format_of_a_config():
    assert clips_of(FLIGHT, [(0, 250), (250, 250)])[1] == {
        "id": "flight_0001",
        "start_s": 30.0,
        "frames": 250,
        "frame_rate_hz": 10,
        "of_flight": "flight",
        "flight": FLIGHT["flight"],
    }
