"""Flights as flown: heights, aim, and the effects of wind and gimbal lag."""

import json

import numpy as np
import pytest

from resolved import resolve
from scenes import tiny
from planner.camera import project
from planner.config import ROOT
from planner.geometry.rotations import by_vector
from planner.groups.actors import track
from planner.world import plan_world

RATE_HZ = 8.0


def _fly(frames=480, start_s=0.0, terrain=None, **changes):
    """A tiny world and its only clip's flight; changes are those of a flight plan."""

    def change(config):
        flight = config["clips"][0]["flight"] | {"gimbal": {"lag_s": 0}} | changes
        clip = {"frames": frames, "start_s": start_s, "frame_rate_hz": RATE_HZ, "flight": flight}
        config["clips"] = [config["clips"][0] | clip]
        config["scene"]["terrain"].update(terrain or {})

    world = plan_world(tiny(change))
    return world, world.flight(world.config["clips"][0])


HILLS = {"relief_m": 30, "hill_wavelength_m": 60}


def _position(flight) -> np.ndarray:
    return flight.camera_to_world[:, :3, 3]


def _middle(world, target, time_s) -> np.ndarray:
    """The middle of the bodies (n, 3) of a target."""
    members = [actor for actor in world.actors if target in (actor.name, actor.group)]
    middle = np.mean([track(actor, time_s).position_m for actor in members], axis=0)
    middle[:, 2] += np.mean([actor.bounds_m[:, 2].mean() for actor in members])
    return middle


def test_height_is_kept_above_ground():
    world, flight = _fly(altitude_m=40, speed_m_s=3, climb_rate_m_s=4)
    assert flight.agl_m == pytest.approx(
        _position(flight)[:, 2] - world.terrain.surface_m(*_position(flight)[:, :2].T)
    )
    assert np.abs(flight.agl_m - 40).max() < 1.0


STEEP = {"altitude_m": 40, "speed_m_s": 12, "climb_rate_m_s": 1, "terrain": HILLS, "heading_deg": 30}


@pytest.mark.parametrize("aircraft", ["multirotor", "fixed_wing"])
def test_climbing_and_sinking_is_limited(aircraft):
    _, flight = _fly(**STEEP, aircraft=aircraft)
    climb_m_s = np.abs(np.diff(_position(flight)[:, 2]) * RATE_HZ)
    assert 0.9 < climb_m_s.max() <= 1 + 1e-9


def test_a_multirotor_slows_down_to_keep_its_height_and_a_wing_cannot():
    _, rotors = _fly(**STEEP)
    _, wing = _fly(**STEEP, aircraft="fixed_wing")
    assert np.abs(rotors.agl_m - 40).max() < 3
    assert np.abs(wing.agl_m - 40).max() > 3
    speed_m_s = np.linalg.norm(np.diff(_position(wing)[:, :2], axis=0), axis=1) * RATE_HZ
    assert speed_m_s == pytest.approx(12, rel=0.01)  # chords of turns are shorter than their arcs


def test_over_the_savanna_height_is_held_within_three_metres():
    """Over all hills, gullies and crags, at 12 m/s on average ground with a climb rate of 5 m/s."""
    config = json.loads((ROOT / "configs" / "savanna.json").read_text(encoding="utf-8"))
    config.pop("$schema")
    config["scene"] |= {"plants": {}, "groups": []}
    flight = {"pattern": "zigzag", "area_m": [-600, -600, 600, 600], "heading_deg": 20, "overlap": 0.0}
    clip = {"id": "all_over", "season": "winter", "frames": 16200, "frame_rate_hz": 9, "flight": flight}
    world = plan_world(resolve(config | {"clips": [clip]}))
    flown = world.flight(world.config["clips"][0])
    assert np.abs(flown.agl_m - 61).max() < 3
    assert np.abs(np.diff(_position(flown)[:, 2]) * 9).max() <= 5


def test_height_above_the_datum_is_level():
    _, flight = _fly(altitude_m=55, altitude_reference="datum")
    assert _position(flight)[:, 2] == pytest.approx(55)


def test_look_angle_is_kept():
    _, flight = _fly(look_angle_deg=35)
    assert flight.look_angle_deg == pytest.approx(35)
    assert -flight.camera_to_world[:, 2, 2] == pytest.approx(np.sin(np.radians(35)))


@pytest.mark.parametrize("aircraft, least_deg", [("multirotor", 89.5), ("fixed_wing", 88)])
def test_a_gimbal_holds_nadir_through_the_turns(aircraft, least_deg):
    """Leaning by 17 degrees to brake, or over from 30 to the left to 30 to the right, takes .75 s."""
    _, flight = _fly(frames=900, speed_m_s=6, aircraft=aircraft, gimbal={"lag_s": 0.05})
    assert least_deg < flight.look_angle_deg.min() < 89.9


