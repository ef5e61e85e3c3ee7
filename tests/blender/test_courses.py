"""Courses: speeds, turns, stops and repetition."""

import numpy as np
import pytest

from planner.flight.aircraft import Aircraft, aircraft_of
from planner.flight.courses import transect_course, waypoint_course, zigzag_course
from planner.flight.lanes import Footprint
from planner.flight.waypoints import Waypoint

PLAN = {"area_m": [-60, -40, 60, 40], "heading_deg": 0, "lane_spacing_m": 20}
NADIR, AHEAD = Footprint(35.0, -14.0, 14.0), Footprint(40.0, 38.0, 98.0)
COPTER = Aircraft("multirotor", 10.0, np.radians(30))
WING = Aircraft("fixed_wing", 10.0, np.radians(30))
RADIUS_M = WING.turn_radius_m  # 17.66 m
SPIN_RAD_S = np.radians(60)
STEP_S = 0.01


def _flat(x_m, _):
    return np.zeros(len(x_m))


def _through(points, aircraft):
    waypoints = [Waypoint((float(x_m), float(y_m)), 50.0, True) for x_m, y_m in points]
    return waypoint_course(waypoints, aircraft, _flat)


ROUTE = [(0, 0), (100, 0), (180, 70), (60, 150), (0, 150), (0, 300)]
WINGED = {
    "bulbs": zigzag_course(PLAN, WING, NADIR),
    "wide lanes": zigzag_course(PLAN | {"lane_spacing_m": 50, "heading_deg": 25}, WING, NADIR),
    "shifted lanes": zigzag_course(PLAN, WING, AHEAD),
    "transect": transect_course({"points_m": [[10, 20], [-80, 60]]}, WING),
    "waypoints": _through(ROUTE, WING),
}
HOVERING = {
    "zigzag": zigzag_course(PLAN, COPTER, NADIR),
    "shifted lanes": zigzag_course(PLAN, COPTER, AHEAD),
    "one heading": zigzag_course(PLAN, COPTER, AHEAD, nose_turns=False),
    "transect": transect_course({"points_m": [[10, 20], [-80, 60]]}, COPTER),
    "waypoints": _through(ROUTE, COPTER),
}


def _times(course):
    return np.arange(0.0, min(course.duration_s, 300.0), STEP_S)


def _velocity(course):
    return np.diff(course.at(_times(course)).point_m, axis=0) / STEP_S


@pytest.mark.parametrize("name", WINGED)
def test_a_fixed_wing_keeps_its_speed(name):
    speed_m_s = np.sqrt((_velocity(WINGED[name]) ** 2).sum(axis=1))
    assert speed_m_s.max() <= 10 + 1e-8
    # A chord of 0.1 m of a circle of 17.7 m is shorter than its arc by (0.1 / 17.7)^2 / 24 = 1.3e-6.
    assert speed_m_s.min() >= 10 * (1 - 1.4e-6)


@pytest.mark.parametrize("name", WINGED)
def test_a_fixed_wing_flies_where_its_nose_points(name):
    course = WINGED[name]
    course_rad, velocity = course.at(_times(course)).course_rad, _velocity(course)
    middle_rad = 0.5 * (course_rad[1:] + course_rad[:-1])
    off = velocity[:, 0] * np.sin(middle_rad) - velocity[:, 1] * np.cos(middle_rad)
    # A chord of an arc has the mean of its ends' courses. One of 0.1 m that changes from a left turn to a right one in
    # its middle differs from it by a change of curvature of 2 / r, times 0.1 m / 8.
    assert np.abs(off / 10).max() < 2 / RADIUS_M * 0.1 / 8 + 1e-6


@pytest.mark.parametrize("name", WINGED)
def test_a_fixed_wing_never_turns_more_tightly_than_it_can(name):
    turn = np.abs(np.diff(WINGED[name].at(_times(WINGED[name])).course_rad)) / STEP_S
    assert turn.max() <= 10 / RADIUS_M * (1 + 1e-6)
    assert turn.max() >= 10 / RADIUS_M * (1 - 1e-6)  # and as tightly as that


@pytest.mark.parametrize("name", HOVERING)
def test_a_multirotor_keeps_its_limits(name):
    velocity = _velocity(HOVERING[name])
    speed_m_s = np.sqrt((velocity**2).sum(axis=1))
    acceleration_m_s2 = np.sqrt((np.diff(velocity, axis=0) ** 2).sum(axis=1)) / STEP_S
    # Points of some 100 m are rounded to 1e-14 m: 1e-12 m/s and 1e-10 m/s^2.
    assert speed_m_s.max() == pytest.approx(10, abs=1e-8)
    assert acceleration_m_s2.max() == pytest.approx(3, abs=1e-6)


@pytest.mark.parametrize("name", HOVERING)
def test_a_multirotor_turns_on_the_spot_towards_where_it_flies(name):
    course = HOVERING[name]
    course_rad, velocity = course.at(_times(course)).course_rad, _velocity(course)
    turn = np.diff(course_rad) / STEP_S
    assert np.abs(turn).max() <= SPIN_RAD_S * (1 + 1e-9)
    # Within a step a stop may end and a turn begin: at 3 m/s^2 it is 0.015 m/s at most in the mean.
    speed_m_s = np.sqrt((velocity**2).sum(axis=1))
    assert speed_m_s[np.abs(turn) > 1e-9].max(initial=0.0) <= 0.5 * 3 * STEP_S
    if name != "one heading":
        aside = velocity[:, 0] * np.sin(course_rad[:-1]) - velocity[:, 1] * np.cos(course_rad[:-1])
        assert np.abs(aside).max() <= 0.5 * 3 * STEP_S


