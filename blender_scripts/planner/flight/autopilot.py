"""Fly a plan as closely as the aircraft and the gimbal allow.

1. Every 20 ms from the start of the flight, a course or a pursuit gives a point, a heading and a height above ground.
2. Courses are averaged over 0.74 s, since accelerations, and with them the aircraft's tilt, build up over time. A
   multirotor slows down where these heights change faster than it can climb. `heights` finds how much, and then the
   nearest heights that it can reach, by the largest deviation, averaged over two seconds.
3. `gusts` of the Dryden model push it off its course. It steers back (`disturbance_response`), leaning as far as that
   requires.
4. The gimbal points at the target from the aircraft's actual position with its lag, and compensates its tilt: fully at
   a constant rate, and not at all for changes faster than its lag.
5. Frames take their pose from these samples by linear interpolation (`poses`). A request for later times never changes
   earlier samples, so a clip cut from a flight has the same poses as in the whole flight, wherever it is generated.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..camera import Intrinsics
from ..faults import ConfigError
from ..groups.actors import Actor
from ..land.terrain import Terrain
from .aircraft import FIXED_WING, MULTIROTOR, aircraft_of
from .courses import transect_course, waypoint_course, zigzag_course
from .gusts import WIND_M_S, gusts_m_s
from .heights import follow_heights, look_ahead_s, slowed_times
from .lanes import check_lane_spacing, footprint
from .logs import Log
from .poses import STEP_S, LoggedTrajectory, Poses, SteppedTrajectory, Trajectory
from .pursuits import follow, orbit
from .timetables import Course, Ride
from .disturbance_response import lagged_angles, disturbance_response, tilt_rad, unsteadiness_rad
from .waypoint_files import read_waypoints
from .waypoints import Waypoint

_SPARE_S = 10.0  # of the grid beyond the requested times, for averages that look ahead
_ROUNDING_S = 1e-6
_EASED_STEPS = 37  # 0.74 s: in that time, accelerations of 3 m/s^2 build up by 4 m/s^3, PX4's MPC_JERK_AUTO
_SAMPLES = 9  # of an area's heights, in each direction
_LEAST_RISE_M = 20.0
_LEAST_ARM_M = 1.0  # nearer than this, a target defines no viewing direction


@dataclass(frozen=True)
class Surroundings:
    """The surroundings in which a flight is planned; actors: its targets."""

    terrain: Terrain
    actors: Sequence[Actor]
    intrinsics: Intrinsics
    seed: int


@dataclass(frozen=True)
class Orders:
    """The commanded state at n moments.

    point_m (n, 2); nose_rad (n,); height_m (n,) above the datum, reached as fast as the aircraft can climb; look_rad
    (n,) the camera's bearing where it has no target_m (n, 3).
    """

    point_m: np.ndarray
    nose_rad: np.ndarray
    height_m: np.ndarray
    look_rad: np.ndarray
    target_m: np.ndarray | None = None


def plan_trajectory(where: str, plan: dict, name: str, until_s: float, around: Surroundings) -> Trajectory:
    """The trajectory of a flight plan from time 0 to until_s; its values do not depend on until_s. `name` keys
    turbulence.

    ConfigError, beginning with `where`, if it cannot be flown, or ends before until_s.
    """
    source = _source(f"{where}.flight", plan, around)
    if source is not None and until_s > source.duration_s + _ROUNDING_S:
        raise ConfigError(
            f"{where}: its last frame is at {until_s:.1f} s; expected at most {source.duration_s:.1f} s, when its"
            " flight ends"
        )
    if isinstance(source, Log):
        return LoggedTrajectory(source, around.terrain)
    ahead_s = look_ahead_s(_span_m(plan, source, around.terrain), plan["climb_rate_m_s"]) + _SPARE_S
    time_s = STEP_S * np.arange(int(np.ceil((until_s + ahead_s) / STEP_S)) + 2)
    orders = _pursued(plan, around, time_s) if source is None else _ordered(plan, source, around, time_s)
    return SteppedTrajectory(_flown(plan, name, orders, around.seed))


def _source(where: str, plan: dict, around: Surroundings) -> Course | Log | None:
    """The course of a plan; None if it depends on the target."""
    aircraft, terrain = aircraft_of(plan), around.terrain
    nose_turns = plan["gimbal"]["heading"] == "course"
    if plan["pattern"] == "zigzag":
        seen = footprint(around.intrinsics, _rise_m(plan, terrain), plan["look_angle_deg"])
        check_lane_spacing(where, plan, seen)
        return zigzag_course(plan, aircraft, seen, nose_turns)
    if plan["pattern"] == "transect":
        return transect_course(plan, aircraft, nose_turns)
    if plan["pattern"] != "waypoints":
        return None
    waypoints = _waypoints(where, plan, terrain)
    if isinstance(waypoints, Log):
        return waypoints
    try:
        return waypoint_course(waypoints, aircraft, terrain.surface_m, nose_turns)
    except ConfigError as error:
        raise ConfigError(f"{where}: {error}") from error


def _rise_m(plan: dict, terrain: Terrain) -> float:
    """Approximate height of a zigzag above its area's ground; flights below the ground are reported elsewhere."""
    if plan["altitude_reference"] == "ground":
        return plan["altitude_m"]
    x0_m, y0_m, x1_m, y1_m = plan["area_m"]
    x_m, y_m = np.meshgrid(np.linspace(x0_m, x1_m, _SAMPLES), np.linspace(y0_m, y1_m, _SAMPLES))
    return max(plan["altitude_m"] - float(terrain.surface_m(x_m, y_m).mean()), _LEAST_RISE_M)