def test_a_locked_gimbal_looks_one_way():
    _, flight = _fly(look_angle_deg=45, gimbal={"heading": "lock", "heading_deg": 30, "lag_s": 0})
    bearing = np.degrees(np.arctan2(*flight.camera_to_world[:, 1::-1, 2].T))
    assert bearing == pytest.approx(30)


@pytest.mark.parametrize("target", ["herd", "herd_2", "people"])
@pytest.mark.parametrize(
    "changes",
    [
        {"look_angle_deg": 45},
        {"look_angle_deg": 20},
        {"look_angle_deg": 90},
        {"look_angle_deg": 45, "turbulence": "severe", "gimbal": {"lag_s": 0.15}},
    ],
)
def test_following_keeps_the_target_in_the_central_half_for_a_minute_over_hills(target, changes):
    world, flight = _fly(pattern="follow", target=target, altitude_m=30, terrain=HILLS, **changes)
    pixels, depth = project(
        world.intrinsics, flight.camera_to_world, _middle(world, target, flight.time_s)[:, None]
    )
    size = np.array([world.intrinsics.width_px, world.intrinsics.height_px])
    assert np.ptp(world.terrain.heights_m) > 20
    assert (np.abs(pixels[:, 0] - size / 2) < size / 4).all()
    assert depth.min() > 10


def test_a_follower_keeps_to_its_speed():
    """On a loop of 28 m radius the point 60 m ahead of the leader moves faster than the follower may fly."""
    _, flight = _fly(
        pattern="follow", target="people", look_angle_deg=20, altitude_m=30, azimuth_deg=0, speed_m_s=3
    )
    speed_m_s = np.linalg.norm(np.diff(_position(flight)[:, :2], axis=0), axis=1) * RATE_HZ
    assert 2.9 < speed_m_s.max() <= 3 + 1e-9


def test_following_from_an_azimuth():
    world, flight = _fly(pattern="follow", target="herd_1", look_angle_deg=45, altitude_m=30, azimuth_deg=180)
    heading = track(world.actors[2], flight.time_s).heading
    bearing = flight.camera_to_world[:, :2, 2]
    bearing /= np.linalg.norm(bearing, axis=1)[:, None]
    # From behind, the camera looks where the target goes, but for the smoothing of a changing heading.
    assert (heading * bearing).sum(axis=1).min() > np.cos(np.radians(12))


@pytest.mark.parametrize("turn, sense", [("left", 1), ("right", -1)])
def test_an_orbit_keeps_its_distance_and_its_middle_in_the_middle(turn, sense):
    middle = np.array([10.0, -5.0])
    world, flight = _fly(
        pattern="orbit", centre_m=middle.tolist(), radius_m=40, turn=turn, speed_m_s=8, azimuth_deg=90
    )
    off = _position(flight)[:, :2] - middle
    # Poses are linear between moments .02 s apart: (v dt)^2 / (8 r) = 0.08 mm short of the circle.
    assert np.hypot(*off.T) == pytest.approx(40, abs=1e-4)
    angle = np.unwrap(np.arctan2(off[:, 1], off[:, 0]))
    assert angle == pytest.approx(np.pi / 2 + sense * 8 / 40 * flight.time_s, abs=1e-4)
    ground = np.array([*middle, world.terrain.surface_m(*middle)])
    pixels, _ = project(world.intrinsics, flight.camera_to_world, ground[None, None])
    assert pixels[:, 0] == pytest.approx(np.tile(world.intrinsics.centre_px, (len(pixels), 1)), abs=0.01)


def test_an_orbit_goes_around_a_moving_target():
    world, flight = _fly(pattern="orbit", target="herd", radius_m=30, speed_m_s=6)
    off = _position(flight)[:, :2] - _middle(world, "herd", flight.time_s)[:, :2]
    assert np.hypot(*off.T) == pytest.approx(30, abs=1)


WINDY = {"turbulence": "moderate", "gimbal": {"lag_s": 0.1}}


def test_wind_moves_the_camera_and_its_horizon_a_little():
    _, calm = _fly(look_angle_deg=45)
    _, windy = _fly(look_angle_deg=45, **WINDY)
    off_m = np.linalg.norm(_position(windy) - _position(calm), axis=1)
    assert 0.05 < np.sqrt((off_m**2).mean()) < 3
    roll_deg = np.degrees(np.arcsin(windy.camera_to_world[:, 2, 0]))
    assert calm.camera_to_world[:, 2, 0] == pytest.approx(0)
    assert 0.01 < roll_deg.std() < 2


