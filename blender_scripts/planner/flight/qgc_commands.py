"""Interpret the commands of a mission: where to fly, how high, how fast and how long to stay.

Numbers of commands and frames: mavlink.io, common message set, MAV_CMD and MAV_FRAME.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ..faults import ConfigError
from ..plausible import ALTITUDE_M, LATITUDE_DEG, LONGITUDE_DEG, SPEED_M_S
from .geodesy import MOST_AWAY_M, east_north_m
from .qgc_items import LAND, Command
from .texts import checked_number, is_number, shown
from .waypoints import Waypoint

_DAY_S = 86_400.0  # loitering without limit

_WAYPOINT, _LOITER, _TURNS, _TIME, _RETURN, _TAKE_OFF = 16, 17, 18, 19, 20, 22
_LOITER_TO_ALTITUDE, _SPLINE, _VTOL_TAKE_OFF, _VTOL_LAND, DELAY, SPEED = 31, 82, 84, 85, 93, 178
_NAMES = {
    _WAYPOINT: "waypoint",
    _LOITER: "loiter",
    _TURNS: "loiter turns",
    _TIME: "loiter time",
    _RETURN: "return to launch",
    LAND: "land",
    _TAKE_OFF: "take-off",
    _LOITER_TO_ALTITUDE: "loiter to altitude",
    _SPLINE: "spline waypoint",
    _VTOL_TAKE_OFF: "VTOL take-off",
    _VTOL_LAND: "VTOL land",
    DELAY: "delay",
    SPEED: "change speed",
}
_REFUSED = {  # common in missions, for messages
    23: "land local",
    24: "take-off local",
    25: "follow",
    30: "continue and change altitude",
    32: "do follow",
    33: "do follow reposition",
    34: "do orbit",
    35: "do figure eight",
    81: "path planning",
    83: "altitude wait",
    92: "guided enable",
    94: "payload place",
    112: "condition delay",
    113: "condition change altitude",
    114: "condition distance",
    176: "do set mode",
    177: "do jump",
    179: "do set home",
    180: "do set parameter",
    185: "do flight termination",
    186: "do change altitude",
    187: "do set actuator",
    188: "do return path start",
    190: "do rally land",
    191: "do go around",
    192: "do reposition",
    193: "do pause or continue",
    194: "do set reverse",
    208: "do parachute",
    209: "do motor test",
    210: "do inverted flight",
    212: "do autotune enable",
    213: "set yaw speed",
    216: "do sprayer",
    217: "do send script message",
    218: "do auxiliary function",
    221: "do guided master",
    222: "do guided limits",
    223: "do engine control",
    224: "do set mission current",
    300: "mission start",
    400: "arm or disarm",
    600: "jump tag",
    601: "do jump tag",
    4000: "guided submode standard",
    4001: "guided submode circle",
    42600: "do winch",
    42702: "script time",
    42703: "attitude time",
}
# These do not change the flight path: regions of interest, cameras, gimbals and mounts; then the start of a landing, a
# VTOL's transition, and gates, which lie on the way to the next waypoint; the aircraft's heading, relays and servos,
# the switch of the fence, and grippers.
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
IGNORED = _CAMERA | {115, 181, 182, 183, 184, 189, 207, 211, 3000, 4501}
ENDS = {_LOITER, _RETURN, LAND, _VTOL_LAND}  # commands after these are never reached
_LOITERS = {_LOITER, _TURNS, _TIME, _LOITER_TO_ALTITUDE}
_SEA, _HOME, _TERRAIN = {0, 5}, {3, 6}, {10, 11}  # frames, by height reference


@dataclass(frozen=True)
class Home:
    """The start of a mission: latitude and longitude, [x, y] in the scene, and the height of the scene's ground there.

    amsl, m above sea level, and hover_speed, m/s, are those of the file, if given; `where` is the location of the
    mission in its file.
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
        name = _REFUSED.get(command.number) if is_number(command.number) else None
        found = shown(command.number) + (f" ({name})" if name else "")
        raise ConfigError(f"{command.where}.command = {found}; expected one of {known} or of a camera")


