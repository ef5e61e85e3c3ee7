"""Spots for stationary actors: at the shore, in the water, around a point, beside the road."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..geometry.rotations import any_heading, left_of
from ..geometry.splines import Line, Spot
from ..land.corridors import Corridors
from ..land.terrain import Terrain
from ..land.waters import Water
from ..noise import stream
from .collision_discs import Crowd, centres, cover
from .herds import Room

_TRIES = 400  # for each member
_GAP_M = 0.5
_TURN_RAD = np.radians(35.0)  # largest deviation of an animal at the water from facing it
_MARCH_M = 0.25
_ARC = 0.35  # stretch of shore, from end to end, along which a group gathers
_MARGIN_M = 1.0
_ROOM_FACTOR = 3.0  # size of a group's area relative to its bodies if its spread is not given


Draw = Callable[[np.random.Generator, Room], Spot]
Allowed = Callable[[np.ndarray], bool]  # centres (k, 2) of the discs that cover a body


def find_spots(
    rooms: Sequence[Room], draw: Draw, allowed: Allowed, standing: Sequence[Crowd], seed: int, name: str
) -> list[Spot]:
    """A spot for each body that is allowed and overlaps neither another body nor those of `standing`.

    Returns fewer spots if there is no space for all.
    """
    spots: list[Spot] = []
    taken_m, radii_m = _taken(standing)
    for k, room in enumerate(rooms):
        rng = stream(seed, f"spot/{name}", k)
        discs = cover(room.half_length_m, room.half_width_m)
        for _ in range(_TRIES):
            spot = draw(rng, room)
            at_m = centres(discs, spot.point_m[None], spot.heading[None])[0]
            if _is_clear(at_m, discs.radius_m, taken_m, radii_m) and allowed(at_m):
                break
        else:
            return spots
        spots.append(spot)
        taken_m = np.concatenate([taken_m, at_m])
        radii_m = np.concatenate([radii_m, np.full(len(at_m), discs.radius_m)])
    return spots


def fitting(rooms: Sequence[Room], allowed: Allowed, standing: Sequence[Crowd]) -> Callable[[Spot], bool]:
    """Whether the largest of some bodies fits at a spot that is allowed, clear of those of `standing`."""
    discs = cover(max(room.half_length_m for room in rooms), max(room.half_width_m for room in rooms))
    taken_m, radii_m = _taken(standing)

    def fits(spot: Spot) -> bool:
        at_m = centres(discs, spot.point_m[None], spot.heading[None])[0]
        return _is_clear(at_m, discs.radius_m, taken_m, radii_m) and allowed(at_m)

    return fits


def _is_clear(at_m: np.ndarray, radius_m: float, taken_m: np.ndarray, radii_m: np.ndarray) -> bool:
    """Whether discs of one radius keep their gap from those of others, with radii of their own."""
    gaps_m = np.linalg.norm(at_m[:, None] - taken_m, axis=-1) - radius_m - radii_m
    return bool((gaps_m >= _GAP_M).all())


def _taken(standing: Sequence[Crowd]) -> tuple[np.ndarray, np.ndarray]:
    """Centres (n, 2) and radii (n,) of the discs of crowds."""
    return (
        np.concatenate([np.zeros((0, 2)), *(crowd.centre_m[0] for crowd in standing)]),
        np.concatenate([np.zeros(0), *(crowd.radius_m for crowd in standing)]),
    )


def about(centre_m, rooms: Sequence[Room], spread_m: float | None) -> Draw:
    """Anywhere within spread_m of a point, in any direction; the default leaves space for a loose group."""
    if spread_m is None:
        spread_m = _ROOM_FACTOR * float(np.sqrt(sum(room.half_length_m**2 for room in rooms)))

    def draw(rng: np.random.Generator, _: Room) -> Spot:
        off = spread_m * np.sqrt(rng.uniform()) * any_heading(rng)
        return Spot(np.asarray(centre_m, float) + off, any_heading(rng))

    return draw


def at_shore(water: Water, seed: int, name: str) -> Draw:
    """Along a stretch of the shore, with the mouth at the water."""
    middle = 2.0 * np.pi * stream(seed, f"shore/{name}").uniform()

    def draw(rng: np.random.Generator, room: Room) -> Spot:
        angle = middle + 2.0 * np.pi * _ARC * rng.uniform(-0.5, 0.5)
        outward = np.array([np.cos(angle), np.sin(angle)])
        away_m = _shoreline_m(water, outward) + room.half_length_m
        turn = angle + np.pi + _TURN_RAD * rng.uniform(-1.0, 1.0)
        return Spot(water.basin.centre_m + away_m * outward, np.array([np.cos(turn), np.sin(turn)]))

    return draw


def in_water(water: Water) -> Draw:
    """Anywhere in the water, in any direction."""
    return about(water.basin.centre_m, [], water.basin.radius_m)


def along(line: Line, aside_m: float) -> Draw:
    """Anywhere along a line, aside_m to its left, facing along it."""

    def draw(rng: np.random.Generator, _: Room) -> Spot:
        point, heading = line.at(line.length_m * rng.uniform(0.1, 0.9))
        return Spot(point + aside_m * left_of(heading), heading)

    return draw


def on_land(terrain: Terrain, walked: Corridors) -> Allowed:
    """Whether a spot is dry, within the scene, and off the paths of others."""

    def allowed(at_m: np.ndarray) -> bool:
        return bool(
            (terrain.shore_m(*at_m.T) > 0.0).all()
            and (np.abs(at_m) < 0.5 * terrain.size_m - _MARGIN_M).all()
            and walked.is_clear(at_m, _MARGIN_M)
        )

    return allowed


def afloat(terrain: Terrain, depth_m: float) -> Allowed:
    """Whether a spot is in water deep enough to float."""

    def allowed(at_m: np.ndarray) -> bool:
        return bool((terrain.surface_m(*at_m.T) - terrain.height_m(*at_m.T) >= depth_m).all())

    return allowed


def _shoreline_m(water: Water, outward: np.ndarray) -> float:
    """Distance of the shore from the centre of the water in a direction; the largest if there are several."""
    away_m = np.arange(0.0, water.basin.disc_radius_m + _MARCH_M, _MARCH_M)
    wet = water.basin.is_wet(*(water.basin.centre_m + away_m[:, None] * outward).T)
    return float(away_m[wet][-1]) if wet.any() else 0.0
