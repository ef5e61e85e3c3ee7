"""The ground's mesh: no cracks, no lost area, the requested share of grass, borders along triangle edges."""

import numpy as np
import pytest

from scenes import tiny
from planner.land.covers import SOIL, plan_covers
from planner.land.ground import build_ground
from planner.land.road_plan import plan_road
from planner.land.roads import TRACK_M
from planner.land.terrain import build_terrain
from planner.geometry.rotations import left_of
from planner.geometry.triangles import split_edges

SETTINGS = tiny()["scene"]["terrain"] | {"size_m": 240}
WILD = {"pan_radius_m": 8, "craggy_fraction": 0.1, "gully_depth_m": 1, "road": {"width_m": 3.8, "fork": True}}


def _build(**changes):
    settings = SETTINGS | changes
    terrain = build_terrain(settings, 5)
    terrain = terrain.with_road(plan_road(settings["road"], terrain, 5))
    layers = plan_covers(terrain, settings, 5)
    return terrain, layers, build_ground(terrain, layers, SOIL)


def _share(ground, areas, material, where=slice(None)):
    """The share of the area `where` that a material covers."""
    is_it = (ground.cover == ground.materials.index(material)) if material in ground.materials else areas < 0
    return areas[where][is_it[where]].sum() / areas[where].sum()


@pytest.fixture(scope="module", name="built", params=[{}, WILD], ids=["plain", "wild"])
def _built(request):
    return _build(**request.param)


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
    # Points on shared edges round by some eps of 120 m. Border points that cut edges on the road lie on the edge: 3 cm.
    off_m = np.abs(heights - ground.points_m[:, 2])
    on_road = np.isfinite(terrain.road_m(ground.points_m[:, 0], ground.points_m[:, 1]))
    assert off_m[~on_road].max() < 1e-11
    assert off_m.max() < 0.03


def test_the_road_is_in_the_mesh():
    terrain, _, ground = _build(**WILD)
    middle = ground.points_m[ground.triangles].mean(axis=1)
    about = np.isfinite(terrain.road_m(middle[:, 0], middle[:, 1]))
    off_m = np.abs(terrain.height_m(middle[:, 0], middle[:, 1]) - middle[:, 2])
    assert off_m[about].max() < 0.03
    off_road_m = terrain.road_m(middle[:, 0], middle[:, 1])
    is_road = ground.cover == ground.materials.index("road")
    assert is_road[np.abs(off_road_m + 1.9 - TRACK_M) < 0.1].mean() > 0.85
    assert not is_road[off_road_m > 1.9].any()


def test_the_road_wanders_and_grows_over_and_its_end_narrows():
    terrain, layers, _ = _build(**WILD)
    road, across_m = terrain.road, np.arange(-4.0, 4.01, 0.05)

    def bare(line, at_m):
        points_m, heading = line.at(at_m)
        places_m = points_m[:, None] + across_m[:, None] * left_of(heading)[:, None]
        return layers[0].value(*np.moveaxis(places_m, -1, 0)) > 0

    loop = bare(road.loop, np.arange(0.0, road.loop.length_m, 3.0))
    right_m, left_m = (np.abs(across_m[each.argmax(axis=1)]) for each in (loop, loop[:, ::-1]))
    assert 0.15 < (right_m + left_m).std() < 1.0 and (right_m + left_m).mean() == pytest.approx(3.8, abs=0.3)
    assert 0.2 < 1.0 - loop[:, 80].mean() < 0.98  # grown over between the wheels
    spur = bare(road.spur, road.spur.length_m - np.array([26.0, 15.0, 1.0])).sum(axis=1)
    assert spur[0] > spur[1] > spur[2] == 0


def test_covers_lie_where_their_values_say(built):
    _, layers, ground = built
    corners = ground.points_m[ground.triangles]
    bare = np.ones(len(corners), bool)
    for number, layer in enumerate(layers, start=1):
        values = layer.value(corners[..., 0], corners[..., 1])
        # Well off the border, along which the value is interpolated; and of one side with all corners.
        clear = bare & (np.abs(values).min(axis=1) > 0.15) & (np.ptp(np.sign(values), axis=1) == 0)
        assert np.array_equal(ground.cover[clear] == number, values[clear].max(axis=1) > 0), layer.material
        bare &= ~(ground.cover == number)


@pytest.mark.parametrize("share", [0.2, 0.55, 0.8])
def test_grass_has_its_share_of_the_dry_ground(share):
    terrain, _, ground = _build(grass_fraction=share)
    middle = ground.points_m[ground.triangles].mean(axis=1)
    dry = terrain.shore_m(middle[:, 0], middle[:, 1]) > 0
    areas = _areas(ground)
    # The threshold is a quantile over the 2 m grid: patches and shore are sampled every 2 m instead of measured,
    # which errs by some permille of the area; 1 % allows for it.
    wet_soil = _share(ground, areas, "wet_soil", dry)  # on the bare margin, where no grass grows
    assert 0 < wet_soil < 0.02
    assert _share(ground, areas, "grass", dry) == pytest.approx(share, abs=0.01)


def test_all_grass_and_no_grass():
    ground = _build(grass_fraction=0, water_radius_m=0)[2]
    assert ground.materials == ("soil",) and not ground.cover.any()
    ground = _build(grass_fraction=1, water_radius_m=0)[2]
    assert {ground.materials[k] for k in set(ground.cover)} == {"grass"}


def test_a_wild_place_has_all_covers():
    terrain, _, ground = _build(**WILD)
    areas = _areas(ground)
    assert ground.materials == ("soil", "road", "wet_soil", "rock", "grass")
    assert min(_share(ground, areas, material) for material in ground.materials) > 0
    length_m = sum(line.length_m for line in terrain.road.lines)
    # Where the spur leaves the loop both are one; up to a third of the width has grown over.
    assert 0.7 < _share(ground, areas, "road") * 240**2 / (3.8 * length_m) < 1.0
    middle = ground.points_m[ground.triangles].mean(axis=1)
    near = np.abs(terrain.shore_m(middle[:, 0], middle[:, 1])) < 0.5
    assert _share(ground, areas, "wet_soil", near) > 0.95


@pytest.mark.parametrize(
    "edges, count", [([], 1), ([[0, 2]], 2), ([[0, 1], [0, 2]], 3), ([[0, 1], [0, 2], [1, 2]], 4)]
)
def test_splitting_keeps_area_and_direction(edges, count):
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    edges = np.array(edges, int).reshape(-1, 2)
    for turn in range(3):
        triangles, parent = split_edges(np.roll([[0, 1, 2]], turn, axis=1), edges, 3)
        assert not parent.any()
        points = np.concatenate([corners, corners[edges].mean(axis=1)])
        a, b, c = np.moveaxis(points[triangles], 1, 0)
        areas = 0.5 * np.cross(b - a, c - a)
        assert len(triangles) == count and areas.min() > 0 and areas.sum() == 0.5
