"""Footprints of cameras, and lanes that cover an area completely."""

import numpy as np
import pytest

from planner.camera import Intrinsics, centred, look, project
from planner.faults import ConfigError
from planner.flight.aircraft import Aircraft
from planner.flight.courses import zigzag_course
from planner.flight.lanes import (
    Footprint,
    check_lane_spacing,
    footprint,
    half_extents_m,
    lane_spacing_m,
    round_of_lanes,
)

CAMERA = centred(640, 512, 1100.0)
OFF_CENTRE = Intrinsics(640, 512, (1100.0, 1000.0), (250.0, 300.0))
HEIGHT_M = 61.0
PLAN = {"area_m": [-60, -40, 60, 40], "heading_deg": 0, "lane_spacing_m": 20}
NADIR = Footprint(35.0, -14.0, 14.0)


def _seen_at(x_px, y_px, look_angle_deg, camera=CAMERA):
    """Ground point (ahead, left) that is at a picture's point, by cutting its ray with the ground."""
    pose = look(np.array([[0, 0, HEIGHT_M]]), np.array([[1.0, 0.0]]), np.radians([look_angle_deg]))[0]
    (fx_px, fy_px), (cx_px, cy_px) = camera.focal_px, camera.centre_px
    ray = pose[:3, :3] @ [(x_px - cx_px) / fx_px, (y_px - cy_px) / fy_px, 1.0]
    return pose[:2, 3] - ray[:2] * (HEIGHT_M / ray[2])


@pytest.mark.parametrize("look_angle_deg", [90, 75, 45, 20])
def test_footprints_are_what_rays_hit(look_angle_deg):
    seen = footprint(CAMERA, HEIGHT_M, look_angle_deg)
    left, right = _seen_at(0, 512, look_angle_deg), _seen_at(640, 512, look_angle_deg)
    assert seen.width_m == pytest.approx(left[1] - right[1])
    assert seen.near_m == pytest.approx(left[0])
    assert seen.far_m == pytest.approx(_seen_at(320, 0, look_angle_deg)[0])


@pytest.mark.parametrize("look_angle_deg", [90, 75, 45, 20])
def test_footprints_of_a_camera_off_its_axis_are_what_it_sees_flown_either_way(look_angle_deg):
    """Of two lanes side by side, flown to and fro, the narrower halves face each other once in two."""
    seen = footprint(OFF_CENTRE, HEIGHT_M, look_angle_deg)
    left, right = (_seen_at(x_px, 512, look_angle_deg, OFF_CENTRE) for x_px in (0, 640))
    assert seen.width_m == pytest.approx(2 * min(left[1], -right[1]))
    assert 0 < seen.width_m < 0.8 * (left[1] - right[1])
    assert seen.near_m == pytest.approx(left[0])
    assert seen.far_m == pytest.approx(_seen_at(320, 0, look_angle_deg, OFF_CENTRE)[0])


def test_straight_down_the_footprint_is_the_picture_scaled():
    seen = footprint(CAMERA, HEIGHT_M, 90)
    expected = Footprint(61 * 640 / 1100, -61 * 256 / 1100, 61 * 256 / 1100)
    assert (seen.width_m, seen.near_m, seen.far_m) == pytest.approx(
        (expected.width_m, expected.near_m, expected.far_m)
    )


def test_a_picture_with_the_horizon_has_no_end():
    assert footprint(CAMERA, HEIGHT_M, 10).far_m == np.inf  # half of the picture is atan(256 / 1100) = 13 deg
    assert footprint(CAMERA, HEIGHT_M, 14).far_m < np.inf


def test_lanes_fill_the_area_and_lead_back_and_forth():
    lanes = round_of_lanes(PLAN, NADIR, True)
    assert [lane.start for lane in lanes] == pytest.approx(
        [(-60, -30), (60, -10), (-60, 10), (60, 30), (-60, 10), (60, -10)]
    )
    assert [lane.end[0] for lane in lanes] == pytest.approx([60, -60] * 3)
    assert [lane.end[1] for lane in lanes] == pytest.approx([lane.start[1] for lane in lanes])


@pytest.mark.parametrize(
    "heading_deg, half", [(0, (60, 30)), (90, (50, 40)), (180, (60, 30)), (-90, (50, 40))]
)
def test_heading_turns_the_lanes_and_keeps_the_area(heading_deg, half):
    lanes = round_of_lanes(PLAN | {"heading_deg": heading_deg}, NADIR, True)
    assert np.abs([lane.start for lane in lanes]).max(axis=0) == pytest.approx(half)
    way, heading_rad = np.subtract(lanes[0].end, lanes[0].start), np.radians(heading_deg)
    assert way / np.hypot(*way) == pytest.approx([np.cos(heading_rad), np.sin(heading_rad)])


