"""Missions of QGroundControl become waypoints, or are refused in exact words."""

import copy
import json
import math
import random
import sys
from pathlib import Path

import numpy as np
import pytest

from veldt.faults import ConfigError
from veldt.flight.waypoint_files import read_waypoints
from veldt.flight.waypoints import Waypoint

FLIGHTS = Path(__file__).resolve().parents[1] / "data" / "flights"
SURVEY = json.loads((FLIGHTS / "survey.plan").read_text(encoding="utf-8"))
HOME_M, GROUND_M = (10.0, -5.0), 8.0
WHERE = "clips[0].flight.waypoints"
WAYPOINT_ITEM, SURVEY_ITEM, RETURN_ITEM = 2, 3, 4


def _ground_m(x_m, y_m):
    """8 m high at home, rising to the east."""
    return GROUND_M + 0.1 * (np.asarray(x_m, float) - HOME_M[0]) + 0.0 * np.asarray(y_m, float)


def _read(folder, content, name="survey.plan"):
    text = content if isinstance(content, str) else json.dumps(content)
    (folder / name).write_bytes(text.encode("utf-8"))
    return read_waypoints(str(folder / name), HOME_M, _ground_m, WHERE)


def _plan(*items):
    """A plan of some items instead of the survey's."""
    plan = copy.deepcopy(SURVEY)
    plan["mission"]["items"] = list(items)
    return plan


def _item(command, params=(), frame=3, **more):
    """A simple item; params beyond the given are 0."""
    params = [*params, *[0] * (7 - len(params))]
    return {
        "autoContinue": True,
        "command": command,
        "frame": frame,
        "params": params,
        "type": "SimpleItem",
    } | more


def _at(east_m, north_m, height_m, hold_s=0):
    """Params of a waypoint so far from home, by a degree's length at its latitude."""
    latitude_deg, longitude_deg, _ = SURVEY["mission"]["plannedHomePosition"]
    return [hold_s, 0, 0, None, latitude_deg + north_m / 110577, longitude_deg + east_m / 111228, height_m]


TAKE_OFF = _item(22, _at(3, 4, 30))


def _near(waypoint, east_m, north_m):
    x_m, y_m = waypoint.point_m
    return math.hypot(x_m - HOME_M[0] - east_m, y_m - HOME_M[1] - north_m) < 0.02


def test_a_survey_is_flown_as_planned():
    waypoints = read_waypoints(str(FLIGHTS / "survey.plan"), HOME_M, _ground_m, WHERE)
    places = [(0, 0), (60, 20), (90, 60), (190, 60), (190, 90), (90, 90), (0, 0)]
    assert all(_near(waypoint, *place) for waypoint, place in zip(waypoints, places, strict=True))
    assert [waypoint.height_m - GROUND_M for waypoint in waypoints] == [40, 50, 60, 60, 60, 60, 60]
    assert [waypoint.hold_s for waypoint in waypoints] == [0, 5, 0, 0, 0, 0, 0]
    assert [waypoint.speed_m_s for waypoint in waypoints] == [8, None, None, None, None, None, None]
    assert not any(waypoint.is_agl for waypoint in waypoints)


@pytest.mark.parametrize(
    "frame, height_m, is_agl",
    [
        (0, 1562 - 1512 + 8, False),
        (5, 58, False),
        (3, 1570, False),
        (6, 1570, False),
        (10, 1562, True),
        (11, 1562, True),
    ],
)
def test_heights_are_above_what_their_frame_says(tmp_path, frame, height_m, is_agl):
    (waypoint,) = _read(tmp_path, _plan(_item(16, _at(100, 0, 1562), frame)))
    assert waypoint.height_m == pytest.approx(height_m, abs=1e-9) and waypoint.is_agl is is_agl


def test_what_follows_another_place_s_hills_follows_the_scene_s(tmp_path):
    single = _item(16, _at(10, 0, 1580), 0, Altitude=45, AltitudeMode=3, AMSLAltAboveTerrain=1580)
    survey = copy.deepcopy(SURVEY["mission"]["items"][SURVEY_ITEM])
    survey["TransectStyleComplexItem"]["CameraCalc"]["DistanceMode"] = 3
    old = copy.deepcopy(SURVEY["mission"]["items"][SURVEY_ITEM])
    old["TransectStyleComplexItem"]["FollowTerrain"] = True
    waypoints = _read(tmp_path, _plan(single, survey, old))
    assert [(waypoint.height_m, waypoint.is_agl) for waypoint in waypoints] == [(45, True)] + [(60, True)] * 8


