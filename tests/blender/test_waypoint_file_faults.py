"""Missions that are no such files, or malformed, are rejected with exact messages."""

import copy
import json
import math
import random
import sys

import numpy as np
import pytest

from missions import (
    HOME_M,
    SURVEY,
    SURVEY_ITEM,
    WAYPOINT_ITEM,
    WHERE,
    ground_m,
    mission_item,
    place_params,
    read_mission,
)
from planner.faults import ConfigError
from planner.flight.waypoint_files import read_waypoints


def _set(*path_and_value):
    """A change of a plan: the item at a path, or its removal where the value is Ellipsis."""
    *path, last, value = path_and_value

    def change(plan):
        for step in path:
            plan = plan[step]
        if value is ...:
            del plan[last]
        else:
            plan[last] = value

    return change


ITEM = ("mission", "items", WAYPOINT_ITEM)
INNER = ("mission", "items", SURVEY_ITEM, "TransectStyleComplexItem")
KNOWN = (
    "16 (waypoint), 17 (loiter), 18 (loiter turns), 19 (loiter time), 20 (return to launch), 21 (land), 22 (take-off),"
    " 31 (loiter to altitude), 82 (spline waypoint), 84 (VTOL take-off), 85 (VTOL land), 93 (delay), 178 (change speed)"
    " or of a camera"
)
FAULTS = {
    "a list": (lambda plan: [plan], "{where} = {file}; expected a plan of QGroundControl, an object"),
    "another type": (_set("fileType", "Mission"), 'survey.plan: fileType = "Mission"; expected "Plan"'),
    "no type": (_set("fileType", ...), "survey.plan: fileType is missing; expected a text"),
    "no mission": (_set("mission", ...), "survey.plan: mission is missing; expected an object"),
    "items that are not a list": (
        _set("mission", "items", {}),
        "survey.plan: mission.items = {{}}; expected a list",
    ),
    "no items": (
        _set("mission", "items", []),
        "survey.plan: mission.items = no waypoints; expected at least 1",
    ),
    "no waypoints": (
        _set("mission", "items", [mission_item(206)]),
        "survey.plan: mission.items = no waypoints; expected at least 1",
    ),
    "no home": (
        _set("mission", "plannedHomePosition", ...),
        "survey.plan: mission.plannedHomePosition is missing; expected a list",
    ),
    "home without altitude": (
        _set("mission", "plannedHomePosition", [1, 2]),
        "survey.plan: mission.plannedHomePosition = 2 values; expected 3: latitude, longitude, altitude",
    ),
    "home at the pole": (
        _set("mission", "plannedHomePosition", 0, 90),
        "survey.plan: mission.plannedHomePosition[0] = 90 deg; expected a latitude, -89 to 89 deg",
    ),
    "home in mid air": (
        lambda plan: plan["mission"].update(
            plannedHomePosition=[*plan["mission"]["plannedHomePosition"][:2], None],
            items=[mission_item(16, place_params(0, 0, 9), 0)],
        ),
        "survey.plan: mission.plannedHomePosition[2] = null; expected its altitude, -1000 to 10000 m",
    ),
    "an item that is none": (_set(*ITEM, 7), "survey.plan: mission.items[2] = 7; expected an object"),
    "an item of another type": (
        _set(*ITEM, "type", "SimpelItem"),
        'survey.plan: mission.items[2].type = "SimpelItem"; expected a type of item: ComplexItem, SimpleItem;'
        ' did you mean "SimpleItem"?',
    ),
    "a structure scan": (
        _set("mission", "items", SURVEY_ITEM, "complexItemType", "StructureScan"),
        'survey.plan: mission.items[3].complexItemType = "StructureScan"; expected an item whose waypoints are in the'
        " file: CorridorScan, fwLandingPattern, survey, vtolLandingPattern",
    ),
    "a survey of gates": (
        _set(*INNER, "Items", [mission_item(4501, place_params(1, 1, 50))]),
        "survey.plan: mission.items[3].TransectStyleComplexItem.Items = no waypoints; expected at least 1, as a survey"
        " with turnarounds has",
    ),
    "an unknown command": (
        _set(*ITEM, "command", 300),
        "survey.plan: mission.items[2].command = 300 (mission start); expected one of " + KNOWN,
    ),
    "a jump": (
        _set(*ITEM, "command", 177),
        "survey.plan: mission.items[2].command = 177 (do jump); expected one of " + KNOWN,
    ),
    "a command without a name": (
        _set(*ITEM, "command", 31999),
        "survey.plan: mission.items[2].command = 31999; expected one of " + KNOWN,
    ),
    "another version of plans": (_set("version", 2), "survey.plan: version = 2; expected 1"),
    "another version of missions": (
        _set("mission", "version", 999),
        "survey.plan: mission.version = 999; expected 2",
    ),
    "an item that waits": (
        _set(*ITEM, "autoContinue", False),
        "survey.plan: mission.items[2].autoContinue = false; expected true",
    ),
    "an altitude off the Earth": (
        _set(*ITEM, "params", 6, 1e300),
        "survey.plan: mission.items[2].params[6] = 1e+300 m; expected an altitude, -1000 to 10000 m",
    ),
    "an altitude of home off the Earth": (
        _set("mission", "plannedHomePosition", 2, 1e300),
        "survey.plan: mission.plannedHomePosition[2] = 1e+300 m; expected its altitude, -1000 to 10000 m",
    ),
    "a latitude of home off the Earth": (
        _set("mission", "plannedHomePosition", 0, 214),
        "survey.plan: mission.plannedHomePosition[0] = 214 deg; expected a latitude, -89 to 89 deg",
    ),
    "a speed below nothing": (
        _set("mission", "items", 1, "params", 1, -7),
        "survey.plan: mission.items[1].params[1] = -7 m/s; expected a speed, 0.1 to 100 m/s",
    ),
    "a speed of no kind": (
        _set("mission", "items", 1, "params", 0, 9),
        "survey.plan: mission.items[1].params[0] = 9; expected 0 or 1 (speed of flight), 2 (climb) or 3 (descent)",
    ),
    "a speed to hover at below nothing": (
        _set("mission", "hoverSpeed", -5),
        "survey.plan: mission.hoverSpeed = -5 m/s; expected a speed, 0 to 1000 m/s",
    ),
    "a speed to cruise at that is not a number": (
        _set("mission", "cruiseSpeed", math.nan),
        "survey.plan: mission.cruiseSpeed = NaN m/s; expected a speed, 0 to 1000 m/s",
    ),
    "a delay until a time of day": (
        _set("mission", "items", [mission_item(22, place_params(0, 0, 9)), mission_item(93, [-1, 12, 0, 0])]),
        "survey.plan: mission.items[1].params[0] = -1 s; expected a time to hold, 0 to 86400 s",
    ),
    "loitering nowhere": (
        _set("mission", "items", [mission_item(19, [20])]),
        "survey.plan: mission.items[0].command = 19 (loiter time); expected a take-off or a waypoint before it",
    ),
    "a command of a survey": (
        _set(*INNER, "Items", 1, "command", "16"),
        'survey.plan: mission.items[3].TransectStyleComplexItem.Items[1].command = "16"; expected one of '
        + KNOWN,
    ),
    "no command": (
        _set(*ITEM, "command", ...),
        "survey.plan: mission.items[2].command is missing; expected a number",
    ),
    "a frame of missions": (
        _set(*ITEM, "frame", 2),
        "survey.plan: mission.items[2].frame = 2; expected 0 or 5 (above sea level), 3 or 6 (above home), or 10 or 11"
        " (above terrain)",
    ),
    "a frame that is not a number": (
        _set(*ITEM, "frame", False),
        "survey.plan: mission.items[2].frame = false; expected 0 or 5 (above sea level), 3 or 6 (above home), or 10 or"
        " 11 (above terrain)",
    ),
    "a landing without altitude": (
        lambda plan: plan["mission"]["items"][SURVEY_ITEM].update(
            complexItemType="fwLandingPattern", landCoordinate=[1, 2]
        ),
        "survey.plan: mission.items[3].landCoordinate = 2 values; expected 3",
    ),
    "params of old": (
        _set(*ITEM, "params", [0] * 4),
        "survey.plan: mission.items[2].params = 4 values; expected 7",
    ),
    "no latitude": (
        _set(*ITEM, "params", 4, None),
        "survey.plan: mission.items[2].params[4] = null; expected a latitude, -89 to 89 deg",
    ),
    "a latitude off the Earth": (
        _set(*ITEM, "params", 4, 90.5),
        "survey.plan: mission.items[2].params[4] = 90.5 deg; expected a latitude, -89 to 89 deg",
    ),
    "a latitude that is not a number": (
        _set(*ITEM, "params", 4, math.nan),
        "survey.plan: mission.items[2].params[4] = NaN deg; expected a latitude, -89 to 89 deg",
    ),
    "no altitude": (
        _set(*ITEM, "params", 6, None),
        "survey.plan: mission.items[2].params[6] = null; expected an altitude, -1000 to 10000 m",
    ),
    "no altitude above terrain": (
        lambda plan: plan["mission"]["items"][WAYPOINT_ITEM].update(AltitudeMode=3, Altitude=None),
        "survey.plan: mission.items[2].Altitude = null; expected a height above terrain, -1000 to 10000 m",
    ),
    "a place far away": (
        _set(*ITEM, "params", 5, 0),
        "survey.plan: mission.items[2] = 3874.4 km from home; expected at most 20 km",
    ),
    "a time to hold": (
        _set(*ITEM, "params", 0, -1),
        "survey.plan: mission.items[2].params[0] = -1 s; expected a time to hold, 0 to 86400 s",
    ),
    "a speed of nothing": (
        _set("mission", "items", 1, "params", 1, 0),
        "survey.plan: mission.items[1].params[1] = 0 m/s; expected a speed, 0.1 to 100 m/s",
    ),
    "turns at no speed": (
        lambda plan: plan["mission"].update(
            hoverSpeed=None, items=[mission_item(18, [1, 0, 9, *place_params(0, 0, 9)[3:]])]
        ),
        "survey.plan: mission.hoverSpeed = null; expected a speed, 0.1 to 100 m/s",
    ),
    "a return from nowhere": (
        _set("mission", "items", [mission_item(20)]),
        "survey.plan: mission.items[0].command = 20 (return to launch); expected a take-off or a waypoint before it",
    ),
}


