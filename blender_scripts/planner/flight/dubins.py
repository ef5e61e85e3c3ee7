"""The shortest path between two positions and courses with a minimum turn radius.

L. E. Dubins, "On curves of minimal length with a constraint on average curvature, and with prescribed initial and
terminal positions and tangents", American Journal of Mathematics 79 (1957): it is one of six words of left turns L,
right turns R and straight lines S: LSL, RSR, LSR, RSL, LRL, RLR.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .path_segments import NOTHING_M, Arc, Piece, Point, Straight, beside

_WHOLE_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class Word:
    """First turn, middle and last turn: angles in rad, a straight middle in radii. `first` and `last`: L or R."""

    first: str
    last: str
    is_straight: bool
    amounts: tuple[float, float, float]

    @property
    def length(self) -> float:
        """In radii."""
        return sum(self.amounts)

    @property
    def name(self) -> str:
        """LSL, RSR, LSR, RSL, LRL or RLR."""
        middle = "S" if self.is_straight else _OTHER[self.first]
        return self.first + middle + self.last


_OTHER = {"L": "R", "R": "L"}
_SIDE = {"L": 1.0, "R": -1.0}


def shortest(start: Point, start_rad: float, end: Point, end_rad: float, radius_m: float) -> list[Piece]:
    """Pieces of the shortest path; empty if start and end coincide. Of paths of equal length, the first in `words`."""
    best: Word | None = None
    for word in words(start, start_rad, end, end_rad, radius_m):
        # Rounding must not choose between paths that are mirror images of each other.
        if best is None or word.length < best.length - 1e-9:
            best = word
    assert best is not None, "LSL and RSR always exist"
    return _pieces(best, start, start_rad, end, end_rad, radius_m)


def words(start: Point, start_rad: float, end: Point, end_rad: float, radius_m: float) -> Iterator[Word]:
    """All words that lead there, in the order LSL, RSR, LSR, RSL, LRL, RLR; those that do not exist are left out."""
    cos, sin = math.cos(start_rad), math.sin(start_rad)
    dx, dy = (end[0] - start[0]) / radius_m, (end[1] - start[1]) / radius_m
    x, y, turn = dx * cos + dy * sin, dy * cos - dx * sin, end_rad - start_rad
    nothing = NOTHING_M / radius_m
    for find in (_same_side, _other_side, _three_turns):
        # A path that starts to the right is the mirror image of one that starts to the left.
        yield from find(x, y, turn, nothing, "L")
        yield from find(x, -y, -turn, nothing, "R")


def _same_side(x: float, y: float, turn: float, nothing: float, first: str) -> Iterator[Word]:
    """LSL to (x, y) and course `turn` from (0, 0) and course 0; radius 1."""
    cx, cy = x - math.sin(turn), y + math.cos(turn) - 1.0  # between the circles' centres
    straight = math.sqrt(cx * cx + cy * cy)
    if straight < nothing:  # one circle: the direction of the straight line would be a rounding error
        yield Word(first, first, True, (_positive(turn, nothing), 0.0, 0.0))
        return
    course = math.atan2(cy, cx)
    yield Word(first, first, True, (_positive(course, nothing), straight, _positive(turn - course, nothing)))


def _other_side(x: float, y: float, turn: float, nothing: float, first: str) -> Iterator[Word]:
    """LSR: its straight line crosses the line between the centres."""
    cx, cy = x + math.sin(turn), y - math.cos(turn) - 1.0
    square = cx * cx + cy * cy - 4.0
    if square < -nothing:  # the circles overlap
        return
    straight = math.sqrt(max(square, 0.0))
    course = math.atan2(cy, cx) + math.atan2(2.0, straight)
    yield Word(
        first, _OTHER[first], True, (_positive(course, nothing), straight, _positive(course - turn, nothing))
    )


def _three_turns(x: float, y: float, turn: float, nothing: float, first: str) -> Iterator[Word]:
    """LRL: the middle circle touches both others. It lies left of the line between them, since a shortest path never
    has a middle turn of less than half a circle."""
    cx, cy = x - math.sin(turn), y + math.cos(turn) - 1.0
    apart = math.sqrt(cx * cx + cy * cy)
    if not nothing < apart <= 4.0:
        return
    along, opening = math.atan2(cy, cx), math.acos(apart / 4.0)
    first_turn = _positive(along + opening + 0.5 * math.pi, nothing)
    last_turn = _positive(turn - along + opening + 0.5 * math.pi, nothing)
    yield Word(first, first, False, (first_turn, math.pi + 2.0 * opening, last_turn))


def _positive(angle_rad: float, nothing: float) -> float:
    """The angle in [0, 2 pi); an angle that differs from 2 pi by rounding only is 0."""
    angle_rad %= _WHOLE_TURN
    return 0.0 if min(angle_rad, _WHOLE_TURN - angle_rad) < nothing else angle_rad


def _pieces(
    word: Word, start: Point, start_rad: float, end: Point, end_rad: float, radius_m: float
) -> list[Piece]:
    """The pieces of a word on the map. Both ends start at the given positions; rounding collects in the middle."""
    first_rad, middle, last_rad = word.amounts
    opening = _turn(start, start_rad, word.first, first_rad, radius_m)
    closing = _turn(end, end_rad, word.last, -last_rad, radius_m)
    closing = Arc(closing.centre, radius_m, closing.start_rad + closing.sweep_rad, -closing.sweep_rad)
    here = beside(opening.centre, opening.start_rad + opening.sweep_rad, radius_m)
    if word.is_straight:
        there = beside(closing.centre, closing.start_rad, radius_m)
        between: Piece = Straight(here if first_rad else start, there if last_rad else end)
    else:
        here_rad = start_rad + _SIDE[word.first] * first_rad
        between = _turn(here, here_rad, _OTHER[word.first], middle, radius_m)
    return [piece for piece in (opening, between, closing) if piece.length_m >= NOTHING_M]


def _turn(point: Point, course_rad: float, side: str, angle_rad: float, radius_m: float) -> Arc:
    """An arc to one side, starting at a point."""
    left = _SIDE[side]
    centre = beside(point, course_rad, 0.0, left * radius_m)
    return Arc(centre, radius_m, course_rad - 0.5 * math.pi * left, left * angle_rad)