def test_speeds_count_from_where_they_are_set(tmp_path):
    items = [
        _item(16, _at(10, 0, 50)),
        _item(178, [1, 6]),
        _item(16, _at(20, 0, 50)),
        _item(178, [1, -1]),
        _item(178, [2, 3]),
        _item(16, _at(30, 0, 50)),
    ]
    assert [waypoint.speed_m_s for waypoint in _read(tmp_path, _plan(*items))] == [6, 6, None]
    assert [waypoint.speed_m_s for waypoint in _read(tmp_path, _plan(*items[1:3]))] == [6]


def test_loitering_holds_still(tmp_path):
    items = [
        _item(19, _at(10, 0, 50, hold_s=12)),
        _item(18, [2, 0, -30, *_at(20, 0, 50)[3:]]),
        _item(178, [1, 10]),
        _item(18, [2, 0, 30, *_at(20, 0, 50)[3:]]),
        _item(82, _at(30, 0, 50, hold_s=None)),
        _item(17, _at(40, 0, 50)),
        _item(16, _at(50, 0, 50)),
    ]
    waypoints = _read(tmp_path, _plan(*items))
    turns_m = 2 * 2 * math.pi * 30
    assert [waypoint.hold_s for waypoint in waypoints] == [12, turns_m / 5, turns_m / 10, 0, 86400]
    assert _near(waypoints[-1], 40, 0)


def test_a_flight_ends_where_it_returns_or_lands_at_the_height_it_had(tmp_path):
    last = Waypoint((10.0, -5.0), 30 + GROUND_M, False)
    beyond = _item(16, _at(50, 0, 50))
    assert _read(tmp_path, _plan(TAKE_OFF, _item(20, frame=2), beyond)) == [last, last]
    for end in (_item(21, _at(90, 60, 0)), _item(85, _at(90, 60, 0), None)):
        waypoints = _read(tmp_path, _plan(TAKE_OFF, end, beyond))
        assert len(waypoints) == 2 and _near(waypoints[1], 90, 60) and waypoints[1].height_m == last.height_m
    assert _read(tmp_path, _plan(TAKE_OFF, _item(21))) == [last, last]
    for kind in ("fwLandingPattern", "vtolLandingPattern"):
        pattern = {"type": "ComplexItem", "complexItemType": kind, "landCoordinate": _at(90, 60, 0)[4:]}
        waypoints = _read(tmp_path, _plan(TAKE_OFF, pattern, beyond))
        assert len(waypoints) == 2 and _near(waypoints[1], 90, 60) and waypoints[1].height_m == last.height_m


