"""Crowds of discs, and the starting points of groups."""

import numpy as np
import pytest

from planner.groups.collision_discs import HORIZON_S, TIMES_S, clear_until_s, cover, gather, nearest_m
from planner.groups.meetings import choose_start

STEP_S = TIMES_S[1] - TIMES_S[0]


@pytest.mark.parametrize("size_m", [(0.3, 0.3), (2.6, 1.1), (3.75, 1.2), (1.2, 0.35)])
def test_discs_cover_a_body_and_little_more(size_m):
    half_length_m, half_width_m = size_m
    discs = cover(half_length_m, half_width_m)
    x_m, y_m = np.meshgrid(
        np.linspace(-half_length_m, half_length_m, 41), np.linspace(-half_width_m, half_width_m, 21)
    )
    off_m = np.hypot(x_m[..., None] - discs.ahead_m, y_m[..., None]).min(axis=-1)
    assert off_m.max() <= discs.radius_m + 1e-9
    # A disc for a square of its own: its corners are 1.41 half widths away; squares may be up to 1.2 as long.
    assert discs.radius_m <= np.hypot(1.2, 1.0) * half_width_m + 1e-9


def _walker(x_m, y_m, speed_m_s, half_m=(0.3, 0.3)):
    """A crowd of one body that walks along x."""
    along_m = speed_m_s * TIMES_S
    point = np.column_stack([x_m + along_m, np.full(len(along_m), y_m)])
    return gather([(cover(*half_m), point, np.tile([1.0, 0.0], (len(along_m), 1)))])


def _stone(x_m, y_m, radius_m):
    return gather([(cover(radius_m, radius_m), np.array([[x_m, y_m]]), np.array([[1.0, 0.0]]))])


def test_the_nearest_approach_of_a_walker_and_a_stone():
    stone = _stone(200.0, 5.0, 1.0)
    # cover() of a square is its circumscribed disc.
    expected_m = 5.0 - np.sqrt(2.0) * (0.3 + 1.0)
    assert nearest_m(_walker(0, 0, 1.0), stone) == pytest.approx(expected_m)
    assert nearest_m(stone, _walker(0, 0, 1.0)) == pytest.approx(expected_m)
    assert nearest_m(_walker(0, 0, 1.0), stone, 2.0) == 2.0


def test_what_happens_between_two_moments_counts():
    # A lorry at 21 m/s moves 10.5 m a step; between two moments it passes just through the stone.
    lorry, stone = _walker(-5.25, 0.0, 21.0), _stone(100 * 10.5, 0.0, 1.0)
    assert nearest_m(lorry, stone) > 2.0
    assert clear_until_s(lorry, stone, 0.5) == pytest.approx(50.0, abs=0.5)


@pytest.mark.parametrize("gap_m, clear", [(3.1, True), (3.3, False)])
def test_walkers_side_by_side_keep_clear(gap_m, clear):
    # 4 m between their middles, less two radii of 0.424 m; both move alike, but the bound
    # allows for half a step at 2 x 0.01 m/s, 5 mm.
    one, other = _walker(0, 0, 0.01), _walker(0, 4.0, 0.01)
    assert (clear_until_s(one, other, gap_m) == HORIZON_S) == clear


def _runner(start_m):
    """A runner around a square of side 100 m at 1 m/s, with its first side on x."""
    corner = (start_m + TIMES_S) % 400.0
    side, along = np.divmod(corner, 100.0)
    heading = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]], float)[side.astype(int)]
    start = np.array([[0, 0], [100, 0], [100, 100], [0, 100]], float)[side.astype(int)]
    return gather([(cover(0.3, 0.3), start + along[:, None] * heading, heading)])


def test_a_start_keeps_clear_of_others():
    chasing = _runner(37.0)
    start_m = choose_start(400.0, _runner, [chasing], [], 0.0, 3, "group")
    assert clear_until_s(_runner(start_m), chasing, 0.5) == HORIZON_S
    assert start_m == choose_start(400.0, _runner, [chasing], [], 0.0, 3, "group")
    assert start_m != choose_start(400.0, _runner, [chasing], [], 0.0, 4, "group")


def test_a_start_brings_groups_together():
    chasing = _runner(37.0)
    for seed in range(5):
        start_m = choose_start(400.0, _runner, [chasing], [chasing], 12.0, seed, "group")
        assert nearest_m(_runner(start_m), chasing) <= 12.0


def test_where_no_start_is_clear_for_ever_the_one_clear_longest_is_taken():
    # A stone on the path is met once a round; a walker that begins just past it is clear for nearly all of the 400 s.
    stone = _stone(50.0, 0.0, 2.0)
    start_m = choose_start(400.0, _runner, [stone], [], 0.0, 3, "group")
    assert 52.0 < start_m < 52.0 + 2 * 400.0 / 96
    assert clear_until_s(_runner(start_m), stone, 0.5) > 380.0


def test_groups_that_cannot_meet_have_no_start():
    assert choose_start(400.0, _runner, [], [_stone(500.0, 0.0, 2.0)], 40.0, 3, "group") is None
