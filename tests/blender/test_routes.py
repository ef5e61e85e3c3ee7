"""Loops that are generated around a given centre."""

import numpy as np
import pytest

from planner.land.ways import plan_loop
from planner.geometry.splines import self_crossing


def _anywhere(x_m, _):
    return np.ones(len(x_m), bool)


def _off_pond(x_m, y_m):
    return np.hypot(x_m - 300.0, y_m) > 60.0


@pytest.mark.parametrize("seed", range(6))
def test_a_loop_goes_round_its_centre(seed):
    loop = plan_loop([100.0, -50.0], 200.0, 0.25, _anywhere, seed, "loop")
    points = loop.points_m(2.0)
    away_m = np.linalg.norm(points - [100.0, -50.0], axis=1)
    assert 0.7 * 200 < away_m.min() < 200 < away_m.max() < 1.3 * 200
    angle = np.unwrap(np.arctan2(points[:, 1] + 50, points[:, 0] - 100))
    assert angle[-1] - angle[0] == pytest.approx(2 * np.pi, abs=1e-6)
    assert self_crossing(points) is None


@pytest.mark.parametrize("seed", range(6))
def test_a_loop_keeps_off_bad_ground(seed):
    loop = plan_loop([100.0, 0.0], 200.0, 0.25, _off_pond, seed, "loop")
    assert _off_pond(*loop.points_m(1.0).T).mean() > 0.99
    free = plan_loop([100.0, 0.0], 200.0, 0.25, _anywhere, seed, "loop")
    assert not _off_pond(*free.points_m(1.0).T).all()


def test_there_may_be_no_loop():
    assert plan_loop([0.0, 0.0], 50.0, 0.25, lambda x, y: np.hypot(x, y) > 200.0, 1, "loop") is None


def test_names_and_seeds_differ():
    lengths = {plan_loop([0, 0], 90, 0.3, _anywhere, *key).length_m for key in ((1, "a"), (1, "b"), (2, "a"))}
    assert len(lengths) == 3