def test_marks_of_byte_order_and_of_lines_do_not_matter(tmp_path):
    text = (FLIGHTS / "survey.plan").read_text(encoding="utf-8")
    same = _read(tmp_path, "\ufeff" + text.replace("\n", "\r\n"), "MISSION.PLAN")
    assert same == _read(tmp_path, text)


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
    " 82 (spline waypoint), 84 (VTOL take-off), 85 (VTOL land), 178 (change speed) or of a camera"
)
FAULTS = {
    "a list": (lambda plan: [plan], "{where} = {file}; expected a plan of QGroundControl, an object"),
    "another type": (_set("fileType", "Mission"), 'survey.plan: fileType = "Mission"; expected "Plan"'),
    "no type": (_set("fileType", ...), "survey.plan: fileType is missing; expected a text"),
    "no mission": (_set("mission", ...), "survey.plan: mission is missing; expected an object"),
    "items that are no list": (
        _set("mission", "items", {}),
        "survey.plan: mission.items = {{}}; expected a list",
    ),
    "no items": (
        _set("mission", "items", []),
        "survey.plan: mission.items = no waypoints; expected at least 1",
    ),
    "no waypoints": (
        _set("mission", "items", [_item(206)]),
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
            items=[_item(16, _at(0, 0, 9), 0)],
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
        _set(*INNER, "Items", [_item(4501, _at(1, 1, 50))]),
        "survey.plan: mission.items[3].TransectStyleComplexItem.Items = no waypoints; expected at least 1, as a survey"
        " with turnarounds has",
    ),
    "an unknown command": (
        _set(*ITEM, "command", 300),
        "survey.plan: mission.items[2].command = 300; expected one of " + KNOWN,
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
    "a frame that is no number": (
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
        "survey.plan: mission.items[2].params[4] = null; expected a latitude, -90 to 90 deg",
    ),
    "a latitude off the Earth": (
        _set(*ITEM, "params", 4, 90.5),
        "survey.plan: mission.items[2].params[4] = 90.5 deg; expected a latitude, -90 to 90 deg",
    ),
    "a latitude that is no number": (
        _set(*ITEM, "params", 4, math.nan),
        "survey.plan: mission.items[2].params[4] = NaN deg; expected a latitude, -90 to 90 deg",
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
        lambda plan: plan["mission"].update(hoverSpeed=None, items=[_item(18, [1, 0, 9, *_at(0, 0, 9)[3:]])]),
        "survey.plan: mission.hoverSpeed = null; expected a speed, 0.1 to 100 m/s",
    ),
    "a return from nowhere": (
        _set("mission", "items", [_item(20)]),
        "survey.plan: mission.items[0].command = 20 (return to launch); expected a take-off or a waypoint before it",
    ),
}


@pytest.mark.parametrize("change, message", FAULTS.values(), ids=FAULTS)
def test_faults_are_named(tmp_path, change, message):
    plan = copy.deepcopy(SURVEY)
    changed = change(plan)
    with pytest.raises(ConfigError) as fault:
        _read(tmp_path, plan if changed is None else changed)
    assert str(fault.value) == message.format(where=f"{WHERE}.file", file=tmp_path / "survey.plan")


def test_files_that_cannot_be_read_are_named(tmp_path):
    gone, log = tmp_path / "none.plan", tmp_path / "log.kml"
    broken = tmp_path / "survey.plan"
    faults = {
        gone: f"{WHERE}.file = {gone}; expected a readable file (No such file or directory)",
        log: f"{WHERE}.file = {log}; expected a .plan of QGroundControl or a log as .csv",
        broken: f"{WHERE}.file = {broken}; expected JSON (Expecting value: line 2 column 12 (char 13))",
    }
    broken.write_text('{\n"version": nothing}', encoding="utf-8")
    for file, message in faults.items():
        with pytest.raises(ConfigError) as fault:
            read_waypoints(str(file), HOME_M, _ground_m, WHERE)
        assert str(fault.value) == message
    for content in (
        "[" * 100_000,
        "",
        "\x00",
        "9" * 5000,
        '{"fileType": "Plan", "version": 1' + "9" * 5000 + "}",
    ):
        with pytest.raises(ConfigError, match="expected JSON"):
            _read(tmp_path, content)
    broken.write_bytes(b"\xff\xfe{")
    with pytest.raises(ConfigError, match="expected a text file in UTF-8"):
        read_waypoints(str(broken), HOME_M, _ground_m, WHERE)


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
            waypoints = _read(tmp_path, plan)
            assert np.isfinite([[*w.point_m, w.height_m, w.hold_s] for w in waypoints]).all()
        except ConfigError:
            refused += 1
    assert 300 < refused < 1500
    text = json.dumps(SURVEY)
    for _ in range(500):
        place = dice.randrange(len(text))
        try:
            _read(
                tmp_path, text[:place] + dice.choice(["", "9", '"', "}", ",", "-", "e9"]) + text[place + 1 :]
            )
        except ConfigError:
            pass


def test_lists_as_deep_as_can_be_read_are_shown(tmp_path):
    for depth in range(sys.getrecursionlimit() - 200, sys.getrecursionlimit()):
        deep = json.dumps(SURVEY).replace('"Plan"', "[" * depth + "]" * depth)
        with pytest.raises(ConfigError, match=r"^(survey.plan: fileType = \[+…; expected a text$|clips)"):
            _read(tmp_path, deep)
