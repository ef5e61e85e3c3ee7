"""Read missions of QGroundControl (.plan files) as waypoints."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..faults import ConfigError
from ..plausible import ALTITUDE_M, LATITUDE_DEG, LONGITUDE_DEG
from .qgc_commands import (
    DELAY,
    ENDS,
    IGNORED,
    SPEED,
    Home,
    changed_speed,
    check_command,
    delay_s,
    waypoint_of,
)
from .qgc_items import commands_of, part
from .texts import checked_number, is_number, read_text, shown
from .waypoints import SurfaceAt, Waypoint


def read_plan(file: str, home_m, ground_m: SurfaceAt, where: str) -> list[Waypoint]:
    """The waypoints of a .plan, at least one; its planned home is mapped to home_m [x, y] of the scene, +y north.

    Heights relative to home are relative to the scene's ground there; so are heights above sea level, less that of
    home. ground_m(x (n,), y (n,)) gives the ground's height (n,) above the datum. Heights that QGroundControl computed
    above its own terrain data are flown above the scene's terrain. A take-off begins over home, at its height.
    Loitering means hovering: for a day if there is no limit, or for as long as the turns would take. A return to launch
    flies to home and a landing to its position, both at the last height, and the flight ends there. Splines are flown
    as straight lines. Loiters and landings at latitude and longitude 0 or null are where the aircraft is; a delay holds
    there. cruiseSpeed and hoverSpeed, from which QGroundControl estimates durations, do not set a speed. Used:
    fileType, version, mission with its version, items, plannedHomePosition and hoverSpeed; of an item, command, frame,
    params, autoContinue, AltitudeMode, Altitude and the waypoints of surveys. Ignored: geoFence, rallyPoints, the kind
    of vehicle, and commands of cameras, headings, relays and servos, which do not move the aircraft. ConfigError if the
    file is not a plan, is of another version, or has a command that cannot be flown, such as a jump, or an invalid
    value; `where` is its key in the config.
    """
    mission, name = _mission(file, where), f"{Path(file).name}: "
    home = _home(mission, f"{name}mission", home_m, ground_m)
    waypoints: list[Waypoint] = []
    speed_m_s = None
    for command in commands_of(mission, name):
        check_command(command)
        if command.number == SPEED:
            speed_m_s = changed_speed(command, speed_m_s)
            waypoints[-1:] = [replace(last, speed_m_s=speed_m_s) for last in waypoints[-1:]]
        elif command.number == DELAY:
            held_s = delay_s(command)
            waypoints[-1:] = [replace(last, hold_s=last.hold_s + held_s) for last in waypoints[-1:]]
        elif command.number not in IGNORED:
            waypoint = waypoint_of(command, home, waypoints, speed_m_s)
            waypoints.append(waypoint if waypoints else replace(waypoint, speed_m_s=speed_m_s))
        if command.number in ENDS:
            break
    if not waypoints:
        raise ConfigError(f"{name}mission.items = no waypoints; expected at least 1")
    return waypoints


def _mission(file: str, where: str) -> dict:
    text, name = read_text(file, where), f"{Path(file).name}: "
    try:
        plan = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ConfigError(f"{where} = {file}; expected JSON ({error})") from error
    if not isinstance(plan, dict):
        raise ConfigError(f"{where} = {file}; expected a plan of QGroundControl, an object")
    kind = part(plan, "fileType", str, name)
    if kind != "Plan":
        raise ConfigError(f'{name}fileType = {shown(kind)}; expected "Plan"')
    mission = part(plan, "mission", dict, name)
    _check_version(plan, name, 1)
    _check_version(mission, f"{name}mission.", 2)
    return mission


def _check_version(holder: dict, where: str, known: int) -> None:
    version = holder.get("version", known)
    if version != known or not is_number(version):
        raise ConfigError(f"{where}version = {shown(version)}; expected {known}")


def _home(mission: dict, where: str, home_m, ground_m: SurfaceAt) -> Home:
    place = f"{where}.plannedHomePosition"
    given = part(mission, "plannedHomePosition", list, f"{where}.")
    if len(given) != 3:
        raise ConfigError(f"{place} = {len(given)} values; expected 3: latitude, longitude, altitude")
    latitude_deg = checked_number(given[0], f"{place}[0]", "a latitude", *LATITUDE_DEG, "deg")
    longitude_deg = checked_number(given[1], f"{place}[1]", "a longitude", *LONGITUDE_DEG, "deg")
    x_m, y_m = map(float, home_m)
    height_m = float(ground_m(np.array([x_m]), np.array([y_m]))[0])
    if given[2] is not None:
        checked_number(given[2], f"{place}[2]", "its altitude", *ALTITUDE_M, "m")
    hover_speed = mission.get("hoverSpeed")
    for key in ("cruiseSpeed", "hoverSpeed"):
        if mission.get(key) is not None:
            checked_number(mission[key], f"{where}.{key}", "a speed", 0, 1000, "m/s")
    return Home(where, (latitude_deg, longitude_deg), given[2], hover_speed, (x_m, y_m), height_m)
