"""Open, mid and dense areas of a place."""

import numpy as np
import pytest

from scenes import tiny
from planner.plants.density import plan_density
from planner.land.terrain import build_terrain

SIZE_M = 1609.0
SETTINGS = tiny()["scene"]["terrain"] | {"size_m": SIZE_M, "cell_m": 15, "area_wavelength_m": 500}
GRID_M = ((np.arange(160) + 0.5) / 160 - 0.5) * SIZE_M
X_M, Y_M = (grid.ravel() for grid in np.meshgrid(GRID_M, GRID_M))


def _shares(seed=3, **changes):
    settings = SETTINGS | changes
    return plan_density(build_terrain(settings, seed), settings, seed).shares(X_M, Y_M)


def test_shares_are_shares():
    shares = _shares()
    assert shares.shape == (len(X_M), 3)
    assert shares.min() >= 0
    assert shares.sum(axis=1) == pytest.approx(np.ones(len(X_M)), abs=1e-12)


# Thresholds are thirds of the place, and borders are soft alike on both sides but for the curve of the lushness.
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_each_area_is_a_third_of_the_place(seed):
    assert _shares(seed).mean(axis=0) == pytest.approx([1 / 3] * 3, abs=0.02)


def test_most_places_are_of_one_area_and_borders_are_soft():
    shares = _shares()
    assert (shares.max(axis=1) == 1).mean() > 0.6
    steps = np.abs(np.diff(shares[:, 2].reshape(160, 160), axis=1))  # over 10 m
    assert np.median(steps[steps > 0]) < 0.25  # borders are forty metres wide and more, here and there less


def test_low_ground_is_denser_than_high_ground():
    terrain = build_terrain(SETTINGS | {"relief_m": 80}, 3)
    dense = _shares(relief_m=80)[:, 2]
    height_m = terrain.smooth_surface_m(X_M, Y_M)
    low, high = np.quantile(height_m, [0.25, 0.75])
    assert dense[height_m < low].mean() > dense[height_m > high].mean() + 0.2


def test_areas_depend_on_the_seed_and_on_nothing_else():
    assert (_shares(3) == _shares(3)).all()
    assert np.abs(_shares(3) - _shares(4)).mean() > 0.1


def test_level_and_tiny_places_have_areas_too():
    assert _shares(relief_m=0).mean(axis=0) == pytest.approx([1 / 3] * 3, abs=0.02)
    small = _shares(size_m=20, cell_m=20)
    assert np.isfinite(small).all()
