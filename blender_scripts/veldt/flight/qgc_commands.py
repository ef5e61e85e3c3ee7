"""Interpret the commands of a mission: where to fly, how high, how fast and how long to stay.

Numbers of commands and frames: mavlink.io, common message set, MAV_CMD and MAV_FRAME.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ..faults import ConfigError
from .geodesy import MOST_AWAY_M, east_north_m
from .qgc_items import LAND, Command
from .texts import checked_number, is_number, shown
from .waypoints import Waypoint

_DAY_S = 86_400.0  # loitering without limit

_WAYPOINT, _LOITER, _TURNS, _TIME, _RETURN, _TAKE_OFF = 16, 17, 18, 19, 20, 22
_SPLINE, _VTOL_TAKE_OFF, _VTOL_LAND, SPEED = 82, 84, 85, 178
_NAMES = {
    _WAYPOINT: "waypoint",
    _LOITER: "loiter",
    _TURNS: "loiter turns",
    _TIME: "loiter time",
    _RETURN: "return to launch",
    LAND: "land",
    _TAKE_OFF: "take-off",
    _SPLINE: "spline waypoint",
    _VTOL_TAKE_OFF: "VTOL take-off",
    _VTOL_LAND: "VTOL land",
    SPEED: "change speed",
}
# These do not change where the aircraft flies: regions of interest, cameras, gimbals and mounts; then the start of a
# landing, a VTOL's transition, and gates, which lie on the way to the next waypoint.
_CAMERA = {
    80,
    *range(195, 199),
    *range(200, 207),
    214,
    530,
    531,
    532,
    1000,
    1001,
    2000,
    2001,
    2003,
    2500,
    2501,
}
IGNORED = _CAMERA | {189, 3000, 4501}
ENDS = {_LOITER, _RETURN, LAND, _VTOL_LAND}  # nothing after these is reached
_SEA, _HOME, _TERRAIN = {0, 5}, {3, 6}, {10, 11}  # frames, by height reference


@dataclass(frozen=True)
class Home:
    """The start of a mission: latitude and longitude, [x, y] in the scene, and the height of the scene's ground there.

    amsl, m above sea level, and hover_speed, m/s, are those of the file, if given; `where` is the place of the mission.
    """

    where: str
    origin_deg: tuple[float, float]
    amsl: object
    hover_speed: object
    point_m: tuple[float, float]
    ground_m: float


def check_command(command: Command) -> None:
    """Raise ConfigError if a command is not supported."""
    if not is_number(command.number) or command.number not in _NAMES.keys() | IGNORED:
        known = ", ".join(f"{key} ({name})" for key, name in _NAMES.items())
        raise ConfigError(
            f"{command.where}.command = {shown(command.number)}; expected one of {known} or of a camera"
        )


def changed_speed(command: Command, before_m_s: float | None) -> float | None:
    """The speed after a command that may change it; None until one is given."""
    kind, speed_m_s = command.params[:2]
    if kind in (2, 3) or speed_m_s == -1:  # of climbing or sinking: ignored
        return before_m_s
    return _param(command, 1, "a speed", 0.1, 100, "m/s")


def waypoint_of(
    command: Command, home: Home, before: Sequence[Waypoint], speed_m_s: float | None
) -> Waypoint:
    """The waypoint of a command, with its hold time; `before`: the waypoints so far, flown at speed_m_s."""
    if command.number in (_TAKE_OFF, _VTOL_TAKE_OFF):
        return Waypoint(home.point_m, *_height(command, home))
    if command.number in (_RETURN, LAND, _VTOL_LAND):
        return _last(command, home, before)
    hold_s = _hold_s(command, home, speed_m_s)
    return Waypoint(_point(command, home), *_height(command, home), hold_s=hold_s)


def _param(command: Command, k: int, what: str, low: float, high: float, unit: str) -> float:
    return checked_number(command.params[k], f"{command.where}.params[{k}]", what, low, high, unit)


def _hold_s(command: Command, home: Home, speed_m_s: float | None) -> float:
    if command.number == _LOITER:
        return _DAY_S
    if command.number == _TURNS:
        return _turning_s(command, home, speed_m_s)
    return 0.0 if command.params[0] is None else _param(command, 0, "a time to hold", 0, _DAY_S, "s")


def _turning_s(command: Command, home: Home, speed_m_s: float | None) -> float:
    turns = _param(command, 0, "a number of turns", 0, 1000, "in all")
    radius_m = _param(command, 2, "a radius", -10_000, 10_000, "m")
    if speed_m_s is None:
        speed_m_s = checked_number(home.hover_speed, f"{home.where}.hoverSpeed", "a speed", 0.1, 100, "m/s")
    return turns * 2.0 * math.pi * abs(radius_m) / speed_m_s


def _last(command: Command, home: Home, before: Sequence[Waypoint]) -> Waypoint:
    """The end of a flight, at its last height."""
    if not before:
        raise ConfigError(
            f"{command.where}.command = {shown(command.number)} ({_NAMES[command.number]});"
            " expected a take-off or a waypoint before it"
        )
    if command.number == _RETURN:
        point_m = home.point_m
    elif all(value is None or value == 0 for value in command.params[4:6]):  # lands on the spot
        point_m = before[-1].point_m
    else:
        point_m = _point(command, home)
    return Waypoint(point_m, before[-1].height_m, before[-1].is_agl)


def _point(command: Command, home: Home) -> tuple[float, float]:
    latitude_deg = _param(command, 4, "a latitude", -90, 90, "deg")
    longitude_deg = _param(command, 5, "a longitude", -180, 180, "deg")
    east_m, north_m = map(float, east_north_m(latitude_deg, longitude_deg, home.origin_deg))
    away_m = math.hypot(east_m, north_m)
    if away_m > MOST_AWAY_M:
        raise ConfigError(
            f"{command.where} = {away_m / 1000:.1f} km from home; expected at most {MOST_AWAY_M / 1000:g} km"
        )
    return home.point_m[0] + east_m, home.point_m[1] + north_m


def _height(command: Command, home: Home) -> tuple[float, bool]:
    """The height of a waypoint, and whether it is above ground."""
    if command.agl_m is not None:
        return command.agl_m, True
    if not is_number(command.frame) or command.frame not in _SEA | _HOME | _TERRAIN:
        raise ConfigError(
            f"{command.where}.frame = {shown(command.frame)};"
            " expected 0 or 5 (above sea level), 3 or 6 (above home), or 10 or 11 (above terrain)"
        )
    height_m = _param(command, 6, "an altitude", -1000, 10_000, "m")
    if command.frame in _TERRAIN:
        return height_m, True
    if command.frame in _SEA:
        where = f"{home.where}.plannedHomePosition[2]"
        height_m -= checked_number(home.amsl, where, "its altitude", -1000, 10_000, "m")
    return height_m + home.ground_m, False
