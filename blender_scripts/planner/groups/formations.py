"""Arrangements of people who stand, sit or walk close together, at a position or along a path. Lengths in m.

Members of a formation may be closer than the bodies of other groups: they overlap in views from the side.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..geometry.rotations import heading_of, left_of
from ..geometry.splines import Spot
from ..noise import stream
from .herds import Place, Room

SPACING_M = 0.7  # estimate, by default; personal distance is 0.45 to 1.2 m (Hall 1966)
LEAST_M = 0.35  # estimate: between the centres of people who touch
ON_PATHS = ("queue", "pairs", "row")
_UNEVEN = 0.15  # of the spacing: deviation of members from their positions; estimate, as all below
_TURN_RAD = np.radians(20.0)  # largest deviation of a member from the arrangement's direction
_APART = 3.5  # spacings between pairs
_RANKS = {
    "queue": 1.0,
    "pairs": 2.0,
    "row": 2.0,
}  # spacings between walking ranks: they need space for their legs
_ROOMY = {"pairs": 1.8, "scatter": 1.1}  # radius of the area, in spacings and roots of pairs or members
_BODY_M = 0.35  # half length that a spacing includes; lying bodies are longer
_TRIES = 100

# A member's offset (2,) from the middle of its formation, and the direction (2,) in which it faces.
Stand = tuple[np.ndarray, np.ndarray]


def form(
    formation: str, rooms: Sequence[Room], spacing_m: float, spread_m: float | None, seed: int, name: str
) -> list[Stand]:
    """Positions of the members of a group about its centre; spread_m is the radius of a circle, or of the area."""
    rng = stream(seed, f"formation/{name}")
    turn = rng.uniform(0.0, 2.0 * np.pi)
    stands = _ARRANGEMENTS[formation](rooms, spacing_m, spread_m, rng)
    return [_turned(_unsettled(stand, spacing_m, rng), turn) for stand in stands]


def settle(
    stands: Sequence[Stand], centre_m, fits: Callable[[Spot], bool], reach_m: float, seed: int, name: str
) -> list[Spot]:
    """The spots of a formation about a point, or about the first of points farther and farther off, up to reach_m,
    where all its members fit; none if they fit nowhere.
    """
    rng = stream(seed, f"settle/{name}")
    for k in range(_TRIES):
        middle_m = np.asarray(centre_m, float) + reach_m * k / _TRIES * heading_of(
            rng.uniform(0.0, 2.0 * np.pi)
        )
        spots = [Spot(middle_m + offset_m, facing) for offset_m, facing in stands]
        if all(fits(spot) for spot in spots):
            return spots
    return []


def march(formation: str, count: int, spacing_m: float, path_m: float, seed: int, name: str) -> list[Place]:
    """Positions of members who walk along a path: one behind the other, two by two, or side by side.

    On a loop the last must not run into the first: those that do not fit on a path of length path_m get no position.
    """
    abreast, ranks_m = _abreast(formation, count), _RANKS[formation] * spacing_m
    places = []
    for k in range(count):
        rank, file = divmod(k, abreast)
        if ranks_m * (rank + 1) > path_m:
            break
        uneven_m = _UNEVEN * spacing_m * stream(seed, f"march/{name}", k).uniform(-1.0, 1.0, 2)
        aside_m = spacing_m * (0.5 * (abreast - 1) - file)
        places.append(Place(float(uneven_m[0] - rank * ranks_m), float(aside_m + uneven_m[1])))
    return places


def half_breadth_m(formation: str, count: int, spacing_m: float) -> float:
    """The largest distance of a member from the path."""
    return spacing_m * (0.5 * (_abreast(formation, count) - 1) + _UNEVEN)


def _abreast(formation: str, count: int) -> int:
    return {"queue": 1, "pairs": 2, "row": count}[formation]


def _circle(rooms: Sequence[Room], spacing_m: float, spread_m: float | None, rng: np.random.Generator):
    """Around a point, facing it."""
    count = len(rooms)
    tightest_m = 0.5 * spacing_m / np.sin(np.pi / count) if count > 1 else 0.0
    radius_m = max(tightest_m, spread_m or 0.0)
    turns = (np.arange(count) + _UNEVEN * rng.uniform(-1.0, 1.0, count)) * 2.0 * np.pi / count
    return [(radius_m * heading_of(turn), np.negative(heading_of(turn))) for turn in turns]


def _row(rooms: Sequence[Room], spacing_m: float, _spread_m, _rng):
    """Shoulder to shoulder, facing the same way."""
    return [(np.array([0.0, across_m]), heading_of(0.0)) for across_m in _evenly(len(rooms), spacing_m)]


def _queue(rooms: Sequence[Room], spacing_m: float, _spread_m, _rng):
    """One behind the other."""
    return [(np.array([along_m, 0.0]), heading_of(0.0)) for along_m in _evenly(len(rooms), spacing_m)]


def _pairs(rooms: Sequence[Room], spacing_m: float, spread_m: float | None, rng: np.random.Generator):
    """Two by two in an area, face to face or side by side."""
    count = (len(rooms) + 1) // 2
    area_m = spread_m or _ROOMY["pairs"] * spacing_m * np.sqrt(count)
    middles = _spread_out([0.5 * _APART * spacing_m] * count, area_m, rng)
    stands = []
    for middle_m in middles:
        across, face_to_face = heading_of(rng.uniform(0.0, 2.0 * np.pi)), rng.uniform() < 0.5
        for side in (-1.0, 1.0):
            facing = -side * across if face_to_face else left_of(across)
            stands.append((middle_m + 0.5 * side * spacing_m * across, facing))
    return stands[: len(rooms)]


def _scatter(rooms: Sequence[Room], spacing_m: float, spread_m: float | None, rng: np.random.Generator):
    """Anywhere in an area, in any direction; lying members have as much space as they are long."""
    sizes_m = [0.5 * spacing_m + max(0.0, room.half_length_m - _BODY_M) for room in rooms]
    area_m = spread_m or _ROOMY["scatter"] * float(np.sqrt(np.square(sizes_m).sum())) * 2.0
    return [(at_m, heading_of(rng.uniform(0.0, 2.0 * np.pi))) for at_m in _spread_out(sizes_m, area_m, rng)]


_ARRANGEMENTS = {"circle": _circle, "row": _row, "queue": _queue, "pairs": _pairs, "scatter": _scatter}


def _spread_out(sizes_m: Sequence[float], area_m: float, rng: np.random.Generator) -> list[np.ndarray]:
    """Points in a disc whose distances are at least the sums of their sizes; the disc grows until they fit."""
    points: list[np.ndarray] = []
    while len(points) < len(sizes_m):
        at_m = area_m * np.sqrt(rng.uniform()) * heading_of(rng.uniform(0.0, 2.0 * np.pi))
        size_m = sizes_m[len(points)]
        if all(np.hypot(*(at_m - other_m)) >= size_m + other for other_m, other in zip(points, sizes_m)):
            points.append(at_m)
        area_m *= 1.01
    return points


def _evenly(count: int, spacing_m: float) -> np.ndarray:
    return spacing_m * (0.5 * (count - 1) - np.arange(count))


def _unsettled(stand: Stand, spacing_m: float, rng: np.random.Generator) -> Stand:
    """A small random deviation of position and direction."""
    off_m = 0.5 * _UNEVEN * spacing_m * rng.uniform() * heading_of(rng.uniform(0.0, 2.0 * np.pi))
    return stand[0] + off_m, _rotated(stand[1], _TURN_RAD * rng.uniform(-1.0, 1.0))


def _turned(stand: Stand, turn_rad: float) -> Stand:
    return _rotated(stand[0], turn_rad), _rotated(stand[1], turn_rad)


def _rotated(vector: np.ndarray, turn_rad: float) -> np.ndarray:
    return np.cos(turn_rad) * vector + np.sin(turn_rad) * left_of(vector)
