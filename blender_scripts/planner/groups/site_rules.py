"""Interpret a group's `place`: where its members may stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..faults import ConfigError, did_you_mean, listing
from ..geometry.splines import Loop
from ..land.corridors import Corridors
from ..land.terrain import Terrain
from ..land.waters import Water
from . import placement
from .behaviours import Draft, behaves

_WATERS = {"water": 0, "shore": 0, "pan": 1, "pan_shore": 1}
_SIDE_GAP_M = 1.0
PLACES = ("water", "shore", "pan", "pan_shore", "road")


@dataclass(frozen=True)
class Land:
    """The ground, and the loops that actors walk, by name."""

    terrain: Terrain
    loops: Mapping[str, Loop]


def venue(
    where: str, group: dict, drafts: Sequence[Draft], land: Land, walked: Corridors, seed: int
) -> tuple[placement.Draw, placement.Allowed]:
    """Functions that draw spots for a group's `place` and test them; `where` is the group's key in the config."""
    place, rooms = group["place"], [draft.room for draft in drafts]
    floats = behaves(group, "float")
    if not isinstance(place, str):
        return placement.about(place, rooms, group.get("spread_m")), placement.on_land(land.terrain, walked)
    if place not in PLACES:
        raise ConfigError(
            f'{where}.place = "{place}"; expected [x, y] or one of {listing(PLACES)}{did_you_mean(place, PLACES)}'
        )
    if floats != (place in ("water", "pan")):
        rule = (
            '"water" or "pan", where one can float' if floats else 'one on dry land, or behaviour = "float"'
        )
        raise ConfigError(f'{where}.place = "{place}"; expected {rule}')
    if place == "road":
        return _by_the_road(where, rooms, land, walked)
    water = _water(where, place, land.terrain)
    if floats:
        depths_m = [draft.scale * draft.body.postures["float"].waterline_m for draft in drafts]
        return placement.in_water(water), placement.afloat(land.terrain, max(depths_m))
    return placement.at_shore(water, seed, group["name"]), placement.on_land(land.terrain, walked)


def _water(where: str, place: str, terrain: Terrain) -> Water:
    number = _WATERS[place]
    if number >= len(terrain.waters):
        key = ("water_radius_m", "pan_radius_m")[number]
        raise ConfigError(f'{where}.place = "{place}"; expected scene.terrain.{key} to be more than 0 m')
    return terrain.waters[number]


def _by_the_road(where: str, rooms, land: Land, walked: Corridors):
    road = land.terrain.road
    if road is None:
        raise ConfigError(
            f'{where}.place = "road"; expected a place with a road: scene.terrain.road has none'
        )
    widest_m = max(room.half_width_m for room in rooms)
    aside_m = 0.5 * road.width_m + widest_m + _SIDE_GAP_M
    return placement.along(road.lines[-1], aside_m), placement.on_land(land.terrain, walked)
