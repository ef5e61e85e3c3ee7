"""Courses through waypoints: stops, corners, heights, and what cannot be flown."""

import numpy as np
import pytest

from planner.faults import ConfigError
from planner.flight.aircraft import Aircraft
from planner.flight.courses import waypoint_course
from planner.flight.waypoints import Waypoint

COPTER = Aircraft("multirotor", 10.0, np.radians(30))
WING = Aircraft("fixed_wing", 10.0, np.radians(30))
RADIUS_M = WING.turn_radius_m  # 17.66 m
SPIN_RAD_S = np.radians(60)
STEP_S = 0.01
ROUTE = [(0, 0), (100, 0), (180, 70), (60, 150), (0, 150), (0, 300)]


def _flat(x_m, _):
    return np.zeros(len(x_m))


def _to(x_m, y_m, height_m=50.0, is_agl=True, **more):
    return Waypoint((float(x_m), float(y_m)), height_m, is_agl, **more)


def _through(points, aircraft):
    return waypoint_course([_to(*point) for point in points], aircraft, _flat)


def _times(course):
    return np.arange(0.0, course.duration_s, STEP_S)


def test_a_multirotor_visits_every_waypoint():
    course = _through(ROUTE, COPTER)
    ways_m = np.sqrt((np.diff(np.array(ROUTE), axis=0) ** 2).sum(axis=1))
    courses_rad = np.arctan2(*np.diff(np.array(ROUTE), axis=0).T[::-1])
    turns_s = np.concatenate(
        [[0], np.abs(np.diff(courses_rad)) / SPIN_RAD_S]
    )  # none of them over half a turn
    ends_s = np.cumsum(ways_m / 10 + 10 / 3 + turns_s)
    assert course.duration_s == pytest.approx(ends_s[-1])
    assert course.at(ends_s).point_m == pytest.approx(np.array(ROUTE[1:]), abs=1e-6)


def test_holds_and_speeds_of_waypoints():
    waypoints = [_to(0, 0, hold_s=3), _to(100, 0, speed_m_s=5, hold_s=7), _to(200, 0), _to(300, 0)]
    course = waypoint_course(waypoints, COPTER, _flat)
    first_s, slow_s = 100 / 10 + 10 / 3, 100 / 5 + 5 / 3
    assert course.duration_s == pytest.approx(3 + first_s + 7 + 2 * slow_s)
    time_s = np.array([3, 3 + first_s, 10 + first_s, 10 + first_s + slow_s])
    assert course.at(time_s).point_m[:, 0] == pytest.approx([0, 100, 100, 200], abs=1e-9)


def test_a_fixed_wing_changes_its_speed_at_a_waypoint():
    course = waypoint_course([_to(0, 0), _to(100, 0, speed_m_s=20), _to(300, 0)], WING, _flat)
    assert course.duration_s == pytest.approx(100 / 10 + 200 / 20)


def test_a_corner_is_wide_enough_for_the_faster_leg():
    course = waypoint_course([_to(0, 0), _to(200, 0, speed_m_s=20), _to(200, 200)], WING, _flat)
    time_s = np.arange(0, course.duration_s, STEP_S)
    velocity = np.diff(course.at(time_s).point_m, axis=0) / STEP_S
    turn = np.abs(np.diff(course.at(time_s).course_rad)) / STEP_S
    bank_rad = np.arctan(np.sqrt((velocity**2).sum(axis=1)) * turn / 9.80665)
    assert bank_rad.max() == pytest.approx(np.radians(30), rel=1e-5)


def test_a_fixed_wing_rounds_corners_on_tangent_arcs():
    course = _through([(0, 0), (100, 0), (100, 100)], WING)
    assert course.duration_s == pytest.approx((200 - 2 * RADIUS_M + 0.5 * np.pi * RADIUS_M) / 10)
    point_m = course.at(np.array([0.5 * course.duration_s])).point_m[0]
    off_m = RADIUS_M * (np.sqrt(2) - 1)  # how far the middle of the arc is from the corner
    assert point_m == pytest.approx([100 - off_m / np.sqrt(2), off_m / np.sqrt(2)])


def test_straight_on_there_is_no_arc():
    assert _through([(0, 0), (50, 0), (100, 0)], WING).duration_s == pytest.approx(10)


@pytest.mark.parametrize("aircraft", [COPTER, WING])
def test_heights_change_evenly_from_waypoint_to_waypoint(aircraft):
    course = waypoint_course([_to(0, 0, 50), _to(100, 0, 80), _to(100, 100, 20)], aircraft, _flat)
    ride = course.at(_times(course))
    assert ride.is_agl.all()
    assert (ride.height_m[0], ride.height_m.max(), ride.height_m[-1]) == pytest.approx((50, 80, 20), abs=0.1)
    along_m = np.concatenate([[0.0], np.cumsum(np.sqrt((np.diff(ride.point_m, axis=0) ** 2).sum(axis=1)))])
    half_m = 0.5 * along_m[-1]  # by symmetry the second waypoint is passed there
    # The last sample is up to 0.1 m before the end, so half_m is 0.05 m off: 0.03 m of height at 60 m in 100 m.
    assert ride.height_m == pytest.approx(np.interp(along_m, [0, half_m, 2 * half_m], [50, 80, 20]), abs=0.05)


