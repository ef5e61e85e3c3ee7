"""Plants: how many, how far apart, and where none stand."""

import numpy as np
import pytest

from scenes import tiny
from veldt import assets
from veldt.placement import Corridor, place_plants
from veldt.splines import Loop
from veldt.terrain import build_terrain

TERRAIN = build_terrain(tiny()["scene"]["terrain"] | {"size_m": 1000, "cell_m": 5, "water_radius_m": 50}, 9)
LOOP = Loop([[150, 0], [0, 120], [-180, 0], [0, -150]])
CORRIDOR = Corridor(LOOP.at(np.arange(0, LOOP.length_m, 0.9))[0], 3.0)


def _place(name, per_ha, corridors=()):
    return place_plants(name, assets.load("plants", name), per_ha, TERRAIN, corridors, 9)


@pytest.mark.parametrize("name, per_ha", [("acacia", 12), ("shrub", 60)])
def test_density_is_the_one_asked_for(name, per_ha):
    count = len(_place(name, per_ha).scale)
    expected = per_ha * (1000**2 - np.pi * 50**2) / 1e4
    # 1 km^2 holds some 200 clumps of 70 m, whose richness (0.5, stddev about 0.25) averages out to
    # 0.25 / 0.5 / sqrt(200) = 3.5 %; three of these.
    assert count == pytest.approx(expected, rel=0.105)


def test_none_stand_in_water_or_near_a_walker():
    shrubs = _place("shrub", 60, [CORRIDOR])
    x, y, z = shrubs.points_m.T
    assert (TERRAIN.surface_m(x, y) == TERRAIN.height_m(x, y)).all()
    assert np.array_equal(z, TERRAIN.height_m(x, y))
    gap = np.linalg.norm(shrubs.points_m[:, None, :2] - CORRIDOR.points_m, axis=2).min()
    assert gap >= assets.load("plants", "shrub")["clearance_m"] + 3.0


def test_a_path_takes_plants_away_and_moves_none():
    everywhere = {tuple(p) for p in _place("shrub", 60).points_m}
    left = {tuple(p) for p in _place("shrub", 60, [CORRIDOR]).points_m}
    assert left < everywhere


def test_two_plants_keep_apart():
    points = _place("shrub", 60).points_m[:, :2]
    points = points[np.abs(points).max(axis=1) < 250]
    near = np.abs(points[:, None] - points).max(axis=2) + 1e9 * np.eye(len(points))
    cell_m = np.sqrt(1e4 * 0.45 / 60)
    assert near.min() >= 0.3 * cell_m * (1 - 1e-12)


def test_sizes_and_variants_keep_to_the_species():
    data = assets.load("plants", "acacia")
    acacias = _place("acacia", 12)
    low, high = data["scale_range"]
    assert low <= acacias.scale.min() and acacias.scale.max() < high
    assert set(acacias.variant) == set(range(data["variants"]))


def test_none_at_all():
    assert len(_place("acacia", 0).scale) == 0
