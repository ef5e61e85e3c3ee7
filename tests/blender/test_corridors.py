"""Corridors are searched at once as each would be alone."""

import numpy as np
import pytest

from planner.land.corridors import Corridor, Corridors

RNG = np.random.default_rng(3)
WALKS = [
    Corridor(RNG.uniform(-20.0, 20.0, (count, 2)), half_width_m)
    for count, half_width_m in ((40, 0.3), (1, 2.0), (7, 1.1))
]
POINTS_M = RNG.uniform(-25.0, 25.0, (300, 2))


def _is_near(point_m, by_m):
    return any(np.hypot(*(walk.points_m - point_m).T).min() < by_m + walk.half_width_m for walk in WALKS)


@pytest.mark.parametrize("by_m", [0.0, 0.7, 4.0])
def test_each_corridor_has_its_own_width(by_m):
    walks, near = Corridors(WALKS), [_is_near(point_m, by_m) for point_m in POINTS_M]
    assert 0 < sum(near) < len(near)
    assert walks.taken(POINTS_M, by_m).tolist() == near
    assert [not walks.is_clear(point_m[None], by_m) for point_m in POINTS_M] == near


def test_points_are_clear_together():
    walks, near = Corridors(WALKS), Corridors(WALKS).taken(POINTS_M, 0.5)
    assert walks.is_clear(POINTS_M[~near], 0.5)
    assert not walks.is_clear(POINTS_M, 0.5)


def test_a_point_at_the_very_width_is_clear():
    walks = Corridors([Corridor(np.zeros((1, 2)), 0.5)])
    assert walks.is_clear(np.array([[1.0, 0.0]]), 0.5)
    assert not walks.is_clear(np.array([[1.0, 0.0]]), 0.5000001)


def test_without_corridors_all_is_clear():
    nothing = Corridors([])
    assert nothing.is_clear(POINTS_M, 5.0)
    assert not nothing.taken(POINTS_M, 5.0).any()
    assert not Corridors(WALKS).taken(np.zeros((0, 2)), 5.0).any()