@pytest.mark.parametrize("change, message", FAULTS.values(), ids=FAULTS)
def test_faults_are_named(tmp_path, change, message):
    plan = copy.deepcopy(SURVEY)
    changed = change(plan)
    with pytest.raises(ConfigError) as fault:
        read_mission(tmp_path, plan if changed is None else changed)
    assert str(fault.value) == message.format(where=f"{WHERE}.file", file=tmp_path / "survey.plan")


def test_files_that_cannot_be_read_are_named(tmp_path):
    missing, log = tmp_path / "none.plan", tmp_path / "log.kml"
    broken = tmp_path / "survey.plan"
    faults = {
        missing: f"{WHERE}.file = {missing}; expected a readable file (No such file or directory)",
        log: f"{WHERE}.file = {log}; expected a .plan of QGroundControl or a log as .csv",
        broken: f"{WHERE}.file = {broken}; expected JSON (Expecting value: line 2 column 12 (char 13))",
    }
    broken.write_text('{\n"version": nothing}', encoding="utf-8")
    large, endless, folder = tmp_path / "large.csv", tmp_path / "endless.csv", tmp_path / "folder.csv"
    with open(large, "wb") as file:
        file.truncate((256 << 20) + 1)  # a hole: no disk space
    endless.symlink_to("/dev/zero")
    folder.mkdir()
    faults[large] = f"{WHERE}.file = {large}, 268435457 bytes; expected at most 268435456 bytes (256 MiB)"
    for odd in (endless, folder):
        faults[odd] = f"{WHERE}.file = {odd}; expected a regular file"
    for file, message in faults.items():
        with pytest.raises(ConfigError) as fault:
            read_waypoints(str(file), HOME_M, ground_m, WHERE)
        assert str(fault.value) == message
    for content in (
        "[" * 100_000,
        "",
        "\x00",
        "9" * 5000,
        '{"fileType": "Plan", "version": 1' + "9" * 5000 + "}",
    ):
        with pytest.raises(ConfigError, match="expected JSON"):
            read_mission(tmp_path, content)
    broken.write_bytes(b"\xff\xfe{")
    with pytest.raises(ConfigError, match="expected a text file in UTF-8"):
        read_waypoints(str(broken), HOME_M, ground_m, WHERE)


