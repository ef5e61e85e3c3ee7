"""The ground: size, relief, water, and heights that agree with the mesh."""

import numpy as np
import pytest

from scenes import tiny
from planner.land.terrain import build_terrain, slope_deg

FULL = {
    "size_m": 800,
    "cell_m": 4,
    "relief_m": 24,
    "hill_wavelength_m": 300,
    "water_radius_m": 40,
    "pan_radius_m": 0,
    "hollow_depth_m": 0,
    "gully_depth_m": 0,
    "craggy_fraction": 0,
    "crag_relief_m": 14,
}
WILD = FULL | {"pan_radius_m": 15, "hollow_depth_m": 1, "gully_depth_m": 1.6, "craggy_fraction": 0.1}


@pytest.fixture(scope="module", name="terrain")
def _terrain():
    return build_terrain(FULL, 3)


def _grid():
    axis = np.linspace(-400, 400, 201)
    return np.meshgrid(axis, axis)


def test_the_same_seed_makes_the_same_ground(terrain):
    assert np.array_equal(build_terrain(FULL, 3).heights_m, terrain.heights_m)
    assert not np.array_equal(build_terrain(FULL, 4).heights_m, terrain.heights_m)


def test_it_has_the_size_cells_and_relief_asked_for(terrain):
    assert terrain.heights_m.shape == (201, 201)
    assert terrain.cell_m == 4
    dry = build_terrain(FULL | {"water_radius_m": 0}, 3)
    assert np.ptp(dry.heights_m) == pytest.approx(24, rel=1e-12)  # a scaled span: a few roundings
    assert not dry.waters


def test_cells_are_stretched_to_fit():
    assert build_terrain(FULL | {"size_m": 100, "cell_m": 3}, 3).cell_m == pytest.approx(100 / 33)


def test_heights_meet_the_grid_and_are_planes_between(terrain):
    x, y = _grid()
    # Grid coordinates and cell shares round by some eps of 800 m, times slopes below 1.
    assert np.abs(terrain.height_m(x, y) - terrain.heights_m).max() < 1e-11
    middle = terrain.height_m(x[:-1, :-1] + 2, y[:-1, :-1] + 2)
    assert np.abs(middle - 0.5 * (terrain.heights_m[:-1, :-1] + terrain.heights_m[1:, 1:])).max() < 1e-11


def test_beyond_the_border_the_border_goes_on(terrain):
    assert terrain.height_m(1e4, 0.0) == terrain.height_m(400.0, 0.0)


def test_water_lies_in_the_middle_and_nowhere_else(terrain):
    x, y = _grid()
    ground, surface, shore = terrain.height_m(x, y), terrain.surface_m(x, y), terrain.shore_m(x, y)
    wet = surface > ground
    assert np.array_equal(surface[wet], np.full(wet.sum(), terrain.waters[0].level_m))
    assert terrain.surface_m(0.0, 0.0) == terrain.waters[0].level_m
    radius = np.sqrt(wet.sum() * 16 / np.pi)
    # The shore wanders by up to 45 % of the radius over about eight independent stretches.
    assert radius == pytest.approx(40, rel=0.45 / np.sqrt(8))
    # The rendered sheet is a disc: all the water is inside it, and no other ground in it is lower.
    disc = np.hypot(x, y) < terrain.waters[0].basin.disc_radius_m
    assert not (wet & ~disc).any()
    assert (ground[disc & (shore > 0)] > terrain.waters[0].level_m).all()


def test_water_is_within_its_shore(wild):
    x, y = _grid()
    for water in wild.waters:
        wet = water.basin.is_wet(x, y)
        assert wet.any() and np.array_equal(wet, water.basin.shore_m(x, y) < 0)
        assert water.basin.is_wet(*water.basin.centre_m) and not water.basin.is_wet(1e4, 0.0)


def test_the_ground_is_within_its_range(wild):
    low_m, high_m = wild.range_m
    height_m = wild.height_m(*_grid())
    assert (height_m.min(), height_m.max()) == pytest.approx((low_m, high_m), abs=1e-12)


def test_smoothed_ground_stays_within_the_ground(terrain):
    x, y = _grid()
    smooth = terrain.smooth_surface_m(x, y)
    surface = terrain.surface_m(x, y)
    assert surface.min() <= smooth.min() and smooth.max() <= surface.max()
    assert np.abs(np.diff(smooth, axis=1)).max() < 0.5 * np.abs(np.diff(surface, axis=1)).max()


def test_water_smaller_than_a_cell_does_no_harm():
    terrain = build_terrain(FULL | {"size_m": 150, "cell_m": 50, "water_radius_m": 2}, 3)
    assert np.isfinite(terrain.heights_m).all()


def test_a_place_without_relief_is_level():
    terrain = build_terrain(
        tiny(lambda c: c["scene"]["terrain"].update(relief_m=0, water_radius_m=0))["scene"]["terrain"], 1
    )
    assert not terrain.heights_m.any()


@pytest.fixture(scope="module", name="wild")
def _wild():
    return build_terrain(WILD, 3)


def test_the_pan_is_a_second_water_apart_from_the_first_and_off_the_crag(wild):
    hole, pan = wild.waters
    assert pan.basin.radius_m == 15 and np.hypot(*pan.basin.centre_m) > 5 * (15 + 40)
    x, y = _grid()
    wet = wild.surface_m(x, y) > wild.height_m(x, y)
    assert set(np.unique(wild.surface_m(x, y)[wet])) == {hole.level_m, pan.level_m}
    for water in wild.waters:
        near = np.hypot(x - water.basin.centre_m[0], y - water.basin.centre_m[1])
        disc = near < water.basin.disc_radius_m
        assert (wild.height_m(x, y)[disc & ~wet] > water.level_m).all()
        assert (wet & disc).any()
    assert wild.crag.share(*pan.basin.centre_m) == 0


def test_gullies_run_downhill_to_the_waters_and_the_border():
    flat, cut = (build_terrain(FULL | {"gully_depth_m": depth, "water_radius_m": 0}, 3) for depth in (0, 1.6))
    carved_m = flat.heights_m - cut.heights_m
    assert carved_m.min() >= -1e-9
    # Up to 1.6 m below where water stands; a hollow it has to leave adds what is cut through its rim.
    assert 1.2 < carved_m.max() < 1.6 + 2.5
    assert 0.005 < (carved_m > 0.2).mean() < 0.1


def test_hollows_are_shallow_and_few():
    flat, hollow = (
        build_terrain(FULL | {"hollow_depth_m": depth, "water_radius_m": 0}, 3) for depth in (0, 1)
    )
    deeper_m = flat.heights_m - hollow.heights_m
    assert deeper_m.min() > -1e-9 and 0.3 < deeper_m.max() <= 1.0
    assert 0.001 < (deeper_m > 0.1).mean() < 0.1


def test_the_crag_has_its_share_and_is_the_steep_part(wild):
    x, y = _grid()
    share = wild.crag.share(x, y)
    # Half in, half out at the threshold, which is a quantile of the grid.
    assert (share > 0.5).mean() == pytest.approx(0.1, abs=0.005)
    steep = slope_deg(wild, x, y)
    assert np.median(steep[share > 0.9]) > 3 * np.median(steep[share == 0])
    assert share[np.hypot(x, y) < 100].max() == 0
