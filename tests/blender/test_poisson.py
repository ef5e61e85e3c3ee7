"""Poisson points: density, spacing, and independence of the size of the place."""

import numpy as np
import pytest

from planner.geometry.neighbours import pairs_within
from planner.geometry.poisson import poisson_points

SIZE_M, SPACING_M = 400.0, 2.0


def _points(filled: float, size_m: float = SIZE_M, seed: int = 3):
    """Points for which discs of the spacing would fill this share of the plane."""
    per_m2 = filled / (np.pi * SPACING_M**2)
    return poisson_points(
        seed, "trees", size_m, SPACING_M, 1.1 * per_m2, lambda x_m, _: np.full(len(x_m), per_m2)
    )[1]


# 4 (filled 0.3) to 6 thousand points (0.5) that keep apart have at most Poisson's stddev of 1.6 %: 3 % is two of these
# over the 2 % that cells add. Where discs fill more than 0.6 / 1.1 the spacing gives way, and not the density.
@pytest.mark.parametrize("filled", [0.05, 0.3, 0.5, 0.9])
def test_density_is_the_one_asked_for(filled):
    expected = filled / (np.pi * SPACING_M**2) * SIZE_M**2
    tolerance = 0.02 + 2.0 / np.sqrt(expected)
    assert len(_points(filled)) == pytest.approx(expected, rel=tolerance)


def test_density_follows_the_place():
    x_m = poisson_points(5, "trees", SIZE_M, SPACING_M, 0.03, lambda x, _: np.where(x > 0, 0.03, 0.01))[1][
        :, 0
    ]
    half_m2 = 0.5 * SIZE_M**2
    # 2400 and 800 points: stddev at most 2 % and 3.5 %; and 2 % of the cells.
    assert (x_m > 0).sum() == pytest.approx(0.03 * half_m2, rel=0.06)
    assert (x_m < 0).sum() == pytest.approx(0.01 * half_m2, rel=0.09)


def test_points_keep_apart():
    points_m = _points(0.5)
    one, other = pairs_within(points_m, points_m, SPACING_M)
    assert np.array_equal(one, other)  # none is near any but itself
    assert len(pairs_within(points_m, points_m, 1.1 * SPACING_M)[0]) > len(points_m)


def test_points_do_not_depend_on_how_far_the_place_reaches():
    small, large = _points(0.5, 200.0), _points(0.5, 400.0)
    inner = large[(np.abs(large) < 100.0).all(axis=1)]
    assert {tuple(point) for point in small} == {tuple(point) for point in inner}


def test_seeds_differ():
    assert {tuple(p) for p in _points(0.3)}.isdisjoint({tuple(p) for p in _points(0.3, seed=4)})
