"""Placement of plants: density, spacing, and free areas."""

import itertools

import numpy as np
import pytest

import configs
from resolved import resolve
from scenes import tiny
from planner import assets
from planner.geometry.neighbours import pairs_within
from planner.land.corridors import Corridor, Corridors
from planner.plants.placement import AREAS, Site, by_area, place_plants, slope_deg
from planner.geometry.splines import Loop
from planner.land.terrain import build_terrain

SIZE_M = 1609.0
SEED = 9
SAVANNA = resolve(configs.LEAST)["scene"]["plants"]
LEVEL = build_terrain(
    tiny()["scene"]["terrain"] | {"size_m": SIZE_M, "cell_m": 20, "relief_m": 0, "water_radius_m": 0}, SEED
)
HILLY = build_terrain(
    tiny()["scene"]["terrain"]
    | {"size_m": 500, "cell_m": 4, "relief_m": 60, "hill_wavelength_m": 120, "water_radius_m": 50},
    SEED,
)
LOOP = Loop([[150, 0], [0, 120], [-180, 0], [0, -150]])
CORRIDOR = Corridor(LOOP.at(np.arange(0, LOOP.length_m, 0.9))[0], 3.0)
SHRUBS = {"shrub": {"per_ha": 60}}


def _strips(x_m, _):
    """Three areas side by side, from west to east."""
    return np.eye(AREAS)[_strip(x_m)]


def _strip(x_m):
    return np.clip(((x_m / SIZE_M + 0.5) * AREAS).astype(int), 0, AREAS - 1)


def _road_m(x_m, y_m):
    """A road four metres wide straight through the place."""
    return np.abs(0.6 * x_m - 0.8 * y_m - 20.0) - 2.0


@pytest.fixture(scope="module", name="savanna")
def _savanna():
    return place_plants(SAVANNA, Site(LEVEL, _strips), SEED)


def _in_strips(plantings, names):
    return sum(np.bincount(_strip(plantings[name].points_m[:, 0]), minlength=AREAS) for name in names)


# A third of the place has 863 trees where it is open: stddev 3.4 % if they stood quite at random, and patches and
# lattice cells add 2 % each. Mid and dense areas are well within the 10 % that all must keep.
def test_trees_and_shrubs_of_each_area_are_as_many_as_asked_for(savanna):
    area_ha = SIZE_M**2 / 1e4 / AREAS
    trees = _in_strips(savanna, ("acacia", "hookthorn", "baobab"))
    assert trees / area_ha == pytest.approx([10, 60, 300], rel=0.1)
    assert _in_strips(savanna, ("shrub",)) / area_ha == pytest.approx([20, 120, 600], rel=0.1)


@pytest.mark.parametrize("name", SAVANNA)
def test_each_species_is_as_dense_as_asked_for(savanna, name):
    expected = np.array(by_area(SAVANNA[name]["per_ha"])) * SIZE_M**2 / 1e4 / AREAS
    # 10 %, and three times the stddev of as many points quite at random.
    assert (np.abs(_in_strips(savanna, [name]) - expected) < 0.1 * expected + 3.0 * np.sqrt(expected)).all()


@pytest.mark.parametrize("name, least", [("acacia", 1.8), ("hookthorn", 1.8), ("shrub", 1.8)])
def test_plants_with_clumps_have_more_neighbours(name, least):
    """Than if they stood at random, where there is room; and species gather at the same places."""
    mix = {other: {"per_ha": 8} for other in {name, "hookthorn"}}
    plants = place_plants(mix, Site(LEVEL), SEED)
    points_m, others_m = plants[name].points_m[:, :2], plants["hookthorn"].points_m[:, :2]
    expected = len(points_m) * len(others_m) * np.pi * 10.0**2 / SIZE_M**2
    found = len(pairs_within(points_m, others_m, 10.0)[0]) - (name == "hookthorn") * len(points_m)
    assert found > least * expected


def test_one_number_is_for_all_areas():
    even = place_plants(SHRUBS, Site(LEVEL, _strips), SEED)["shrub"]
    # 15 534 shrubs: stddev 0.8 %, and the lattice's 2 %.
    assert len(even.scale) == pytest.approx(60 * SIZE_M**2 / 1e4, rel=0.04)


