"""The ground's mesh: no crack, no lost area, the share of grass asked for, borders between the triangles."""

import numpy as np
import pytest

from scenes import tiny
from veldt.ground import GRASS, SOIL, build_ground, plan_cover, split_edges
from veldt.terrain import build_terrain

SETTINGS = tiny()["scene"]["terrain"] | {"size_m": 240}


def _build(**changes):
    settings = SETTINGS | changes
    terrain = build_terrain(settings, 5)
    cover = plan_cover(terrain, settings, 5)
    return terrain, cover, build_ground(terrain, cover)


@pytest.fixture(scope="module", name="built")
def _built():
    return _build()


def _areas(ground):
    a, b, c = np.moveaxis(ground.points_m[ground.triangles], 1, 0)
    return 0.5 * np.cross(b - a, c - a)[:, 2]


def test_triangles_face_up_and_cover_the_square_once(built):
    _, _, ground = built
    areas = _areas(ground)
    assert areas.min() > 0
    # A sum of n positive terms errs by at most n eps.
    assert areas.sum() == pytest.approx(240**2, rel=len(areas) * 2.3e-16)


def test_neighbours_share_whole_edges(built):
    _, _, ground = built
    edges = np.sort(ground.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    assert set(count) == {1, 2}
    ends = ground.points_m[unique[count == 1]]
    on_rim = (
        np.isclose(np.abs(ends[..., :2]), 120).all(axis=1).any(axis=1)
    )  # both ends on the same side of the square
    assert on_rim.all()


def test_the_mesh_is_the_heightfield(built):
    terrain, _, ground = built
    heights = terrain.height_m(ground.points_m[:, 0], ground.points_m[:, 1])
    # Points on shared edges round by some eps of 120 m.
    assert np.abs(heights - ground.points_m[:, 2]).max() < 1e-11


def test_cover_changes_only_where_its_value_does(built):
    terrain, cover, ground = built
    values = cover.value(terrain, ground.points_m[:, 0], ground.points_m[:, 1])[ground.triangles]
    clear = np.abs(values).min(axis=1) > 0.1  # well off the border, along which the value is interpolated
    same = (values > 0).all(axis=1) | (values < 0).all(axis=1)
    assert same[clear].all()
    assert np.array_equal(ground.cover[clear] == GRASS, values[clear].max(axis=1) > 0)


@pytest.mark.parametrize("share", [0.2, 0.55, 0.8])
def test_grass_has_its_share_of_the_dry_ground(share):
    terrain, _, ground = _build(grass_fraction=share)
    middle = ground.points_m[ground.triangles].mean(axis=1)
    dry = terrain.shore_m(middle[:, 0], middle[:, 1]) > 0
    areas = _areas(ground)
    # The threshold is a quantile over the 2 m grid: patches and shore are sampled every 2 m instead of measured,
    # which errs by some permille of the area; 1 % allows for it.
    assert areas[dry & (ground.cover == GRASS)].sum() / areas[dry].sum() == pytest.approx(share, abs=0.01)


def test_all_grass_and_no_grass():
    assert set(_build(grass_fraction=0)[2].cover) == {SOIL}
    assert set(_build(grass_fraction=1, water_radius_m=0)[2].cover) == {GRASS}


@pytest.mark.parametrize(
    "edges, count", [([], 1), ([[0, 2]], 2), ([[0, 1], [0, 2]], 3), ([[0, 1], [0, 2], [1, 2]], 4)]
)
def test_splitting_keeps_area_and_direction(edges, count):
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    edges = np.array(edges, int).reshape(-1, 2)
    for turn in range(3):
        triangles = split_edges(np.roll([[0, 1, 2]], turn, axis=1), edges, 3)
        points = np.concatenate([corners, corners[edges].mean(axis=1)])
        a, b, c = np.moveaxis(points[triangles], 1, 0)
        areas = 0.5 * np.cross(b - a, c - a)
        assert len(triangles) == count and areas.min() > 0 and areas.sum() == 0.5
