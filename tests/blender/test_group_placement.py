"""Spots to stay at: at the shore, in the water, around a point, clear of others."""

import numpy as np
import pytest

from scenes import tiny
from planner.groups.collision_discs import cover, gather
from planner.groups.herds import Room
from planner.land.corridors import Corridor, Corridors
from planner.groups.placement import about, afloat, at_shore, find_spots, in_water, on_land
from planner.land.terrain import build_terrain

ZEBRA, HIPPO = Room(1.25, 0.33), Room(1.9, 0.75)


@pytest.fixture(scope="module", name="terrain")
def _terrain():
    config = tiny(lambda c: c["scene"]["terrain"].update(size_m=400, water_radius_m=40))
    return build_terrain(config["scene"]["terrain"], config["seed"])


def _gaps_m(rooms, spots):
    crowds = [
        gather([(cover(room.half_length_m, room.half_width_m), *spot.at(np.zeros(1)))])
        for room, spot in zip(rooms, spots)
    ]
    for k, a in enumerate(crowds):
        for b in crowds[:k]:
            yield np.linalg.norm(a.centre_m[0][:, None] - b.centre_m[0], axis=-1).min() - a.radius_m[
                0
            ] - b.radius_m[0]


def test_bodies_at_a_place_are_apart_and_near_it(terrain):
    rooms = [HIPPO] * 8
    spots = find_spots(rooms, about([90, 80], rooms, 25.0), on_land(terrain, Corridors()), [], 3, "herd")
    assert len(spots) == 8
    assert min(_gaps_m(rooms, spots)) >= 0.5
    assert max(np.linalg.norm(spot.point_m - [90, 80]) for spot in spots) <= 25.0


def test_the_default_spread_fits_the_group(terrain):
    rooms = [HIPPO] * 30
    assert (
        len(find_spots(rooms, about([110, 110], rooms, None), on_land(terrain, Corridors()), [], 3, "herd"))
        == 30
    )


def test_too_many_for_a_place_are_not_squeezed_in(terrain):
    rooms = [HIPPO] * 30
    spots = find_spots(rooms, about([90, 80], rooms, 6.0), on_land(terrain, Corridors()), [], 3, "herd")
    assert 0 < len(spots) < 30
    assert min(_gaps_m(rooms, spots)) >= 0.5


def test_spots_are_clear_of_walkers_and_other_groups(terrain):
    rooms = [ZEBRA] * 12
    path = Corridor(np.column_stack([np.arange(60.0, 130.0, 0.8), np.full(88, 80.0)]), 3.0)
    there = gather([(cover(2.0, 2.0), np.array([[90.0, 90.0]]), np.array([[1.0, 0.0]]))])
    for spot in find_spots(
        rooms, about([90, 80], rooms, 20.0), on_land(terrain, Corridors([path])), [there], 3, "herd"
    ):
        assert abs(spot.point_m[1] - 80.0) > 3.0
        assert np.linalg.norm(spot.point_m - [90, 90]) > 2.5


def test_animals_at_the_shore_are_dry_and_face_the_water(terrain):
    water = terrain.waters[0]
    rooms = [ZEBRA] * 8
    spots = find_spots(rooms, at_shore(water, 3, "herd"), on_land(terrain, Corridors()), [], 3, "herd")
    assert len(spots) == 8
    for spot in spots:
        assert terrain.shore_m(*spot.point_m) > 0
        mouth_m = terrain.shore_m(*(spot.point_m + (ZEBRA.half_length_m + 1.0) * spot.heading))
        assert mouth_m < terrain.shore_m(*spot.point_m)
        assert mouth_m < 2.0


def test_swimmers_have_water_under_them(terrain):
    rooms = [HIPPO] * 6
    spots = find_spots(rooms, in_water(terrain.waters[0]), afloat(terrain, 1.2), [], 3, "herd")
    assert len(spots) == 6
    for spot in spots:
        x_m, y_m = spot.point_m
        assert terrain.surface_m(x_m, y_m) - terrain.height_m(x_m, y_m) >= 1.2


def test_a_spot_is_a_path_that_leads_nowhere(terrain):
    (spot,) = find_spots([ZEBRA], about([90, 80], [ZEBRA], 5.0), on_land(terrain, Corridors()), [], 3, "one")
    point, heading = spot.at(np.array([0.0, 3.0, -7.0]))
    assert point.shape == heading.shape == (3, 2)
    assert (point == spot.point_m).all() and (heading == spot.heading).all()
