"""Culverts and bridges: where the road crosses gullies on a bank."""

from functools import lru_cache

import numpy as np

from scenes import tiny
from planner import assets
from planner.geometry.rotations import heading_of
from planner.land.road_plan import plan_road
from planner.land.terrain import build_terrain
from planner.land.corridors import Corridor, Corridors
from planner.sites.crossings import plan_crossings

ANGLES = np.linspace(0, 2 * np.pi, 12, endpoint=False)
LOOP_M = (350 * np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])).tolist()
DEEP = {"size_m": 1200, "cell_m": 3, "relief_m": 20, "gully_depth_m": 6}


@lru_cache(maxsize=None)
def _terrain(width_m=3.8):
    road = {"width_m": width_m, "points_m": LOOP_M, "fork": False}
    config = tiny(lambda c: c["scene"]["terrain"].update(DEEP | {"road": road}))
    settings, seed = config["scene"]["terrain"], config["seed"]
    terrain = build_terrain(settings, seed)
    return terrain.with_road(plan_road(settings["road"], terrain, seed))


def _bank_m(terrain, thing):
    line = np.concatenate(terrain.road.points_m)
    point = np.linalg.norm(line - thing.point_m, axis=1).argmin()
    bed_m = np.concatenate(terrain.road.bed_m)[point]
    return bed_m - terrain.with_road(None).height_m(*line[point][:, None])[0]


def test_a_high_bank_has_a_bridge_and_a_low_one_a_culvert():
    terrain = _terrain()
    things = plan_crossings(terrain, Corridors())
    assert {thing.name for thing in things} == {"bridge", "culvert"}
    for thing in things:
        assert terrain.road_m(*thing.point_m[:, None])[0] < -1.8  # the middle of the road
        assert (_bank_m(terrain, thing) >= 1.0) == (thing.name == "bridge")
        assert _bank_m(terrain, thing) >= 0.4


def test_crossings_are_40_m_apart():
    points = np.array([thing.point_m for thing in plan_crossings(_terrain(), Corridors())])
    apart = np.linalg.norm(points[:, None] - points, axis=2)
    assert apart[~np.eye(len(points), dtype=bool)].min() >= 40


def test_walls_stand_beside_the_road_whatever_its_width():
    for width_m in (3.8, 6.0):
        terrain = _terrain(width_m)
        for thing in plan_crossings(terrain, Corridors()):
            shapes = assets.load("structures", thing.name)["shapes"]
            aside_m = {abs(shape["y_m"]) for shape in shapes}
            for side in (-1, 1):
                left = side * heading_of(thing.yaw_rad + 0.5 * np.pi)
                wall_m = thing.point_m + thing.scale * min(aside_m) * left
                assert 0 < terrain.road_m(*wall_m[:, None])[0] < 1


def test_no_wall_stands_in_walkers_way():
    terrain = _terrain()
    first = plan_crossings(terrain, Corridors())[0]
    across = np.linspace(-6, 6, 25)[:, None] * heading_of(first.yaw_rad + 0.5 * np.pi)
    kept = plan_crossings(terrain, Corridors([Corridor(first.point_m + across, 0.3)]))
    assert min(np.linalg.norm(thing.point_m - first.point_m) for thing in kept) > 2
    along = np.linspace(-6, 6, 25)[:, None] * heading_of(first.yaw_rad)
    kept = plan_crossings(terrain, Corridors([Corridor(first.point_m + along, 0.3)]))
    assert any((thing.point_m == first.point_m).all() for thing in kept)


def test_without_a_road_nothing_is_crossed():
    assert not plan_crossings(_terrain().with_road(None), Corridors())
