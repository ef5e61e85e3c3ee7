"""Warm beds of groups: where they are, how large, and which groups have none."""

import numpy as np
import pytest

from planner.faults import ConfigError
from planner.groups.beds import check_beds, plan_beds
from planner.groups.behaviours import draft_members
from planner.groups.actors import Actor
from planner.geometry.splines import Loop, Spot

BEDS = {"count": 2, "left_s": 300, "lain_s": 5400}


class _Flat:
    size_m = 200.0
    waters = ("one",)

    def height_m(self, x_m, y_m):
        return 0.0 * (x_m + y_m)

    def shore_m(self, x_m, y_m):
        return x_m + 2.0 + 0.0 * y_m


def _group(**keys):
    return {"name": "g", "species": "zebra", "count": 3, "beds": BEDS, **keys}


def _actors(group, route):
    return [
        Actor(
            **vars(draft),
            group="g",
            index=101 + k,
            route=route,
            start_m=50.0 * k,
            lateral_m=0.0,
            terrain=_Flat(),
        )
        for k, draft in enumerate(draft_members(group, 1))
    ]


def test_animals_that_stand_have_left_a_bed_beside_them_on_dry_ground():
    group = _group(place=[0, 0])
    spot = Spot(np.zeros(2), np.array([1.0, 0.0]))
    for seed in range(40):
        beds = plan_beds([group], _actors(group, spot), _Flat(), seed)
        assert len(beds) == 2
        for bed in beds:
            assert 1 < np.hypot(*bed["place_m"]) < 5
            assert bed["place_m"][0] > -2
            assert 0.3 < bed["half_m"][1] / bed["half_m"][0] < 0.7
            assert (bed["left_s"], bed["lain_s"]) == (300, 5400)
    assert plan_beds([group], _actors(group, spot), _Flat(), 3) == plan_beds(
        [group], _actors(group, spot), _Flat(), 3
    )


def test_animals_that_walk_have_come_from_theirs():
    group = _group(path="round", speed_m_s=0.1)
    angle = np.linspace(0, 2 * np.pi, 30, endpoint=False)
    loop = Loop(60 * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    actors = _actors(group, loop)
    beds = plan_beds([group], actors, _Flat(), 1)
    for actor, bed in zip(actors, beds):
        here = actor.path(np.array([actor.start_m]))[0][0]
        assert np.hypot(*(here - bed["place_m"])) == pytest.approx(30, rel=0.02)


@pytest.mark.parametrize(
    "group, message",
    [
        (
            _group(species="crocodile"),
            "s[1].beds is given; expected none, since the species crocodile does not lie and warm the ground",
        ),
        (
            _group(species="elephant"),
            "s[1].beds is given; expected none, since the species elephant does not lie and warm the ground",
        ),
        (_group(count=1), "s[1].beds.count = 2; expected at most the group's 1 members"),
    ],
)
def test_groups_that_have_no_beds(group, message):
    with pytest.raises(ConfigError) as error:
        check_beds("s[1]", group)
    assert str(error.value) == message
    check_beds("s[1]", {"name": "g", "species": "pickup", "count": 1})