def changed_speed(command: Command, before_m_s: float | None) -> float | None:
    """The speed after a command that may change it; None until one is given."""
    kind, speed_m_s = command.params[:2]
    if kind not in (None, 0, 1, 2, 3):
        raise ConfigError(
            f"{command.where}.params[0] = {shown(kind)}; expected 0 or 1 (speed of flight), 2 (climb) or 3 (descent)"
        )
    if speed_m_s == -1:
        return before_m_s
    given_m_s = _param(command, 1, "a speed", *SPEED_M_S, "m/s")
    return before_m_s if kind in (2, 3) else given_m_s


def delay_s(command: Command) -> float:
    """How long a delay holds; until a time of day is not supported."""
    return _param(command, 0, "a time to hold", 0, _DAY_S, "s")


def waypoint_of(
    command: Command, home: Home, before: Sequence[Waypoint], speed_m_s: float | None
) -> Waypoint:
    """The waypoint of a command, with its hold time; `before`: the waypoints so far, flown at speed_m_s."""
    if command.number in (_TAKE_OFF, _VTOL_TAKE_OFF):
        return Waypoint(home.point_m, *_height(command, home))
    if command.number in (_RETURN, LAND, _VTOL_LAND):
        return _last(command, home, before)
    hold_s = _hold_s(command, home, speed_m_s)
    if command.number in _LOITERS and _is_here(command):
        last = _before(command, before)
        stays = command.agl_m is None and command.params[6] in (None, 0)
        height = (last.height_m, last.is_agl) if stays else _height(command, home)
        return Waypoint(last.point_m, *height, hold_s=hold_s)
    return Waypoint(_point(command, home), *_height(command, home), hold_s=hold_s)


def _param(command: Command, k: int, what: str, low: float, high: float, unit: str) -> float:
    return checked_number(command.params[k], f"{command.where}.params[{k}]", what, low, high, unit)


def _hold_s(command: Command, home: Home, speed_m_s: float | None) -> float:
    if command.number == _LOITER:
        return _DAY_S
    if command.number == _LOITER_TO_ALTITUDE:
        return 0.0
    if command.number == _TURNS:
        return _turning_s(command, home, speed_m_s)
    return 0.0 if command.params[0] is None else _param(command, 0, "a time to hold", 0, _DAY_S, "s")


def _turning_s(command: Command, home: Home, speed_m_s: float | None) -> float:
    turns = _param(command, 0, "a number of turns", 0, 1000, "in all")
    radius_m = _param(command, 2, "a radius", -10_000, 10_000, "m")
    if speed_m_s is None:
        speed_m_s = checked_number(home.hover_speed, f"{home.where}.hoverSpeed", "a speed", *SPEED_M_S, "m/s")
    return turns * 2.0 * math.pi * abs(radius_m) / speed_m_s


def _last(command: Command, home: Home, before: Sequence[Waypoint]) -> Waypoint:
    """The end of a flight, at its last height."""
    last = _before(command, before)
    if command.number == _RETURN:
        point_m = home.point_m
    elif _is_here(command):  # lands on the spot
        point_m = last.point_m
    else:
        point_m = _point(command, home)
    return Waypoint(point_m, last.height_m, last.is_agl)


def _before(command: Command, before: Sequence[Waypoint]) -> Waypoint:
    if not before:
        raise ConfigError(
            f"{command.where}.command = {shown(command.number)} ({_NAMES[command.number]});"
            " expected a take-off or a waypoint before it"
        )
    return before[-1]


def _is_here(command: Command) -> bool:
    """Whether a command's position is the aircraft's own."""
    return all(value is None or value == 0 for value in command.params[4:6])


def _point(command: Command, home: Home) -> tuple[float, float]:
    latitude_deg = _param(command, 4, "a latitude", *LATITUDE_DEG, "deg")
    longitude_deg = _param(command, 5, "a longitude", *LONGITUDE_DEG, "deg")
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
    height_m = _param(command, 6, "an altitude", *ALTITUDE_M, "m")
    if command.frame in _TERRAIN:
        return height_m, True
    if command.frame in _SEA:
        where = f"{home.where}.plannedHomePosition[2]"
        height_m -= checked_number(home.amsl, where, "its altitude", *ALTITUDE_M, "m")
    return height_m + home.ground_m, False