ODD = [
    None,
    True,
    False,
    -1,
    0,
    3,
    16,
    1e9,
    10**400,
    math.nan,
    -math.inf,
    "",
    "16",
    [],
    [1],
    {},
    {"type": 1},
    "Plan",
]


def _mutated(value, dice):
    """A JSON value with something odd somewhere in it."""
    if isinstance(value, (dict, list)) and value and dice.random() < 0.93:
        key = dice.choice(list(value) if isinstance(value, dict) else range(len(value)))
        if dice.random() < 0.1:
            del value[key]
        else:
            value[key] = _mutated(value[key], dice)
        return value
    return copy.deepcopy(dice.choice(ODD))


def test_malformed_plans_are_refused_and_never_crash(tmp_path):
    dice = random.Random(1)  # of this test alone
    refused = 0
    for _ in range(1500):
        plan = copy.deepcopy(SURVEY)
        for _ in range(dice.randint(1, 3)):
            plan = _mutated(plan, dice)
        try:
            waypoints = read_mission(tmp_path, plan)
            assert np.isfinite([[*w.point_m, w.height_m, w.hold_s] for w in waypoints]).all()
        except ConfigError:
            refused += 1
    assert 300 < refused < 1500
    text = json.dumps(SURVEY)
    for _ in range(500):
        place = dice.randrange(len(text))
        try:
            read_mission(
                tmp_path, text[:place] + dice.choice(["", "9", '"', "}", ",", "-", "e9"]) + text[place + 1 :]
            )
        except ConfigError:
            pass


def test_lists_as_deep_as_can_be_read_are_shown(tmp_path):
    for depth in range(sys.getrecursionlimit() - 200, sys.getrecursionlimit()):
        deep = json.dumps(SURVEY).replace('"Plan"', "[" * depth + "]" * depth)
        with pytest.raises(ConfigError, match=r"^(survey.plan: fileType = \[+…; expected a text$|clips)"):
            read_mission(tmp_path, deep)