def _waypoints(where: str, plan: dict, terrain: Terrain) -> list[Waypoint] | Log:
    if "waypoints" in plan:
        given = plan["waypoints"]
        return read_waypoints(given["file"], given["home_m"], terrain.surface_m, f"{where}.waypoints")
    is_agl = plan["altitude_reference"] == "ground"
    return [
        Waypoint((x_m, y_m), height[0] if height else plan["altitude_m"], is_agl)
        for x_m, y_m, *height in plan["points_m"]
    ]


def _ordered(plan: dict, course: Course, around: Surroundings, time_s: np.ndarray) -> Orders:
    ride = course.at(time_s)
    wanted_m = _wanted_m(plan, ride, around.terrain)
    if plan["aircraft"] == MULTIROTOR:
        flown_s = slowed_times(wanted_m, STEP_S, plan["climb_rate_m_s"])
        if not np.array_equal(flown_s, time_s):
            ride = course.at(flown_s)
            wanted_m = _wanted_m(plan, ride, around.terrain)
    locked_rad = np.radians(plan["gimbal"].get("heading_deg", plan["heading_deg"]))
    is_locked = plan["gimbal"]["heading"] == "lock"
    look_rad = np.full(len(time_s), locked_rad) if is_locked else ride.course_rad
    return Orders(_eased(ride.point_m), ride.course_rad, wanted_m, look_rad)


def _eased(point_m: np.ndarray) -> np.ndarray:
    """Points (n, 2) of a course as means over _EASED_STEPS, because no aircraft tilts instantly.

    Uniform motion and standstill are unchanged; a multirotor that brakes is 7 cm off, a wing in a turn 13 cm. Before
    the first point and after the last one it flies on.
    """
    half = _EASED_STEPS // 2
    beyond = np.arange(1, half + 1)[:, None]
    before_m = point_m[0] - beyond[::-1] * (point_m[1] - point_m[0])
    around_m = np.concatenate([before_m, point_m, point_m[-1] + beyond * (point_m[-1] - point_m[-2])])
    off_m = sum(around_m[k : k + len(point_m)] - point_m for k in range(_EASED_STEPS))
    return point_m + off_m / _EASED_STEPS


def _span_m(plan: dict, course: Course | None, terrain: Terrain) -> float:
    """An upper bound for the range of the requested heights."""
    highest_m = abs(plan["altitude_m"])
    if course is not None and np.isfinite(course.duration_s):
        given_m = course.at(np.arange(0.0, course.duration_s + 1.0)).height_m
        highest_m = max(highest_m, float(np.abs(given_m).max()))
    return float(np.ptp(terrain.heights_m)) + 3.0 * highest_m


def _wanted_m(plan: dict, ride: Ride, terrain: Terrain) -> np.ndarray:
    """The requested heights (n,) above the datum."""
    height_m = ride.height_m if ride.height_m is not None else np.full(len(ride.point_m), plan["altitude_m"])
    is_agl = ride.is_agl if ride.is_agl is not None else plan["altitude_reference"] == "ground"
    return height_m + np.where(is_agl, terrain.surface_m(*ride.point_m.T), 0.0)


