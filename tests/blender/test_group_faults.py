"""Faults in groups and paths: messages name the place, the value and the rule."""

import pytest

from scenes import tiny
from planner.faults import ConfigError
from planner.world import plan_world


def _group(k: int, **entries):
    """A change of the k-th group; None takes a key away."""

    def change(config):
        group = config["scene"]["groups"][k]
        for key, value in entries.items():
            group.pop(key, None)
            if value is not None:
                group[key] = value

    return change


def _place(**entries):
    """A change of the third group, to villagers at a place."""
    return _group(2, **{"path": None, "start_m": None, "place": [40, 40], "species": "villager"} | entries)


def _path(**entries):
    """Another path beside the place's loop."""
    return lambda config: config["scene"]["paths"].update(entries)


def _meet_each_other(config):
    for group, met in zip(config["scene"]["groups"], ("herd", "people")):
        group.pop("start_m", None)
        group["meets"] = met


FAULTS = {
    "neither path nor place": (
        _group(0, path=None),
        "scene.groups[0]: path is missing; expected a path to walk on, or a place to stay at",
    ),
    "path and place": (
        _group(0, place=[10, 10]),
        "scene.groups[0]: path and place are both given; expected a path to walk on, or a place to stay at",
    ),
    "a walker at a place": (
        _group(1, path=None, place=[10, 10], behaviour="walk"),
        'scene.groups[1].behaviour = "walk"; expected at a place: drink, stand',
    ),
    "a lying human": (
        _group(0, behaviour="lie"),
        'scene.groups[0].behaviour = "lie"; expected what a human can do: drink, graze, stand, walk',
    ),
    "an unknown variant": (
        _group(0, variants=["plain", "rifles"]),
        'scene.groups[0].variants[1] = "rifles"; expected a variant of human: pack, plain, rifle;'
        ' did you mean "rifle"?',
    ),
    "an unknown group to meet": (
        _group(0, meets="heard"),
        'scene.groups[0].meets = "heard"; expected another group: herd, zebras; did you mean "herd"?',
    ),
    "meeting oneself": (
        _group(0, meets="people"),
        'scene.groups[0].meets = "people"; expected another group: herd, zebras',
    ),
    "a start and a group to meet": (
        _group(1, start_m=3, meets="people"),
        "scene.groups[1].start_m is given; expected none, since meets determines it",
    ),
    "a group at a place that meets another": (
        _group(2, path=None, start_m=None, place=[40, 40], meets="people"),
        "scene.groups[2].meets is given; expected a path: a group at a place cannot move to meet others",
    ),
    "a group that meets a later one": (
        _meet_each_other,
        'scene.groups[0].meets = "herd"; expected a group listed before it, or one without meets',
    ),
    "an unknown place": (
        _group(2, path=None, start_m=None, place="shores"),
        'scene.groups[2].place = "shores"; expected [x, y] or one of pan, pan_shore, road, shore, water;'
        ' did you mean "shore"?',
    ),
    "standing in the water": (
        _group(2, path=None, start_m=None, place="water"),
        'scene.groups[2].place = "water"; expected one on dry land, or behaviour = "float"',
    ),
    "too many for a place": (
        _group(2, path=None, start_m=None, place=[40, 40], count=60, spread_m=4),
        "scene.groups[2].count = 60; expected at most ",
    ),
    "too many for a path": (
        _group(1, count=60),
        'scene.groups[1].count = 60; expected at most 21: no more fit on path "loop", which is 166 m long',
    ),
    "a behaviour and shares of behaviours": (
        _place(behaviour="sit", behaviours={"sit": 1}),
        "scene.groups[2]: behaviour and behaviours are both given; expected one of them",
    ),
    "shares of behaviours on a path": (
        _group(0, behaviours={"stand": 1}),
        "scene.groups[0].behaviours is given; expected a place: members on a path all do the same",
    ),
    "a share of what a species cannot do": (
        _place(species="human", behaviours={"stand": 1, "sit": 1}),
        'scene.groups[2].behaviours = "sit"; expected what a human can do: drink, graze, stand, walk',
    ),
    "no share above 0": (
        _place(behaviours={"stand": 0, "sit": 0}),
        "scene.groups[2].behaviours are all 0; expected one share above 0",
    ),
    "a circle on a path": (
        _group(0, formation="circle"),
        'scene.groups[0].formation = "circle"; expected on a path: pairs, queue, row',
    ),
    "a formation at the shore": (
        _place(place="shore", formation="circle"),
        'scene.groups[2].place = "shore"; expected [x, y] for a formation',
    ),
    "a formation of people in each other": (
        _place(formation="row", spacing_m=0.2),
        "scene.groups[2].spacing_m = 0.2 m; expected at least 0.35 m in a formation",
    ),
    "a formation without space": (
        _place(place=[300, 300], formation="row", count=4),
        'scene.groups[2].formation = "row"; expected space for 4 members within 10 m of place = [300, 300], off paths'
        " and other groups",
    ),
    "a path that is not given": (
        _path(other={}),
        "scene.paths.other: neither is given; expected points_m, or centre_m and radius_m",
    ),
    "a path given twice": (
        _path(other={"points_m": [[0, 0], [9, 0], [0, 9]], "centre_m": [0, 0], "radius_m": 20}),
        "scene.paths.other: both are given; expected points_m, or centre_m and radius_m",
    ),
    "a centre alone": (
        _path(other={"centre_m": [0, 0]}),
        "scene.paths.other.radius_m is missing; expected the mean distance of the loop from centre_m",
    ),
    "no space for a drawn path": (
        _path(other={"centre_m": [500, 500], "radius_m": 20}),
        "scene.paths.other = 20 m about [500, 500] m; expected space for a loop there, within the place and off"
        " water",
    ),
    "a path with the road's name": (
        _path(road={"centre_m": [0, 0], "radius_m": 20}),
        'scene.paths.road; expected another name: "road" is the road of scene.terrain',
    ),
    "a path that crosses itself": (
        _path(eight={"points_m": [[30, 10], [10, 30], [30, 30], [10, 10]]}),
        "scene.paths.eight: the loop crosses itself at x = 2",
    ),
}


@pytest.mark.parametrize("change, message", FAULTS.values(), ids=FAULTS)
def test_faults_in_groups_and_paths(change, message):
    with pytest.raises(ConfigError) as raised:
        plan_world(tiny(change))
    text = str(raised.value)
    assert text.startswith(message) if message[-1] in " 2" else text == message