def test_without_turns_the_nose_keeps_the_lanes_heading():
    course = zigzag_course(PLAN | {"heading_deg": 35}, COPTER, AHEAD, nose_turns=False)
    assert course.at(_times(course)).course_rad == pytest.approx(np.radians(35))
    back = transect_course({"points_m": [[0, 0], [0, 50]]}, COPTER, nose_turns=False)
    assert back.at(_times(back)).course_rad == pytest.approx(np.pi / 2)


@pytest.mark.parametrize("length_m, time_s", [(100, 100 / 10 + 10 / 3), (10, 2 * np.sqrt(10 / 3))])
def test_stop_and_go_takes_its_time(length_m, time_s):
    course = _through([(0, 0), (length_m, 0)], COPTER)
    assert course.duration_s == pytest.approx(time_s)
    half = course.at(np.array([0.0, 0.5 * time_s, time_s, time_s + 1000])).point_m[:, 0]
    assert half == pytest.approx([0, 0.5 * length_m, length_m, length_m])


def test_a_transect_there_and_back_takes_two_half_turns():
    course = transect_course({"points_m": [[0, 0], [100, 0]]}, COPTER)
    way_s, turn_s = 100 / 10 + 10 / 3, np.pi / SPIN_RAD_S
    ride = course.at(np.array([0, way_s, way_s + turn_s, 2 * way_s + turn_s, 2 * (way_s + turn_s)]))
    assert ride.point_m[:, 0] == pytest.approx([0, 100, 100, 0, 0], abs=1e-9)
    assert ride.course_rad == pytest.approx(np.array([0, 0, np.pi, np.pi, 2 * np.pi]), abs=1e-9)


def test_a_zigzag_begins_with_the_first_lane():
    for aircraft in (COPTER, WING):
        ride = zigzag_course(PLAN, aircraft, NADIR).at(np.array([0.0]))
        assert ride.point_m[0] == pytest.approx([-60, -30])
        assert ride.course_rad[0] == pytest.approx(0)
        assert ride.height_m is None and ride.is_agl is None


def test_a_fixed_wing_joins_narrow_lanes_by_bulbs_outside_the_area():
    course = zigzag_course(PLAN, WING, NADIR)
    # Two lanes 20 m apart, turns of radius r: centres of the outer and the middle circle are r + 10 apart across.
    bulb_m = RADIUS_M * (np.pi + 4 * np.arccos((RADIUS_M + 10) / (2 * RADIUS_M)))
    ride = course.at(np.array([12.0, 12.0 + bulb_m / 10]))  # after 120 m
    assert ride.point_m.ravel() == pytest.approx([60, -30, 60, -10])
    assert np.diff(ride.course_rad) == pytest.approx(np.pi)
    between = course.at(np.linspace(12.0, 12.0 + bulb_m / 10, 100)).point_m
    assert between[:, 0].min() >= 60 - 1e-9


def test_a_fixed_wing_joins_wide_lanes_by_quarters_and_a_straight():
    course = zigzag_course(PLAN | {"lane_spacing_m": 50}, WING, NADIR)
    turn_s = (np.pi * RADIUS_M + 50 - 2 * RADIUS_M) / 10
    ride = course.at(np.array([12.0, 12.0 + turn_s]))
    assert ride.point_m.ravel() == pytest.approx([60, -25, 60, 25])


@pytest.mark.parametrize(
    "course", [WINGED["bulbs"], WINGED["transect"], HOVERING["zigzag"], HOVERING["one heading"]]
)
def test_endless_courses_repeat_for_a_day(course):
    start = course.at(np.array([0.0]))
    time_s = _times(course)
    near = np.sqrt(((course.at(time_s).point_m - start.point_m) ** 2).sum(axis=1)) < 0.5 * 10 * STEP_S + 1e-9
    assert course.duration_s == np.inf and near[1000:].any()  # it comes back to where it began
    day_s = 86400 + np.arange(0, 60, STEP_S)
    late = course.at(day_s)
    step_m = np.sqrt((np.diff(late.point_m, axis=0) ** 2).sum(axis=1))
    assert step_m.max() <= 10 * STEP_S + 1e-8
    assert np.abs(np.diff(late.course_rad)).max() <= SPIN_RAD_S * STEP_S * (1 + 1e-6)
    assert (np.abs(late.point_m) <= np.abs(course.at(time_s).point_m).max(axis=0) + 10 * STEP_S).all()


@pytest.mark.parametrize("course", [*WINGED.values(), *HOVERING.values()])
def test_orders_do_not_depend_on_other_queries(course):
    time_s = np.random.Generator(np.random.PCG64(1)).uniform(0, min(course.duration_s, 2000.0), 200)
    ride, backwards = course.at(time_s), course.at(time_s[::-1])
    assert (ride.point_m == backwards.point_m[::-1]).all()
    assert (ride.course_rad == backwards.course_rad[::-1]).all()
    assert (course.at(time_s[:1]).point_m == ride.point_m[:1]).all()


def test_aircraft_of_a_plan():
    plan = {"aircraft": "fixed_wing", "speed_m_s": 20, "bank_deg": 45}
    aircraft = aircraft_of(plan)
    assert aircraft.turn_radius_m == pytest.approx(400 / 9.80665)
    assert aircraft.acceleration_m_s2 == 3
    assert aircraft_of(plan | {"bank_deg": 10}).acceleration_m_s2 == pytest.approx(
        9.80665 * np.tan(np.radians(10))
    )