def _pursued(plan: dict, around: Surroundings, time_s: np.ndarray) -> Orders:
    surface_m = around.terrain.surface_m
    if plan["pattern"] == "follow":
        pursuit = follow(plan, around.actors, time_s)
    else:
        pursuit = orbit(plan, around.actors, surface_m, time_s)
    is_agl = plan["altitude_reference"] == "ground"
    height_m = plan["altitude_m"] + (surface_m(*pursuit.point_m.T) if is_agl else np.zeros(len(time_s)))
    looks_down = plan["pattern"] == "follow" and plan["look_angle_deg"] == 90
    return Orders(
        pursuit.point_m,
        pursuit.bearing_rad,
        height_m,
        pursuit.bearing_rad,
        None if looks_down else pursuit.target_m,
    )


def _flown(plan: dict, name: str, orders: Orders, seed: int) -> Poses:
    """Orders as carried out: climb limits, gusts, aim and gimbal lag."""
    lag_s = plan["gimbal"]["lag_s"]
    height_m = follow_heights(orders.height_m, STEP_S, plan["climb_rate_m_s"])
    offset_m, control_m_s2 = _blown(plan, name, orders.nose_rad, seed)
    position_m = np.column_stack([orders.point_m, height_m]) + offset_m
    bearing_rad, depression_rad = _aim(plan, orders, position_m)
    acceleration_m_s2 = _second_derivative(orders.point_m) + control_m_s2[:, :2]
    if plan["aircraft"] == FIXED_WING:  # a wing banks, and accelerates without pitching
        acceleration_m_s2 = _across(acceleration_m_s2, orders.nose_rad)
    return Poses(
        position_m,
        lagged_angles(bearing_rad, lag_s, STEP_S),
        lagged_angles(depression_rad, lag_s, STEP_S),
        unsteadiness_rad(tilt_rad(acceleration_m_s2), lag_s, STEP_S),
    )


def _blown(plan: dict, name: str, nose_rad: np.ndarray, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Displacement by gusts (n, 3) and the aircraft's acceleration against them (n, 3), in world axes."""
    if plan["turbulence"] == "none":
        return np.zeros((len(nose_rad), 3)), np.zeros((len(nose_rad), 3))
    airspeed_m_s = float(np.hypot(plan["speed_m_s"], WIND_M_S[plan["turbulence"]]))
    gusts = gusts_m_s(seed, name, plan["turbulence"], plan["altitude_m"], airspeed_m_s, len(nose_rad), STEP_S)
    swayed = disturbance_response(gusts, STEP_S, plan["aircraft"])
    return _turned(swayed.offset_m, nose_rad), _turned(swayed.control_m_s2, nose_rad)


def _aim(plan: dict, orders: Orders, position_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unwrapped bearings and depressions (n,) of a perfect gimbal."""
    if orders.target_m is None:
        return orders.look_rad, np.full(len(position_m), np.radians(plan["look_angle_deg"]))
    way_m = orders.target_m - position_m
    level_m = np.hypot(way_m[:, 0], way_m[:, 1])
    off_rad = np.arctan2(way_m[:, 1], way_m[:, 0]) - orders.look_rad
    off_rad -= 2.0 * np.pi * np.round(off_rad / (2.0 * np.pi))
    bearing_rad = orders.look_rad + np.where(level_m > _LEAST_ARM_M, off_rad, 0.0)
    return bearing_rad, np.arctan2(-way_m[:, 2], level_m)


def _second_derivative(point_m: np.ndarray) -> np.ndarray:
    inner = (point_m[2:] - 2.0 * point_m[1:-1] + point_m[:-2]) / STEP_S**2
    return np.concatenate([inner[:1], inner, inner[-1:]])


def _across(vectors: np.ndarray, nose_rad: np.ndarray) -> np.ndarray:
    """The components of vectors (n, 2) perpendicular to the nose."""
    left = np.stack([-np.sin(nose_rad), np.cos(nose_rad)], axis=-1)
    return (vectors * left).sum(axis=-1, keepdims=True) * left


def _turned(vectors: np.ndarray, angle_rad: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) rotated about the vertical, each by its angle."""
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)
    x, y, z = vectors.T
    return np.stack([cos * x - sin * y, sin * x + cos * y, z], axis=-1)