def test_poses_are_rotations_in_any_wind():
    _, flight = _fly(look_angle_deg=45, turbulence="severe", gimbal={"lag_s": 0.5})
    rotation = flight.camera_to_world[:, :3, :3]
    assert rotation @ rotation.transpose(0, 2, 1) == pytest.approx(np.tile(np.eye(3), (480, 1, 1)))
    assert np.linalg.det(rotation) == pytest.approx(1)


@pytest.mark.parametrize(
    "plan",
    [
        {"altitude_m": 40, "speed_m_s": 8},
        {"pattern": "follow", "target": "herd", "look_angle_deg": 45},
        {"pattern": "orbit", "target": "herd", "radius_m": 30},
        {"pattern": "transect", "points_m": [[-40, 0], [40, 10]]},
        {"pattern": "waypoints", "points_m": [[-40, 0], [40, 10], [0, 40], [-40, 0]], "speed_m_s": 2},
    ],
)
def test_a_part_is_the_same_as_in_the_whole(plan):
    """Bit for bit: clips can be cut anywhere, and made anywhere."""
    changes = plan | WINDY | {"climb_rate_m_s": 1}
    _, whole = _fly(frames=320, terrain=HILLS, **changes)
    _, part = _fly(frames=24, start_s=100 / RATE_HZ, terrain=HILLS, **changes)
    assert np.array_equal(part.time_s, whole.time_s[100:124])
    assert np.array_equal(part.camera_to_world, whole.camera_to_world[100:124])


def test_clips_of_one_flight_meet_its_wind_and_others_their_own():
    def change(config):
        plan = config["clips"][0]["flight"] | WINDY
        clip = config["clips"][0] | {"frames": 8, "flight": plan}
        config["clips"] = [clip | {"id": name, "of_flight": "one"} for name in ("a", "b")]
        config["clips"].append(clip | {"id": "c"})

    world = plan_world(tiny(change))
    first, second, other = (world.flight(clip).camera_to_world for clip in world.config["clips"])
    assert np.array_equal(first, second)
    assert not np.array_equal(first, other)


def test_rotations_by_vectors():
    quarter = by_vector(np.array([[0, 0, np.pi / 2], [0, 0, 0], [1e-9, 0, 0]]))
    assert quarter[0] @ [1, 0, 0] == pytest.approx([0, 1, 0])
    assert np.array_equal(quarter[1], np.eye(3))
    assert quarter[2] @ [0, 1, 0] == pytest.approx([0, 1, 1e-9], abs=1e-18)


FLIGHTS = ROOT / "tests" / "data" / "flights"


def test_a_mission_of_qgroundcontrol_flies():
    """Take-off, a faster survey and the way home, over terrain that is unknown to the mission."""
    plan = {"pattern": "waypoints", "waypoints": {"file": str(FLIGHTS / "survey.plan"), "home_m": [0, -100]}}
    terrain = {"size_m": 800, "relief_m": 20, "hill_wavelength_m": 200}
    world, flight = _fly(frames=640, terrain=terrain, look_angle_deg=70, **plan)
    way = _position(flight)
    speed_m_s = np.linalg.norm(np.diff(way[:, :2], axis=0), axis=1) * RATE_HZ
    home_m = world.terrain.surface_m(0, -100)
    assert way[0] == pytest.approx([0, -100, home_m + 40], abs=0.5)
    assert speed_m_s.max() > 5 and speed_m_s.min() < 0.1
    assert flight.agl_m.min() > 20
    assert way[-1, :2] == pytest.approx([0, -100], abs=40)


def test_a_log_is_flown_as_it_was():
    plan = {"pattern": "waypoints", "waypoints": {"file": str(FLIGHTS / "log.csv"), "home_m": [5, 6]}}
    world, flight = _fly(frames=32, **plan)
    assert _position(flight)[0] == pytest.approx([5, 6, world.terrain.surface_m(5, 6) + 40], abs=1e-6)
    assert flight.look_angle_deg[0] == pytest.approx(90)
    # After half a second: yaw 356 deg clockwise from north, pitch -85 deg, roll 0.4 deg.
    forward, right = flight.camera_to_world[4, :3, 2], flight.camera_to_world[4, :3, 0]
    bearing_deg = np.degrees(np.arctan2(forward[1], forward[0]))
    assert flight.look_angle_deg[4] == pytest.approx(85, abs=0.01)
    assert bearing_deg == pytest.approx(90 - 356 + 360, abs=0.01)
    # A roll about the axis sinks the right side by its sine times the cosine of the depression.
    assert -right[2] == pytest.approx(np.sin(np.radians(0.4)) * np.cos(np.radians(85)), rel=0.01)
