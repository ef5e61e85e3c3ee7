"""Formations: distances between members, where they face, and that seeds alone decide."""

import numpy as np
import pytest

from scenes import flat, tiny
from planner.groups.formations import form, half_breadth_m, march
from planner.groups.herds import Room
from planner.world import plan_world

ROOM = Room(0.3, 0.25)
SPACING_M = 0.6
UNEVEN = 0.15  # of the spacing, to either side; half of it in each direction of a formation at a place


def _form(formation: str, count=6, spread_m=None, seed=1, rooms=None):
    """Places (n, 2) and headings (n, 2)."""
    stands = form(formation, rooms or [ROOM] * count, SPACING_M, spread_m, seed, "people")
    return tuple(np.array(part) for part in zip(*stands))


def _gaps_m(at_m: np.ndarray) -> np.ndarray:
    """Distances (n, n), with infinity on the diagonal."""
    return np.linalg.norm(at_m[:, None] - at_m, axis=-1) + np.diag(np.full(len(at_m), np.inf))


@pytest.mark.parametrize("formation", ["circle", "row", "queue", "pairs"])
@pytest.mark.parametrize("seed", range(5))
def test_neighbours_are_a_spacing_apart(formation, seed):
    gaps_m = _gaps_m(_form(formation, seed=seed)[0]).min(axis=1)
    # Two members deviate by up to 0.075 spacings each; on a circle of six, besides, by 0.15 of the angle between them.
    slack = UNEVEN if formation != "circle" else 3 * UNEVEN
    assert (np.abs(gaps_m - SPACING_M) < slack * SPACING_M).all()


def test_members_of_a_circle_face_its_middle():
    at_m, facing = _form("circle", 9, spread_m=1.5)
    outward = at_m / np.linalg.norm(at_m, axis=1)[:, None]
    assert np.linalg.norm(at_m, axis=1) == pytest.approx(np.full(9, 1.5), abs=0.5 * UNEVEN * SPACING_M)
    # They turn by up to 20 degrees, and are up to 0.045 m off their place at 1.5 m.
    assert ((outward * facing).sum(axis=1) < -np.cos(np.radians(22.0))).all()


def test_members_of_a_row_face_across_it_and_those_of_a_queue_along():
    for formation, along in (("row", False), ("queue", True)):
        at_m, facing = _form(formation)
        line = (at_m[0] - at_m[-1]) / np.linalg.norm(at_m[0] - at_m[-1])
        shares = np.abs(facing @ line)
        assert (
            (shares > np.cos(np.radians(23.0))).all() if along else (shares < np.sin(np.radians(23.0))).all()
        )


def test_pairs_are_two_who_are_close_and_face_each_other_or_the_same_way():
    kinds = set()
    for seed in range(6):
        at_m, facing = _form("pairs", 8, seed=seed)
        gaps_m = _gaps_m(at_m)
        assert gaps_m.argmin(axis=1).tolist() == [1, 0, 3, 2, 5, 4, 7, 6]
        agree = (facing[::2] * facing[1::2]).sum(axis=1)
        assert (np.abs(agree) > np.cos(np.radians(41.0))).all()
        kinds |= set(np.sign(agree))
    assert kinds == {-1.0, 1.0}


def test_those_who_lie_in_a_scattered_group_have_space():
    rooms = [Room(0.8, 0.25), ROOM] * 4
    for seed in range(5):
        gaps_m = _gaps_m(_form("scatter", seed=seed, rooms=rooms)[0])
        assert gaps_m.min() > (1.0 - UNEVEN) * SPACING_M
        assert gaps_m[::2, ::2].min() > (1.0 - UNEVEN) * SPACING_M + 2 * (0.8 - 0.35)


def test_a_member_count_of_one_is_a_formation():
    for formation in ("circle", "row", "queue", "pairs", "scatter"):
        assert len(_form(formation, 1)[0]) == 1


@pytest.mark.parametrize("formation, abreast", [("queue", 1), ("pairs", 2), ("row", 5)])
def test_those_who_walk_are_in_ranks(formation, abreast):
    places = march(formation, 5, SPACING_M, 100.0, 1, "people")
    for k, place in enumerate(places):
        ranks_m = SPACING_M * (1.0 if formation == "queue" else 2.0)
        assert place.along_m == pytest.approx(-ranks_m * (k // abreast), abs=UNEVEN * SPACING_M)
        aside_m = SPACING_M * (0.5 * (abreast - 1) - k % abreast)
        assert place.lateral_m == pytest.approx(aside_m, abs=UNEVEN * SPACING_M)
        assert abs(place.lateral_m) <= half_breadth_m(formation, 5, SPACING_M)


def test_a_loop_has_space_for_so_many_ranks():
    assert len(march("pairs", 99, SPACING_M, 6.1, 1, "people")) == 2 * 5


def _people(**entries):
    """Two groups of villagers: at a place, and on the loop."""

    def change(config):
        flat(config)
        groups = config["scene"]["groups"]
        path = groups[0]["path"]
        groups[:] = [
            {"name": "fireside", "species": "villager", "place": [35, 35], "count": 12, **entries},
            {
                "name": "walkers",
                "species": "villager",
                "path": path,
                "count": 6,
                "formation": "pairs",
                "start_m": 5,
            },
        ]
        for clip in config["clips"]:
            if "target" in clip["flight"]:
                clip["flight"]["target"] = "walkers_1"

    return change


MIXED = {"formation": "circle", "spacing_m": 0.5, "behaviours": {"stand": 1, "sit": 2, "crouch": 1}}


def test_groups_of_a_config_are_in_formation_and_do_what_they_should():
    world = plan_world(tiny(_people(**MIXED)))
    sitters = [actor for actor in world.actors if actor.group == "fireside"]
    at_m = np.array([actor.path(np.zeros(1))[0][0] for actor in sitters])
    assert _gaps_m(at_m).min() < 0.6  # nearer than bodies of other groups could be
    assert {actor.posture.split("_")[0] for actor in sitters} == {"stand", "sit", "crouch"}
    assert len({(actor.variant, actor.posture) for actor in sitters}) > 8
    for actor in world.actors:
        assert actor.posture == "walk" if actor.group == "walkers" else actor.schedule.mean_m_s == 0


def test_a_formation_is_the_same_whatever_else_there_is():
    def other(config):
        _people(**MIXED)(config)
        config["scene"]["groups"].append({"name": "far", "species": "zebra", "place": [-35, -35], "count": 3})

    one, two = (plan_world(tiny(change)).actors for change in (_people(**MIXED), other))
    for actor, same in zip(one, two):
        assert (actor.name, actor.variant, actor.posture, actor.scale) == (
            same.name,
            same.variant,
            same.posture,
            same.scale,
        )
        assert np.array_equal(actor.path(np.zeros(1)), same.path(np.zeros(1)))
