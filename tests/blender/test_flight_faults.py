"""Flights that cannot be flown are rejected with exact messages before anything is rendered."""

import pytest

from scenes import tiny
from planner.faults import ConfigError
from planner.plan import plan_clips
from planner.world import plan_world

CENTRE = {"pattern": "orbit", "centre_m": [0, 0], "radius_m": 40}
AREA = {"pattern": "zigzag", "area_m": [-30, -30, 30, 30]}
FAULTS = {  # of the plan of the first clip
    "under the ground": (
        AREA | {"altitude_reference": "datum", "altitude_m": -4.2},
        "clips[0].flight: the camera is 4.2 m under the terrain at time_s = 0.0; expected it above ground all along",
    ),
    "at the ground": (
        AREA | {"altitude_m": 0},
        "clips[0].flight.altitude_m = 0 m; expected more than 0 m above ground",
    ),
    "no area": (
        {"pattern": "zigzag"},
        'clips[0].flight.area_m is missing; expected [x_min, y_min, x_max, y_max], since pattern is "zigzag"',
    ),
    "an area turned round": (
        AREA | {"area_m": [30, -30, -30, 30]},
        "clips[0].flight.area_m = [30, -30, -30, 30] m; expected x_min < x_max and y_min < y_max",
    ),
    "lanes too far apart": (
        AREA | {"lane_spacing_m": 60, "altitude_m": 40},
        "clips[0].flight.lane_spacing_m = 60 m; expected at most 29.5 m, the width of ground in the picture",
    ),
    "no points": (
        {"pattern": "transect"},
        'clips[0].flight.points_m is missing; expected two points [x, y], since pattern is "transect"',
    ),
    "a transect of no length": (
        {"pattern": "transect", "points_m": [[1, 2], [1, 2]]},
        "clips[0].flight.points_m = [[1, 2], [1, 2]] m; expected two different points [x, y]",
    ),
    "a transect with a corner": (
        {"pattern": "transect", "points_m": [[1, 2], [3, 2], [4, 5]]},
        "clips[0].flight.points_m = [[1, 2], [3, 2], [4, 5]] m; expected two different points [x, y]",
    ),
    "no waypoints": (
        {"pattern": "waypoints"},
        'clips[0].flight: neither is given; expected points_m or waypoints, since pattern is "waypoints"',
    ),
    "waypoints twice": (
        {"pattern": "waypoints", "points_m": [[0, 0]], "waypoints": {"file": "survey.plan"}},
        'clips[0].flight: both are given; expected points_m or waypoints, since pattern is "waypoints"',
    ),
    "an orbit of nothing": (
        {"pattern": "orbit", "radius_m": 40},
        'clips[0].flight: neither is given; expected target or centre_m, since pattern is "orbit"',
    ),
    "an orbit of no size": (
        {"pattern": "orbit", "centre_m": [0, 0]},
        'clips[0].flight.radius_m is missing; expected the distance from the middle, since pattern is "orbit"',
    ),
    "an orbit too tight": (  # 12^2 / (9.80665 tan 30) = 25.43
        CENTRE | {"radius_m": 25},
        "clips[0].flight.radius_m = 25 m; expected at least 25.4 m, the tightest turn at 12 m/s and 30 deg of bank",
    ),
    "an unknown target": (
        CENTRE | {"target": "herd_9", "centre_m": None},
        'clips[0].flight.target = "herd_9"; expected an actor or a group; did you mean "herd_2"?',
    ),
    "nothing to follow": (
        {"pattern": "follow"},
        'clips[0].flight.target is missing; expected an actor or a group, since pattern is "follow"',
    ),
    "a wing that follows": (
        {"pattern": "follow", "target": "herd", "aircraft": "fixed_wing"},
        'clips[0].flight.aircraft = "fixed_wing"; expected "multirotor", since pattern is "follow":'
        " a fixed wing cannot fly as slowly as its target walks",
    ),
    "longer than its way": (  # 80 m from stop to stop at 3 m/s^2: 80 / 12 + 12 / 3 s
        {"pattern": "waypoints", "points_m": [[-40, 0], [40, 0]]},
        "clips[0]: its last frame is at 22.1 s; expected at most 10.7 s, when its flight ends",
    ),
}


def _plan(change) -> None:
    plan_clips(plan_world(tiny(change)))


@pytest.mark.parametrize("plan, words", FAULTS.values(), ids=FAULTS.keys())
def test_plans(plan, words):
    def change(config):
        flat = {"relief_m": 0, "water_radius_m": 0}
        config["scene"]["terrain"].update(flat)
        given = {key: value for key, value in plan.items() if value is not None}
        config["clips"][0] |= {"frames": 200, "flight": given}

    with pytest.raises(ConfigError) as fault:
        _plan(change)
    assert str(fault.value) == words


def test_a_clip_without_a_flight():
    with pytest.raises(ConfigError) as fault:
        _plan(lambda config: config["clips"][0].pop("flight"))
    assert str(fault.value) == (
        "clips[0].flight is missing; expected a flight plan with a pattern: zigzag, transect, waypoints, orbit or"
        " follow"
    )


FLIGHT = {"id": "long", "season": "winter", "duration_s": 20, "flight": AREA | {"altitude_m": 40}}
FLIGHT_FAULTS = {
    "a clip longer than its flight": (
        {"clip_length_s": 30},
        "flights[0].clip_length_s = 30 s; expected at most duration_s = 20 s, the length of the flight",
    ),
    "no frame at all": (
        {"duration_s": 0.1},
        "flights[0].duration_s = 0.1 s; expected at least one frame, 0.111111 s at 9 Hz",
    ),
    "no actor in view": (
        {
            "keep": "with_actors",
            "flight": AREA | {"area_m": [-55, 40, -50, 45], "altitude_m": 10},
            "duration_s": 1,
        },
        'flights[0].keep = "with_actors": no actor comes into the picture; expected one, or "all"',
    ),
    "in a flight": (
        {"flight": AREA | {"altitude_m": -1}},
        "flights[0].flight.altitude_m = -1 m; expected more than 0 m above ground",
    ),
    "below the ground in a flight": (
        {"flight": AREA | {"altitude_m": -60, "altitude_reference": "datum"}},
        None,
    ),
}


@pytest.mark.parametrize("changes, words", FLIGHT_FAULTS.values(), ids=FLIGHT_FAULTS.keys())
def test_flights(changes, words):
    def change(config):
        config["flights"] = [FLIGHT | changes]

    with pytest.raises(ConfigError) as fault:
        _plan(change)
    if words is None:
        assert str(fault.value).startswith("flights[0].flight: the camera is ")
    else:
        assert str(fault.value) == words


def test_a_clip_named_as_one_cut_from_a_flight():
    def change(config):
        config["flights"] = [FLIGHT]
        config["clips"][1]["id"] = "long_0000"

    with pytest.raises(ConfigError) as fault:
        _plan(change)
    assert str(fault.value) == 'clips[1].id = "long_0000"; expected an id that no clip of a flight has'