def test_a_slanting_rectangle_holds_the_area():
    half_along_m, half_across_m = half_extents_m(PLAN | {"heading_deg": 30})
    corners = np.array([[x, y] for x in (-60, 60) for y in (-40, 40)])
    cos, sin = np.cos(np.radians(30)), np.sin(np.radians(30))
    assert half_along_m == pytest.approx(np.abs(corners @ [cos, sin]).max())
    assert half_across_m == pytest.approx(np.abs(corners @ [-sin, cos]).max())


def test_overlap_gives_the_spacing_unless_it_is_given():
    assert lane_spacing_m({"overlap": 0.2}, NADIR) == pytest.approx(28)
    assert lane_spacing_m({"overlap": 0.2, "lane_spacing_m": 30}, NADIR) == 30


@pytest.mark.parametrize("spacing_m, lanes", [(80, 2), (40, 2), (40 - 1e-11, 2), (39.9, 3), (20, 4), (19, 5)])
def test_there_are_as_many_lanes_as_the_width_needs(spacing_m, lanes):
    order = round_of_lanes(PLAN | {"lane_spacing_m": spacing_m}, NADIR, True)
    assert len(order) == 2 * (lanes - 1)
    assert len({round(lane.start[1], 6) for lane in order}) == lanes


@pytest.mark.parametrize("nose_turns, back", [(True, (90, -30)), (False, (30, -90))])
def test_lanes_begin_and_end_early_by_what_the_camera_looks_ahead(nose_turns, back):
    lanes = round_of_lanes(PLAN, Footprint(35.0, 30.0, 80.0), nose_turns)
    assert (lanes[0].start[0], lanes[0].end[0]) == pytest.approx((-90, 30))
    assert (lanes[1].start[0], lanes[1].end[0]) == pytest.approx(back)


def _seen_share(plan, aircraft, look_angle_deg, nose_turns=True):
    """Share of area_m that is in some picture of a round, one in 0.4 s."""
    course = zigzag_course(plan, aircraft, footprint(CAMERA, HEIGHT_M, look_angle_deg), nose_turns)
    x0, y0, x1, y1 = plan["area_m"]
    x, y = np.meshgrid(np.linspace(x0, x1, 41), np.linspace(y0, y1, 41))
    ground = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    is_seen = np.zeros(len(ground), bool)
    ride = course.at(np.arange(0.0, 400.0, 0.4))
    bearing_rad = (
        ride.course_rad if nose_turns else np.full(len(ride.course_rad), np.radians(plan["heading_deg"]))
    )
    bearing = np.stack([np.cos(bearing_rad), np.sin(bearing_rad)], axis=1)
    position = np.column_stack([ride.point_m, np.full(len(bearing), HEIGHT_M)])
    for pose in look(position, bearing, np.full(len(bearing), np.radians(look_angle_deg))):
        (u, v), depth = (values.T for values in project(CAMERA, pose, ground))
        is_seen |= (depth > 0) & (u >= 0) & (u <= 640) & (v >= 0) & (v <= 512)
    return is_seen.mean()


AREA = {"area_m": [-70, -50, 60, 70], "overlap": 0.0}


@pytest.mark.parametrize("kind", ["multirotor", "fixed_wing"])
@pytest.mark.parametrize("nose_turns", [True, False])
@pytest.mark.parametrize("look_angle_deg, heading_deg", [(90, 0), (90, 30), (45, 90), (45, -20), (30, 200)])
def test_lanes_show_all_of_the_area(kind, look_angle_deg, heading_deg, nose_turns):
    aircraft = Aircraft(kind, 12.0, np.radians(30))
    plan = AREA | {"heading_deg": heading_deg}
    # Lanes without overlap touch: only a point just between two of them may be missed by rounding.
    assert _seen_share(plan, aircraft, look_angle_deg, nose_turns) >= 0.999


def test_lanes_too_far_apart_leave_gaps():
    aircraft = Aircraft("multirotor", 12.0, np.radians(30))
    width_m = footprint(CAMERA, HEIGHT_M, 90).width_m
    # 1 - 1 / 1.5 of the ground is between lanes 1.5 widths apart, but for the ways from lane to lane.
    assert _seen_share(AREA | {"heading_deg": 0, "lane_spacing_m": 1.5 * width_m}, aircraft, 90) < 0.9


def test_gaps_between_lanes_are_refused():
    seen = Footprint(73.16, -20.0, 20.0)
    check_lane_spacing("clips[0].flight", {"lane_spacing_m": 73.1}, seen)
    check_lane_spacing("clips[0].flight", {"overlap": 0.0}, seen)
    with pytest.raises(ConfigError) as fault:
        check_lane_spacing("clips[0].flight", {"lane_spacing_m": 80}, seen)
    assert str(fault.value) == (
        "clips[0].flight.lane_spacing_m = 80 m; expected at most 73.1 m, the width of ground in the picture"
    )
