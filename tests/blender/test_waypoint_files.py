"""Missions of QGroundControl become waypoints."""

import copy
import math

import pytest

from missions import (
    FLIGHTS,
    GROUND_M,
    HOME_M,
    SURVEY,
    SURVEY_ITEM,
    WHERE,
    ground_m,
    mission_item,
    mission_of,
    place_params,
    read_mission,
)
from planner.flight.waypoint_files import read_waypoints
from planner.flight.waypoints import Waypoint

TAKE_OFF = mission_item(22, place_params(3, 4, 30))


def _near(waypoint, east_m, north_m):
    x_m, y_m = waypoint.point_m
    return math.hypot(x_m - HOME_M[0] - east_m, y_m - HOME_M[1] - north_m) < 0.02


def test_a_survey_is_flown_as_planned():
    waypoints = read_waypoints(str(FLIGHTS / "survey.plan"), HOME_M, ground_m, WHERE)
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
    (waypoint,) = read_mission(tmp_path, mission_of(mission_item(16, place_params(100, 0, 1562), frame)))
    assert waypoint.height_m == pytest.approx(height_m, abs=1e-9) and waypoint.is_agl is is_agl


def test_what_follows_another_place_s_hills_follows_the_scene_s(tmp_path):
    single = mission_item(
        16, place_params(10, 0, 1580), 0, Altitude=45, AltitudeMode=3, AMSLAltAboveTerrain=1580
    )
    survey = copy.deepcopy(SURVEY["mission"]["items"][SURVEY_ITEM])
    survey["TransectStyleComplexItem"]["CameraCalc"]["DistanceMode"] = 3
    old = copy.deepcopy(SURVEY["mission"]["items"][SURVEY_ITEM])
    old["TransectStyleComplexItem"]["FollowTerrain"] = True
    waypoints = read_mission(tmp_path, mission_of(single, survey, old))
    assert [(waypoint.height_m, waypoint.is_agl) for waypoint in waypoints] == [(45, True)] + [(60, True)] * 8


def test_speeds_count_from_where_they_are_set(tmp_path):
    items = [
        mission_item(16, place_params(10, 0, 50)),
        mission_item(178, [1, 6]),
        mission_item(16, place_params(20, 0, 50)),
        mission_item(178, [1, -1]),
        mission_item(178, [2, 3]),
        mission_item(16, place_params(30, 0, 50)),
    ]
    assert [waypoint.speed_m_s for waypoint in read_mission(tmp_path, mission_of(*items))] == [6, 6, None]
    assert [waypoint.speed_m_s for waypoint in read_mission(tmp_path, mission_of(*items[1:3]))] == [6]


def test_loitering_holds_still(tmp_path):
    items = [
        mission_item(19, place_params(10, 0, 50, hold_s=12)),
        mission_item(18, [2, 0, -30, *place_params(20, 0, 50)[3:]]),
        mission_item(178, [1, 10]),
        mission_item(18, [2, 0, 30, *place_params(20, 0, 50)[3:]]),
        mission_item(82, place_params(30, 0, 50, hold_s=None)),
        mission_item(17, place_params(40, 0, 50)),
        mission_item(16, place_params(50, 0, 50)),
    ]
    waypoints = read_mission(tmp_path, mission_of(*items))
    turns_m = 2 * 2 * math.pi * 30
    assert [waypoint.hold_s for waypoint in waypoints] == [12, turns_m / 5, turns_m / 10, 0, 86400]
    assert _near(waypoints[-1], 40, 0)


@pytest.mark.parametrize("here", [[0, 0], [None, None]])
def test_loitering_without_a_place_is_where_the_aircraft_is(tmp_path, here):
    items = [
        mission_item(16, place_params(10, 0, 50)),
        mission_item(19, [20, 0, 0, None, *here, 60]),
        mission_item(18, [2, 0, -30, None, *here, 0]),
        mission_item(31, [1, 30, 0, 1, *here, 70], 10),
        mission_item(17, [0, 0, 0, None, *here, None]),
    ]
    waypoints = read_mission(tmp_path, mission_of(*items))
    assert all(_near(waypoint, 10, 0) for waypoint in waypoints)
    assert [waypoint.hold_s for waypoint in waypoints] == [0, 20, 2 * 2 * math.pi * 30 / 5, 0, 86400]
    heights = [(waypoint.height_m, waypoint.is_agl) for waypoint in waypoints]
    high = (60 + GROUND_M, False)
    assert heights == [(50 + GROUND_M, False), high, high, (70, True), (70, True)]


def test_a_delay_holds_and_what_does_not_move_the_aircraft_is_ignored(tmp_path):
    still = [mission_item(number, [9, 9, 9], 2) for number in (115, 181, 182, 183, 184, 201, 207, 211)]
    items = [
        mission_item(93, [7, -1, -1, -1], 2),  # before the flight
        mission_item(16, place_params(10, 0, 50, hold_s=3)),
        mission_item(93, [10, -1, -1, -1], 2),
        *still,
        mission_item(16, place_params(20, 0, 50)),
    ]
    waypoints = read_mission(tmp_path, mission_of(*items))
    assert [waypoint.hold_s for waypoint in waypoints] == [13, 0]


def test_a_flight_ends_where_it_returns_or_lands_at_the_height_it_had(tmp_path):
    last = Waypoint((10.0, -5.0), 30 + GROUND_M, False)
    beyond = mission_item(16, place_params(50, 0, 50))
    assert read_mission(tmp_path, mission_of(TAKE_OFF, mission_item(20, frame=2), beyond)) == [last, last]
    for end in (mission_item(21, place_params(90, 60, 0)), mission_item(85, place_params(90, 60, 0), None)):
        waypoints = read_mission(tmp_path, mission_of(TAKE_OFF, end, beyond))
        assert len(waypoints) == 2 and _near(waypoints[1], 90, 60) and waypoints[1].height_m == last.height_m
    assert read_mission(tmp_path, mission_of(TAKE_OFF, mission_item(21))) == [last, last]
    for kind in ("fwLandingPattern", "vtolLandingPattern"):
        pattern = {
            "type": "ComplexItem",
            "complexItemType": kind,
            "landCoordinate": place_params(90, 60, 0)[4:],
        }
        waypoints = read_mission(tmp_path, mission_of(TAKE_OFF, pattern, beyond))
        assert len(waypoints) == 2 and _near(waypoints[1], 90, 60) and waypoints[1].height_m == last.height_m


def test_marks_of_byte_order_and_of_lines_do_not_matter(tmp_path):
    text = (FLIGHTS / "survey.plan").read_text(encoding="utf-8")
    same = read_mission(tmp_path, "\ufeff" + text.replace("\n", "\r\n"), "MISSION.PLAN")
    assert same == read_mission(tmp_path, text)
