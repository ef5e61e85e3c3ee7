"""The ground that clips may show, and its mesh."""

import numpy as np
import pytest

from scenes import tiny
from planner.camera import centred, look, project
from planner.flight.poses import Flight
from planner.land.covers import SOIL, plan_covers
from planner.land.ground import build_ground
from planner.land.road_plan import plan_road
from planner.land.terrain import build_terrain
from planner.noise import stream
from planner.seen_ground import seen_ground

SETTINGS = tiny()["scene"]["terrain"] | {
    "size_m": 600,
    "pan_radius_m": 8,
    "craggy_fraction": 0.1,
    "road": {"width_m": 3.8, "fork": True},
}
LENS = centred(160, 128, 190.0)


@pytest.fixture(scope="module", name="terrain")
def _terrain():
    terrain = build_terrain(SETTINGS, 5)
    return terrain.with_road(plan_road(SETTINGS["road"], terrain, 5))


def _flight(terrain, depression_deg, frames=40, rate_hz=10.0, turn_rad_s=0.5):
    """A camera that flies over the road at 12 m/s and turns."""
    time_s = np.arange(frames) / rate_hz
    x_m, y_m = terrain.road.points_m[0][0][:, None] + np.array([[12.0], [0.0]]) * (time_s - time_s.mean())
    position_m = np.column_stack([x_m, y_m, terrain.surface_m(x_m, y_m) + 60.0])
    bearing = np.column_stack([np.cos(turn_rad_s * time_s), np.sin(turn_rad_s * time_s)])
    poses = look(position_m, bearing, np.full(frames, np.radians(depression_deg)))
    return Flight(time_s, poses, np.full(frames, 60.0), np.full(frames, float(depression_deg)))


@pytest.mark.parametrize("depression_deg, most", [(90, 0.12), (40, 0.4), (8, 1.0)])
def test_all_that_a_picture_shows_is_seen_and_not_much_more(terrain, depression_deg, most):
    flight = _flight(terrain, depression_deg)
    x_m, y_m = stream(1, "ground").uniform(-300, 300, (2, 4000))
    points_m = np.column_stack([x_m, y_m, terrain.height_m(x_m, y_m)])
    place_px, depth_m = project(LENS, flight.camera_to_world, points_m)
    inside = (place_px > 0).all(axis=-1) & (place_px < [160, 128]).all(axis=-1) & (depth_m > 0)
    shown = inside.any(axis=0)
    seen = seen_ground(terrain, [(LENS, flight)])
    assert shown.sum() > 10 and seen(x_m, y_m)[shown].all()
    assert seen.squares.mean() < most


def test_several_flights_are_seen_whatever_their_order_and_rate(terrain):
    one, other = _flight(terrain, 90), _flight(terrain, 50, frames=4, rate_hz=0.5)
    both = seen_ground(terrain, [(LENS, one), (LENS, other)]).squares
    assert np.array_equal(both, seen_ground(terrain, [(LENS, other), (LENS, one)]).squares)
    alone = [seen_ground(terrain, [(LENS, flight)]).squares for flight in (one, other)]
    assert np.array_equal(both, alone[0] | alone[1]) and (both > alone[0]).any()
    still = Flight(*(values[:1] for values in vars(one).values()))
    assert seen_ground(terrain, [(LENS, still)]).squares.any()


def test_the_mesh_is_the_same_where_it_is_seen_and_coarse_elsewhere(terrain):
    layers = plan_covers(terrain, SETTINGS, 5)
    seen = seen_ground(terrain, [(LENS, _flight(terrain, 90))])
    whole, fine_there = build_ground(terrain, layers, SOIL), build_ground(terrain, layers, SOIL, seen)

    def triangles(ground):
        """Those 8 m inside what is seen, as sorted rows of their middles and covers."""
        corners_m = ground.points_m[ground.triangles]
        around_m = corners_m[:, None, :, :2] + np.array(
            [[[8.0, 8.0]], [[8.0, -8.0]], [[-8.0, 8.0]], [[-8.0, -8.0]]]
        )
        inside = seen(*around_m.reshape(-1, 2).T).reshape(len(corners_m), -1).all(axis=1)
        middles_m = corners_m[inside].mean(axis=1)
        rows = np.column_stack([middles_m, ground.cover[inside]])
        return np.round(rows[np.lexsort(rows.T)], 9)

    assert set(map(tuple, triangles(whole))) == set(map(tuple, triangles(fine_there)))
    assert len(fine_there.triangles) < 0.6 * len(whole.triangles)
    edges = np.sort(fine_there.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    on_rim = np.isclose(np.abs(fine_there.points_m[unique[count == 1]][..., :2]), 300).all(axis=1).any(axis=1)
    assert set(count) == {1, 2} and on_rim.all()
    corners_m = fine_there.points_m[fine_there.triangles]
    areas_m2 = 0.5 * np.cross(corners_m[:, 1] - corners_m[:, 0], corners_m[:, 2] - corners_m[:, 0])[:, 2]
    assert areas_m2.min() > 0 and areas_m2.sum() == pytest.approx(600**2, rel=1e-9)
