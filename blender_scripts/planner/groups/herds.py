"""Formation of the members of a group, such that no member ever walks into another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..noise import stream

_GAP_M = 0.4  # between two bodies side by side
_UNEVEN = 0.25  # of the spacing: deviation of members from equidistant positions
_DRAWS = 12  # tries for a position beside the path, before a member falls back
_BACK_M = 0.5


@dataclass(frozen=True)
class Room:
    """The footprint of a body: half its length and width, and how far its schedule moves it from its position."""

    half_length_m: float
    half_width_m: float
    reach_m: float = 0.0


@dataclass(frozen=True)
class Place:
    """A member's position: along_m ahead of the group's first member, usually negative, and lateral_m to the left."""

    along_m: float
    lateral_m: float


def plan_places(
    rooms: Sequence[Room],
    spacing_m: float,
    spread_m: float,
    path_m: float,
    seed: int,
    name: str,
    shrink: float = 1.0,
) -> list[Place]:
    """Positions of a group's members, about spacing_m apart along, and up to spread_m beside, a path of length path_m.

    A member that does not fit drops back until it does. On a loop, the last member must not run into the first: members
    for which the loop is too short get no position. `shrink` is the fraction of a distance along the path that remains
    on the inside of its tightest curve.
    """
    places: list[Place] = []
    for k, room in enumerate(rooms):
        rng = stream(seed, f"place/{name}", k)
        uneven_m = _UNEVEN * spacing_m * rng.uniform(-1.0, 1.0) if k else 0.0
        along_m = uneven_m - k * spacing_m
        fitting: list[float] = []
        while not fitting:
            longest_m = _length_m([*zip(rooms, places), (room, Place(along_m, 0.0))])
            if shrink * longest_m > path_m:
                return places
            laterals = spread_m * rng.uniform(-1.0, 1.0, _DRAWS)
            fitting = [y for y in laterals if _fits(room, along_m, y, rooms, places, shrink)]
            along_m -= 0.0 if fitting else _BACK_M
        places.append(Place(float(along_m), float(fitting[0])))
    return places


def _length_m(placed: Sequence[tuple[Room, Place]]) -> float:
    """Length of the path that a group occupies, from the first nose to the last tail."""
    first = max(place.along_m + room.half_length_m + room.reach_m for room, place in placed)
    last = min(place.along_m - room.half_length_m - room.reach_m for room, place in placed)
    return first - last + _GAP_M


def _fits(
    room: Room,
    along_m: float,
    lateral_m: float,
    rooms: Sequence[Room],
    places: Sequence[Place],
    shrink: float,
) -> bool:
    """Whether a member at this position is clear of all members already placed."""
    return all(
        shrink * (abs(along_m - p.along_m) - room.reach_m - r.reach_m)
        >= room.half_length_m + r.half_length_m + _GAP_M
        or abs(lateral_m - p.lateral_m) >= room.half_width_m + r.half_width_m + _GAP_M
        for r, p in zip(rooms, places)
    )
