"""The commands of a QGroundControl plan, in order.

The format: docs.qgroundcontrol.com, developer guide, "Plan File Format". Surveys and corridor scans contain the
commands that QGroundControl generated for them; structure scans do not.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ..faults import ConfigError, check_known
from ..plausible import ALTITUDE_M
from .texts import checked_number, shown

LAND = 21
_WAYPOINTS = (16, 82)
_ABOVE_TERRAIN = (
    3  # QGroundControl's altitude mode in which it computes heights above sea level from its own terrain data
)
_TRANSECTS = ("survey", "CorridorScan")
_LANDINGS = ("fwLandingPattern", "vtolLandingPattern")
_KINDS = {dict: "an object", list: "a list", str: "a text"}


@dataclass(frozen=True)
class Command:
    """A MAVLink mission command: its location in the file, `where`, its number, frame and 7 params, unchanged.

    agl_m: height above ground to fly instead of params[6], which refers to the real terrain.
    """

    where: str
    number: object
    frame: object
    params: list
    agl_m: float | None = None


def part(holder: dict, key: str, kind: type, where: str):
    """holder[key] if present and of type `kind` (dict, list or str); else ConfigError, with `where` before the key."""
    if key not in holder:
        raise ConfigError(f"{where}{key} is missing; expected {_KINDS[kind]}")
    if not isinstance(holder[key], kind):
        raise ConfigError(f"{where}{key} = {shown(holder[key])}; expected {_KINDS[kind]}")
    return holder[key]


def commands_of(mission: dict, where: str) -> Iterator[Command]:
    """The commands of a plan's mission in their order; ConfigError, beginning with `where`, if one is malformed."""
    for k, item in enumerate(part(mission, "items", list, f"{where}mission.")):
        place = f"{where}mission.items[{k}]"
        kind = part(_object(item, place), "type", str, f"{place}.")
        check_known(kind, ("SimpleItem", "ComplexItem"), f"{place}.type", "a type of item")
        if kind == "SimpleItem":
            yield _simple(item, place, _agl_m(item, "AltitudeMode", "Altitude", place))
        else:
            yield from _complex(item, place)


def _simple(item: dict, place: str, agl_m: float | None) -> Command:
    params = part(item, "params", list, f"{place}.")
    if len(params) != 7:
        raise ConfigError(f"{place}.params = {len(params)} values; expected 7")
    for key in ("command", "frame"):
        if key not in item:
            raise ConfigError(f"{place}.{key} is missing; expected a number")
    if not item.get("autoContinue", True):
        raise ConfigError(f"{place}.autoContinue = {shown(item['autoContinue'])}; expected true")
    return Command(place, item["command"], item["frame"], params, agl_m)


def _complex(item: dict, place: str) -> Iterator[Command]:
    kind = part(item, "complexItemType", str, f"{place}.")
    known = (*_TRANSECTS, *_LANDINGS)
    check_known(kind, known, f"{place}.complexItemType", "an item whose waypoints are in the file")
    if kind in _LANDINGS:
        coordinate = part(item, "landCoordinate", list, f"{place}.")
        if len(coordinate) != 3:
            raise ConfigError(f"{place}.landCoordinate = {len(coordinate)} values; expected 3")
        yield Command(f"{place}.landCoordinate", LAND, 3, [None] * 4 + coordinate)
    else:
        yield from _transects(item, place)


def _transects(item: dict, place: str) -> Iterator[Command]:
    inner = part(item, "TransectStyleComplexItem", dict, f"{place}.")
    place = f"{place}.TransectStyleComplexItem"
    camera = inner.get("CameraCalc")
    agl_m = None
    if isinstance(camera, dict):
        old = {"DistanceMode": _ABOVE_TERRAIN} if inner.get("FollowTerrain") is True else {}
        agl_m = _agl_m({**camera, **old}, "DistanceMode", "DistanceToSurface", f"{place}.CameraCalc")
    items = part(inner, "Items", list, f"{place}.")
    commands = [
        _simple(_object(each, f"{place}.Items[{k}]"), f"{place}.Items[{k}]", agl_m)
        for k, each in enumerate(items)
    ]
    if not any(command.number in _WAYPOINTS for command in commands):
        raise ConfigError(
            f"{place}.Items = no waypoints; expected at least 1, as a survey with turnarounds has"
        )
    yield from commands


def _agl_m(item: dict, mode: str, height: str, place: str) -> float | None:
    """The height above ground of an item that has one; its params are then heights above sea level."""
    if item.get(mode) != _ABOVE_TERRAIN:
        return None
    return checked_number(item.get(height), f"{place}.{height}", "a height above terrain", *ALTITUDE_M, "m")


def _object(item, place: str) -> dict:
    if not isinstance(item, dict):
        raise ConfigError(f"{place} = {shown(item)}; expected an object")
    return item
