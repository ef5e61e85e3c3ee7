"""Flights: lanes, turns, heights and aim."""

import numpy as np
import pytest

from scenes import tiny
from veldt.groups.actors import track
from veldt.camera import project
from veldt.flight import zigzag
from veldt.world import plan_world

PLAN = {"area_m": [-60, -40, 60, 40], "heading_deg": 0, "lane_spacing_m": 20, "speed_m_s": 10}
LANE_S, TURN_S = 12.0, np.pi * 10 / 10  # 120 m lanes; half circles of 10 m radius


def _fly(**changes):
    def change(config):
        flight = config["clips"][0]["flight"] | changes
        config["clips"] = [config["clips"][0] | {"frames": 120, "frame_rate_hz": 4, "flight": flight}]

    world = plan_world(tiny(change))
    return world, world.flight(world.config["clips"][0])


def test_lanes_fill_the_area_and_lead_back_and_forth():
    starts = (LANE_S + TURN_S) * np.arange(8)
    point, direction = zigzag(PLAN, starts)
    assert point[:, 1] == pytest.approx([-30, -10, 10, 30, 10, -10, -30, -10])
    assert point[:, 0] == pytest.approx([-60, 60] * 4)
    assert direction[:, 0] == pytest.approx([1, -1] * 4)


def test_speed_is_constant_and_direction_is_that_of_flight():
    time_s = np.arange(0, 150, 0.01)
    point, direction = zigzag(PLAN, time_s)
    step = np.diff(point, axis=0)
    # On a turn a chord of 0.1 m is shorter than its arc by (0.1 / 10)^2 / 24 = 4e-6.
    assert np.linalg.norm(step, axis=1) == pytest.approx(0.1, rel=1e-5)
    assert (step * direction[:-1]).sum(axis=1) / 0.1 == pytest.approx(1, abs=1e-4)


def test_turns_are_half_circles_outside_the_area():
    point, _ = zigzag(PLAN, LANE_S + np.linspace(0, TURN_S, 30))
    assert np.hypot(point[:, 0] - 60, point[:, 1] + 20) == pytest.approx(10)
    assert point[:, 0].min() >= 60 - 1e-9


@pytest.mark.parametrize(
    "heading_deg, half", [(0, (60, 30)), (90, (50, 40)), (180, (60, 30)), (-90, (50, 40))]
)
def test_heading_turns_the_lanes_and_keeps_the_area(heading_deg, half):
    point, _ = zigzag(PLAN | {"heading_deg": heading_deg}, np.arange(0, 400, 0.1))
    lanes = np.abs(point).max(axis=0)
    turn = 10  # turns stand out by their radius along the lanes
    along = 1 if heading_deg % 180 else 0
    expected = list(half)
    expected[along] += turn
    assert lanes == pytest.approx(expected, abs=0.2)


def test_height_is_kept_above_the_smoothed_ground():
    world, flight = _fly(altitude_m=40)
    x, y, z = flight.camera_to_world[:, :3, 3].T
    assert z - world.terrain.smooth_surface_m(x, y) == pytest.approx(40)
    assert flight.agl_m == pytest.approx(z - world.terrain.surface_m(x, y))
    assert np.ptp(flight.agl_m) > 0


def test_height_above_the_datum_is_level():
    _, flight = _fly(altitude_m=55, altitude_reference="datum")
    assert flight.camera_to_world[:, 2, 3] == pytest.approx(55)


def test_look_angle_is_kept():
    _, flight = _fly(look_angle_deg=35)
    assert flight.look_angle_deg == pytest.approx(35)
    assert -flight.camera_to_world[:, 2, 2] == pytest.approx(np.sin(np.radians(35)))


@pytest.mark.parametrize("target", ["herd", "herd_2", "people"])
@pytest.mark.parametrize("look_angle_deg", [30, 90])
def test_following_keeps_the_target_in_the_middle(target, look_angle_deg):
    world, flight = _fly(pattern="follow", target=target, look_angle_deg=look_angle_deg, altitude_m=30)
    members = [actor for actor in world.actors if target in (actor.name, actor.group)]
    walks = [track(actor, flight.time_s) for actor in members]
    middle = np.mean([w.position_m for w in walks], axis=0)
    middle[:, 2] += np.mean([actor.bounds_m[:, 2].mean() for actor in members])
    pixels, depth = project(world.intrinsics, flight.camera_to_world, middle[:, None])
    # Smoothing over +-2 s cuts corners: at 1.4 m/s on a loop of 15 m radius or more by (2.8 m)^2 / (6 * 15 m) = 9 cm
    # across, and the ground's roughness adds some cm: 0.3 m at 30 m and 130 px is 1.3 px.
    assert np.abs(pixels[:, 0] - world.intrinsics.centre_px).max() < 1.3
    assert depth.min() > 20


def test_following_above_the_datum_keeps_the_look_angle():
    _, flight = _fly(
        pattern="follow", target="herd", look_angle_deg=50, altitude_m=35, altitude_reference="datum"
    )
    assert flight.camera_to_world[:, 2, 3] == pytest.approx(35)
    assert flight.look_angle_deg == pytest.approx(50)


def test_following_from_an_azimuth():
    world, flight = _fly(pattern="follow", target="herd_1", look_angle_deg=45, altitude_m=30, azimuth_deg=180)
    heading = track(world.actors[2], flight.time_s).heading
    bearing = (
        flight.camera_to_world[:, :2, 2] / np.linalg.norm(flight.camera_to_world[:, :2, 2], axis=1)[:, None]
    )
    # From behind, the camera looks where the target goes, but for the smoothing of a changing heading.
    assert (heading * bearing).sum(axis=1).min() > np.cos(np.radians(10))
