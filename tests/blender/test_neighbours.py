"""Pairs of nearby points, checked against a brute-force search."""

import numpy as np

from planner.geometry.neighbours import pairs_within
from planner.noise import stream


def test_all_near_pairs_are_found_once():
    a_m = stream(1, "a").uniform(-20, 20, (300, 2))
    b_m = stream(1, "b").uniform(-20, 20, (200, 2))
    for radius_m in (0.7, 3.0, 50.0):
        i, j = pairs_within(a_m, b_m, radius_m)
        near = ((a_m[:, None] - b_m) ** 2).sum(axis=2) < radius_m**2
        assert len(i) == near.sum() and near[i, j].all()
        assert len(set(zip(i.tolist(), j.tolist()))) == len(i)


def test_a_point_is_near_itself():
    points_m = np.array([[0.0, 0.0], [-1e4, 1e4]])
    i, j = pairs_within(points_m, points_m, 1.0)
    assert sorted(zip(i.tolist(), j.tolist())) == [(0, 0), (1, 1)]


def test_no_points_have_no_pairs():
    i, j = pairs_within(np.zeros((0, 2)), np.ones((3, 2)), 1.0)
    assert len(i) == len(j) == 0
