"""The road: its course, and its height relative to the land."""

import numpy as np
import pytest

import configs
from resolved import resolve
from scenes import tiny
from planner.land.road_plan import plan_road
from planner.land.roads import TRACK_M
from planner.geometry.splines import self_crossing
from planner.land.terrain import build_terrain, slope_deg

ROAD = {"width_m": 3.8, "fork": True}


def _place(**changes):
    settings = (
        tiny()["scene"]["terrain"] | {"size_m": 700, "relief_m": 16, "hill_wavelength_m": 250} | changes
    )
    terrain = build_terrain(settings, 9)
    return terrain, terrain.with_road(plan_road(ROAD, terrain, 9))


@pytest.fixture(scope="module", name="places")
def _places():
    return _place()


def _across(road, at_m: float, offsets_m):
    """Points (n, 2) beside the loop's point at a distance along it."""
    point, heading = road.loop.at(at_m)
    return point + np.asarray(offsets_m)[:, None] * np.array([-heading[1], heading[0]])


def test_it_is_a_loop_with_a_fork_that_reaches_for_the_border(places):
    road = places[1].road
    assert road.loop.length_m > 2 * np.pi * 0.2 * 700
    assert self_crossing(road.loop.points_m(1.0)) is None
    ends = road.spur.points_m(1.0)[[0, -1]]
    assert np.linalg.norm(road.loop.points_m(0.5) - ends[0], axis=1).min() < 0.3
    assert np.abs(ends[1]).max() > 0.5 * 700 - 60


def test_it_lies_within_the_range_of_the_ground():
    _, terrain = _place(relief_m=0, water_radius_m=0)
    low_m, high_m = terrain.range_m
    offsets_m = np.linspace(-4, 4, 81)
    points_m = np.concatenate([_across(terrain.road, at_m, offsets_m) for at_m in np.linspace(0, 900, 200)])
    height_m = terrain.height_m(*points_m.T)
    assert height_m.min() < -0.15
    assert low_m - 1e-12 <= height_m.min() < low_m + 0.01 and height_m.max() <= high_m + 1e-12


def test_it_keeps_off_water_and_steep_ground(places):
    bare, terrain = places
    for line in terrain.road.lines:
        x_m, y_m = line.points_m(2.0).T
        assert bare.shore_m(x_m, y_m).min() > 20
        assert np.quantile(slope_deg(bare, x_m, y_m, 8.0), 0.98) < 14


def test_distances_are_to_its_border(places):
    road = places[1].road
    offsets_m = np.array([-3.9, -1.9, 0.0, 1.0, 1.9, 4.4])
    for at_m in (30.0, 200.0, 411.0):
        points = _across(road, at_m, offsets_m)
        # The loop is a chain of 2 m chords, which lie within 2 cm of it.
        assert road.distance_m(*points.T) == pytest.approx(np.abs(offsets_m) - 1.9, abs=0.02)
    assert road.distance_m(np.array([0.0]), np.array([0.0])) == np.inf
    assert road.distance_m(1e4, 0.0) == np.inf


def test_it_is_level_across_but_for_two_tracks(places):
    terrain = places[1]
    for at_m in np.arange(25.0, terrain.road.loop.length_m, 97.0):
        if np.linalg.norm(terrain.road.spur.points_m(2.0)[0] - terrain.road.loop.at(at_m)[0]) < 15:
            continue
        across = lambda *offsets_m: terrain.height_m(*_across(terrain.road, at_m, offsets_m).T)  # noqa: E731
        flat = across(-1.85, -1.4, 0.0, 1.4, 1.85)
        tracks = across(-TRACK_M, TRACK_M)
        # Along a curve the bed of the inner and the outer side belong to places some decimetres apart, on a slope.
        assert np.ptp(flat) < 0.03
        assert flat.mean() - tracks == pytest.approx([0.05, 0.05], abs=0.02)


def test_it_is_cut_into_the_land_and_the_land_is_left_beside_it(places):
    bare, terrain = places
    x_m, y_m = (grid.ravel() for grid in np.meshgrid(*[np.arange(-345.0, 345.0, 1.5)] * 2))
    change_m = terrain.height_m(x_m, y_m) - bare.height_m(x_m, y_m)
    beside = terrain.road_m(x_m, y_m) > 2.5
    assert not change_m[beside].any()
    assert -1.5 < change_m.min() < -0.1 and change_m.max() < 1.5
    on_road = terrain.road_m(x_m, y_m) < 0
    assert change_m[on_road].mean() < -0.05


def test_wheels_meet_no_step(places):
    terrain = places[1]
    for line in terrain.road.lines:
        x_m, y_m = line.points_m(0.2).T
        grade = np.diff(terrain.height_m(x_m, y_m)) / 0.2
        assert np.abs(grade).max() < 0.3
        assert np.abs(np.diff(grade)).max() < 0.1


def test_there_may_be_no_road():
    terrain, _ = _place()
    assert plan_road(ROAD | {"width_m": 0}, terrain, 9) is None
    small = build_terrain(tiny()["scene"]["terrain"] | {"size_m": 60, "water_radius_m": 12}, 9)
    assert plan_road(ROAD, small, 9) is None


def test_a_given_road_follows_its_corners():
    terrain, _ = _place()
    corners = [[200, -80], [200, 90], [-60, 180], [-150, 20]]
    road = plan_road(ROAD | {"points_m": corners, "fork": False}, terrain, 9)
    assert road.spur is None
    assert np.abs(road.distance_m(*np.array(corners, float).T) + 1.9).max() < 0.02


@pytest.mark.parametrize("seed", range(1, 9))
def test_a_whole_place_has_a_road_whatever_its_seed(seed):
    settings = resolve(configs.LEAST | {"scene": {"terrain": {"cell_m": 8}}})["scene"]["terrain"]
    road = plan_road(settings["road"], build_terrain(settings, seed), seed)
    assert road.loop.length_m > 2000 and road.spur is not None


def test_both_ways_of_the_fork_pass_into_each_other(places):
    terrain = places[1]
    joint = terrain.road.spur.points_m(1.0)[0]
    x_m, y_m = np.meshgrid(*(centre + np.arange(-25.0, 25.0, 0.1) for centre in joint))
    height = terrain.height_m(x_m, y_m)
    on_road = terrain.road_m(x_m, y_m) < 0
    # A track's side falls by 0.05 m x exp(-1/2) / 0.2 m = 0.15 at most; the land is less steep than that here.
    for axis in (0, 1):
        step = np.abs(np.diff(height, axis=axis))
        both = np.logical_and.reduce([np.roll(on_road, -k, axis=axis) for k in (0, 1)])
        assert step[both[:-1] if axis == 0 else both[:, :-1]].max() < 0.1 * (0.15 + 0.15)