def test_heights_meet_where_their_reference_changes():
    def rising(x_m, y_m):
        return 5.0 + 0.1 * x_m + 0.0 * y_m

    waypoints = [_to(0, 0, 50, True), _to(100, 0, 70, False), _to(200, 0, 30, True)]
    course = waypoint_course(waypoints, COPTER, rising)
    ride = course.at(np.linspace(0, course.duration_s, 401))
    assert list(ride.is_agl[[0, 199, 201, 400]]) == [False, False, True, True]
    above_datum_m = ride.height_m + np.where(ride.is_agl, rising(*ride.point_m.T), 0.0)
    # 50 m above ground is 55 m; to 70 m; from there, 55 m above ground, to 30 m above ground, 55 m above the datum.
    x_m = ride.point_m[:, 0]
    assert above_datum_m == pytest.approx(np.interp(x_m, [0, 100, 200], [55, 70, 55]))


def test_heights_meet_in_the_middle_of_a_rounded_corner():
    waypoints = [_to(0, 0, 50, True), _to(100, 0, 70, False), _to(100, 100, 60, True)]
    course = waypoint_course(waypoints, WING, lambda x_m, y_m: 5.0 + 0.1 * x_m + 0.0 * y_m)
    ride = course.at(_times(course))
    above_datum_m = ride.height_m + np.where(ride.is_agl, 5.0 + 0.1 * ride.point_m[:, 0], 0.0)
    # Each leg is 96 m long; the ground is 15 m high on the second one but for 0.5 m at the corner.
    assert np.abs(np.diff(above_datum_m)).max() <= 15.5 / 96 * 10 * STEP_S * 1.1


def test_waypoints_in_the_same_place_are_one():
    waypoints = [
        _to(0, 0),
        _to(100, 0, 60, hold_s=2),
        _to(100, 0, 90, hold_s=3, speed_m_s=5),
        _to(200, 0, 90),
    ]
    course = waypoint_course(waypoints, COPTER, _flat)
    assert course.duration_s == pytest.approx((100 / 10 + 10 / 3) + 5 + (100 / 5 + 5 / 3))
    assert course.at(np.array([16.0])).height_m == pytest.approx(90)


def test_a_single_waypoint_is_hovered_over_for_ever():
    course = _through([(3, 4), (3, 4)], COPTER)
    assert course.duration_s == np.inf
    ride = course.at(np.array([0.0, 1e5]))
    assert ride.point_m == pytest.approx(np.array([[3, 4], [3, 4]]))
    assert (ride.course_rad == 0).all() and (ride.height_m == 50).all()


def test_courses_turn_the_short_way_and_never_jump():
    # Round a square to the left, many times over: 90 deg at each corner adds up.
    square = [(0, 0), (80, 0), (80, 80), (0, 80)] * 5
    for aircraft in (COPTER, WING):
        course = _through(square, aircraft)
        ride = course.at(_times(course))
        assert np.abs(np.diff(ride.course_rad)).max() <= max(SPIN_RAD_S, 10 / RADIUS_M) * STEP_S * (1 + 1e-6)
        last = course.at(np.array([course.duration_s])).course_rad
        assert last == pytest.approx(18 * np.pi / 2)  # corners


@pytest.mark.parametrize(
    "waypoints, fault",
    [
        (
            [_to(0, 0), _to(15, 0), _to(15, 100)],
            "the leg to waypoint 2 = 15.0 m; expected at least 17.7 m for a fixed wing's turns at its ends",
        ),
        (
            [_to(0, 0), _to(100, 0), _to(100, 0), _to(100, 30), _to(0, 30)],
            "the leg to waypoint 4 = 30.0 m; expected at least 35.4 m for a fixed wing's turns at its ends",
        ),
        (
            [_to(0, 0), _to(100, 0), _to(0, 0)],
            "the turn at waypoint 2 = 180.0 deg; expected at most 175 deg for a fixed wing",
        ),
        (
            [_to(5, 5), _to(5, 5)],
            "the waypoints = 1 place; expected at least 2, since a fixed wing cannot hover",
        ),
        (
            [_to(0, 0), _to(100, 0, hold_s=2.5), _to(200, 0)],
            "the hold at waypoint 2 = 2.5 s; expected 0 s, since a fixed wing cannot hover",
        ),
    ],
)
def test_what_a_fixed_wing_cannot_fly(waypoints, fault):
    with pytest.raises(ConfigError) as raised:
        waypoint_course(waypoints, WING, _flat)
    assert str(raised.value) == fault


def test_legs_as_long_as_asked_for_are_flown():
    assert _through([(0, 0), (17.7, 0), (17.7, 100)], WING).duration_s > 0
    exact = _through([(0, 0), (RADIUS_M, 0), (RADIUS_M, RADIUS_M)], WING)  # nothing but the arc
    assert exact.duration_s == pytest.approx(0.5 * np.pi * RADIUS_M / 10)
