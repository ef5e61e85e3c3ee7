"""Heights that an aircraft can fly: within its limits, and as near to the wanted heights as possible."""

import json

import numpy as np
import pytest

from resolved import resolve
from planner.config import ROOT
from planner.flight.heights import follow_heights, look_ahead_s, nearest_heights
from planner.land.terrain import build_terrain

STEP_S, CLIMB_M_S, SPEED_M_S = 0.02, 5.0, 12.0


def _rough(moments: int, seed: int) -> np.ndarray:
    """Wanted heights with slopes and cliffs that cannot be flown."""
    rng = np.random.default_rng(seed)
    steps_m = rng.normal(0.0, 0.15, moments) + (rng.random(moments) < 0.002) * rng.normal(0.0, 15.0, moments)
    return 50.0 + np.cumsum(steps_m)


def _least_deviation(wanted: np.ndarray, most_change: int) -> float:
    """The least largest deviation of all profiles on a lattice of levels, by dynamic programming."""
    levels = np.arange(wanted.min(), wanted.max() + 0.25, 0.25)
    reachable = np.abs(levels[:, None] - levels) <= most_change
    best = np.abs(levels - wanted[0])
    for height in wanted[1:]:
        best = np.maximum(np.where(reachable, best, np.inf).min(axis=1), np.abs(levels - height))
    return float(best.min())


@pytest.fixture(scope="module", name="savanna")
def _savanna():
    text = (ROOT / "configs" / "savanna.json").read_text(encoding="utf-8")
    config = resolve(json.loads(text))
    return build_terrain(config["scene"]["terrain"], config["seed"])


def _tracks(terrain):
    """Places (n, 2) a step apart along straight lines over all of the terrain, in four directions."""
    along_m = np.arange(-0.5 * terrain.size_m, 0.5 * terrain.size_m, SPEED_M_S * STEP_S)
    for heading_rad in np.radians([0.0, 40.0, 90.0, 140.0]):
        forward = np.array([np.cos(heading_rad), np.sin(heading_rad)])
        for aside_m in np.arange(-600.0, 601.0, 120.0):
            points_m = along_m[:, None] * forward + aside_m * np.array([-forward[1], forward[0]])
            yield points_m[np.all(np.abs(points_m) < 0.5 * terrain.size_m, axis=1)]


def test_no_height_is_climbed_to_faster_than_the_limit():
    for seed in range(5):
        wanted_m = _rough(20_000, seed)
        assert np.abs(np.diff(wanted_m)).max() > 100 * CLIMB_M_S * STEP_S
        for heights_m in (
            nearest_heights(wanted_m, STEP_S, CLIMB_M_S),
            follow_heights(wanted_m, STEP_S, CLIMB_M_S),
        ):
            assert np.abs(np.diff(heights_m)).max() <= CLIMB_M_S * STEP_S + 1e-10


def test_no_profile_within_the_limit_is_nearer():
    rng = np.random.default_rng(1)
    for _ in range(200):
        wanted = rng.integers(0, 12, rng.integers(1, 15)).astype(float)
        most = int(rng.integers(1, 4))
        deviation = np.abs(nearest_heights(wanted, 1.0, most) - wanted).max()
        assert deviation == pytest.approx(_least_deviation(wanted, most), abs=1e-12)
        # Two wanted heights further apart than can be climbed between them: one is missed by half of what is left.
        apart = np.abs(np.arange(len(wanted))[:, None] - np.arange(len(wanted)))
        gap = np.abs(wanted[:, None] - wanted) - most * apart
        assert deviation == pytest.approx(0.5 * gap.max(), abs=1e-12)


def test_heights_that_can_be_flown_are_flown():
    time_s = STEP_S * np.arange(30_000)
    wanted_m = 60.0 + 80.0 * np.sin(0.05 * time_s)
    assert np.abs(nearest_heights(wanted_m, STEP_S, CLIMB_M_S) - wanted_m).max() < 1e-9
    # Averaged over 2 s, a sine loses (omega 1 s)^2 / 6; the ends go on level, which costs 4 m/s times 0.25 s.
    off_m = np.abs(follow_heights(wanted_m, STEP_S, CLIMB_M_S) - wanted_m)
    assert off_m[50:-50].max() < 1.05 * 80.0 * 0.05**2 / 6.0
    assert off_m.max() < 1.05