@pytest.mark.parametrize("one, other", itertools.combinations_with_replacement(sorted(SAVANNA), 2))
def test_plants_keep_apart(savanna, one, other):
    a, b = assets.load("plants", one), assets.load("plants", other)
    least_m = a["spacing_m"] if one == other else a["foot_m"] + b["foot_m"]
    points, others = savanna[one].points_m[:, :2], savanna[other].points_m[:, :2]
    i, j = pairs_within(points, others, least_m)
    assert len(i) == (len(points) if one == other else 0)
    assert one != other or np.array_equal(i, j)


@pytest.mark.parametrize("name", SAVANNA)
def test_none_stand_in_water_on_the_road_or_near_a_walker(name):
    data = assets.load("plants", name)
    per_ha = {"per_ha": 20 if name in ("baobab", "termite_mound") else 200}
    plants = place_plants({name: per_ha}, Site(HILLY, road_m=_road_m, corridors=Corridors([CORRIDOR])), SEED)[
        name
    ]
    x, y, z = plants.points_m.T
    assert len(x) > 50
    assert (HILLY.shore_m(x, y) > data["foot_m"]).all()
    assert np.array_equal(z, HILLY.surface_m(x, y)) and np.array_equal(z, HILLY.height_m(x, y))
    assert (_road_m(x, y) > data["foot_m"]).all()
    gap = np.linalg.norm(plants.points_m[:, None, :2] - CORRIDOR.points_m, axis=2).min()
    assert gap >= data["clearance_m"] + 3.0


def test_steep_slopes_bear_fewer_and_then_none():
    x, y, _ = place_plants({"acacia": {"per_ha": 60}}, Site(HILLY), SEED)["acacia"].points_m.T
    axis = np.linspace(-249, 249, 200)
    ground = np.array([grid.ravel() for grid in np.meshgrid(axis, axis)])
    gentle, steep = assets.load("plants", "acacia")["slope_deg"]
    borders = [0, gentle, steep, 90]
    planted = np.histogram(slope_deg(HILLY, x, y), borders)[0]
    there = np.histogram(slope_deg(HILLY, *ground[:, HILLY.shore_m(*ground) > 2]), borders)[0]
    density = planted / there
    assert there.min() > 1000 and density[2] == 0
    # Between the two it falls linearly to nothing; gentler slopes are the more common ones.
    assert 0.4 < density[1] / density[0] < 0.75


def test_slopes_are_those_of_the_ground():
    x, y = np.array([3.0, -80.0]), np.array([50.0, 61.0])
    ramp = build_terrain(tiny()["scene"]["terrain"] | {"relief_m": 0, "water_radius_m": 0}, SEED)
    cells = ramp.heights_m.shape[0]
    ramp.heights_m[:] = np.tan(np.radians(11.0)) * np.linspace(-60, 60, cells)[:, None]
    assert slope_deg(ramp, x[:1], y[:1]) == pytest.approx(11.0)


def test_a_path_takes_plants_away_and_moves_none():
    mix = {"hookthorn": {"per_ha": 100}, "shrub": {"per_ha": 300}}
    everywhere, left = (
        place_plants(mix, Site(LEVEL, corridors=Corridors(c)), SEED) for c in ((), [CORRIDOR])
    )
    for name in mix:
        assert {tuple(p) for p in left[name].points_m} < {tuple(p) for p in everywhere[name].points_m}


def test_sizes_and_variants_keep_to_the_species(savanna):
    for name, planting in savanna.items():
        low, high = assets.load("plants", name)["scale_range"]
        assert low <= planting.scale.min() and planting.scale.max() < high
        assert set(planting.variant) == set(range(assets.load("plants", name)["variants"]))
        assert 0 <= planting.yaw_rad.min() and planting.yaw_rad.max() < 2 * np.pi


def _bits(plantings):
    parts = [(p.points_m, p.yaw_rad, p.scale, p.variant) for p in plantings.values()]
    return [array.tobytes() for part in parts for array in part]


def test_a_seed_gives_the_same_plants_again_and_another_seed_others():
    mix = {"acacia": {"per_ha": 20}, "log": {"per_ha": 5}, "shrub": {"per_ha": [10, 50, 200]}}
    backwards = dict(reversed(mix.items()))
    first = _bits(place_plants(mix, Site(HILLY), 1))
    assert first == _bits(place_plants(backwards, Site(HILLY), 1))
    assert not set(first) & set(_bits(place_plants(mix, Site(HILLY), 2)))


def test_a_bare_place():
    assert not place_plants({}, Site(LEVEL), SEED)