def test_level_flight_is_level_to_the_bit():
    assert set(follow_heights(np.full(5_000, 60.1), STEP_S, 0.7)) == {60.1}
    assert follow_heights(np.array([7.3]), STEP_S, 0.7).tolist() == [7.3]
    assert follow_heights(np.array([7.3, 7.3, 7.3]), 3.0, 0.7).tolist() == [7.3, 7.3, 7.3]


def test_climbs_begin_and_end_gently():
    for seed in range(5):
        wanted_m = _rough(20_000, seed)
        heights_m = follow_heights(wanted_m, STEP_S, CLIMB_M_S)
        # 2 s are 101 moments: speeds change by at most 2 x 5 m/s in that time.
        assert np.abs(np.diff(heights_m, 2)).max() / STEP_S**2 <= 2 * CLIMB_M_S / (101 * STEP_S) + 1e-6
        assert (
            np.abs(heights_m - nearest_heights(wanted_m, STEP_S, CLIMB_M_S)).max() <= 0.5 * CLIMB_M_S + 0.05
        )


def test_heights_are_means_of_two_seconds():
    wanted_m = _rough(1_234, 3)
    nearest_m = np.pad(nearest_heights(wanted_m, STEP_S, CLIMB_M_S), 50, mode="edge")
    means_m = np.convolve(nearest_m, np.full(101, 1 / 101), mode="valid")
    assert np.abs(follow_heights(wanted_m, STEP_S, CLIMB_M_S) - means_m).max() < 1e-10


def test_what_comes_after_the_look_ahead_changes_no_bit():
    wanted_m = _rough(40_000, 8)
    whole_m = follow_heights(wanted_m, STEP_S, CLIMB_M_S)
    ahead = int(np.ceil(look_ahead_s(float(np.ptp(wanted_m)), CLIMB_M_S) / STEP_S)) + 1
    for moments in (1, 777, 10_001, 20_000):
        part_m = follow_heights(wanted_m[: moments + ahead], STEP_S, CLIMB_M_S)
        assert np.array_equal(part_m[:moments], whole_m[:moments])


def test_the_look_ahead_is_no_longer_than_it_must_be():
    level_m = np.zeros(3_000)
    for rise_m in (40.0, -40.0):
        cliff_m = np.where(np.arange(3_000) < 2_000, 0.0, rise_m)
        ahead = look_ahead_s(40.0, CLIMB_M_S) / STEP_S
        first = int(np.argmax(follow_heights(cliff_m, STEP_S, CLIMB_M_S) != level_m))
        assert 0 <= first - (2_000 - ahead) <= 3


def test_over_the_savanna_three_metres_are_held_but_at_the_crag(savanna):
    """At the crag, no aircraft with a climb rate of 5 m/s can hold them."""
    off_the_crag_m, over_m, best_m = [], [], []
    for points_m in _tracks(savanna):
        wanted_m = savanna.surface_m(*points_m.T)
        off_m = np.abs(follow_heights(wanted_m, STEP_S, CLIMB_M_S) - wanted_m)
        is_crag = savanna.crag.share(*points_m.T) > 0
        is_near = np.convolve(is_crag, np.ones(401), mode="same") > 0  # within 4 s
        off_the_crag_m.append(off_m[~is_near].max(initial=0.0))
        over_m.append(off_m.max())
        best_m.append(np.abs(nearest_heights(wanted_m, STEP_S, CLIMB_M_S) - wanted_m).max())
    assert max(off_the_crag_m) < 1.5
    assert max(best_m) > 3.0  # smallest possible deviation at the crag's cliffs
    assert np.all(np.array(over_m) < np.array(best_m) + 0.5 * CLIMB_M_S)
