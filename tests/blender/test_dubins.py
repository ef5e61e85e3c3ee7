"""Shortest paths with a minimum radius, checked against a search that does not use the formulas."""

from collections import Counter

import numpy as np
import pytest

from planner.flight.dubins import shortest
from planner.flight.path_segments import Arc, Straight

ORIGIN = (0.0, 0.0)
SIDES = [(1, 1), (-1, -1), (1, -1), (-1, 1)]


def _random_pairs(count):
    """Poses from 0 to 10 radii apart: far enough for straights, near enough for three turns."""
    draw = np.random.Generator(np.random.PCG64(7))
    for _ in range(count):
        radius_m = draw.uniform(5, 100)
        start, way = draw.uniform(-500, 500, 2), draw.uniform(0, 10) ** 2 / 10 * radius_m
        towards, start_rad, end_rad = draw.uniform(-np.pi, np.pi, 3)
        end = start + way * np.array([np.cos(towards), np.sin(towards)])
        yield tuple(start), start_rad, tuple(end), end_rad, radius_m


PAIRS = list(_random_pairs(300))


def _length_m(pieces):
    return sum(piece.length_m for piece in pieces)


def _ends(piece):
    points, courses = piece.at(np.array([0.0, piece.length_m]))
    return points, courses


def _spelt(pieces):
    return "".join("S" if isinstance(p, Straight) else "L" if p.sweep_rad > 0 else "R" for p in pieces)


def _off_rad(a, b):
    return np.abs(np.remainder(a - b + np.pi, 2 * np.pi) - np.pi)


def _left(heading):
    return np.stack([-np.sin(heading), np.cos(heading)], axis=-1)


def _ahead(heading):
    return np.stack([np.cos(heading), np.sin(heading)], axis=-1)


def _searched_m(start, start_rad, end, end_rad, radius_m):
    """Least length over first turns that lead to the end by a straight or a turn: roots, bracketed on a fine grid."""
    lengths = []
    for first, last in SIDES:
        end_centre = np.array(end) + last * radius_m * _left(end_rad)

        def after(turn, first=first):
            heading = start_rad + first * turn
            centre = np.array(start) + first * radius_m * _left(start_rad)
            return heading, centre - first * radius_m * _left(heading)

        def straight(turn, last=last, end_centre=end_centre, after=after):
            heading, point = after(turn)
            way = end_centre - last * radius_m * _left(heading) - point
            aside = (way * _left(heading)).sum(axis=-1)
            return aside, (way * _ahead(heading)).sum(axis=-1), np.mod(last * (end_rad - heading), 2 * np.pi)

        for turn in _roots(lambda turn, f=straight: f(turn)[0]):
            _, along, closing = straight(turn)
            lengths += [along + radius_m * (turn + closing)] if along >= 0 else []
        if first == last:

            def middle(turn, first=first, after=after):
                heading, point = after(turn)
                return heading, point - first * radius_m * _left(heading)

            def gap(turn, end_centre=end_centre, middle=middle):
                return np.sqrt(((middle(turn)[1] - end_centre) ** 2).sum(axis=-1)) - 2 * radius_m

            for turn in _roots(gap):
                heading, centre = middle(turn)
                inward = first * (end_centre - centre)  # along the left of the course where the circles touch
                touch = np.arctan2(-inward[0], inward[1])
                turns = turn + np.mod(first * (heading - touch), 2 * np.pi)
                lengths.append(radius_m * (turns + np.mod(first * (end_rad - touch), 2 * np.pi)))
    return min(lengths)


def _roots(function):
    grid = np.linspace(0, 2 * np.pi, 721)
    value = function(grid)
    crossing = np.flatnonzero(value[:-1] * value[1:] <= 0)
    low, high = grid[crossing], grid[crossing + 1]
    below = value[crossing]
    for _ in range(50):
        middle = 0.5 * (low + high)
        is_before = function(middle) * below > 0
        low, high = np.where(is_before, middle, low), np.where(is_before, high, middle)
    return low


def test_ways_lead_from_the_start_to_the_end_without_a_kink():
    for start, start_rad, end, end_rad, radius_m in PAIRS:
        point, course = np.array(start), start_rad
        for piece in shortest(start, start_rad, end, end_rad, radius_m):
            points, courses = _ends(piece)
            assert points[0] == pytest.approx(point, abs=1e-9)
            # A straight's course is that of its ends, rounded to 1e-13 m: 1e-8 even for one of 10 um.
            assert _off_rad(courses[0], course) < 1e-8
            point, course = points[1], courses[1]
        assert point == pytest.approx(end, abs=1e-9)
        assert _off_rad(course, end_rad) < 1e-8


def test_no_way_is_shorter():
    for pair in PAIRS:
        start, _, end, _, _ = pair
        length_m = _length_m(shortest(*pair))
        assert length_m <= _searched_m(*pair) + 1e-6
        assert length_m >= np.hypot(end[0] - start[0], end[1] - start[1]) - 1e-9


def test_turns_are_never_tighter():
    arcs = [p for pair in PAIRS for p in shortest(*pair) if isinstance(p, Arc) and p.radius_m != pair[4]]
    assert not arcs


def test_all_words_are_spoken():
    spoken = Counter(_spelt(shortest(*pair)) for pair in PAIRS)
    assert {"LSL", "RSR", "LSR", "RSL", "LRL", "RLR"} <= set(spoken)


def test_ways_are_as_long_backwards():
    for start, start_rad, end, end_rad, radius_m in PAIRS:
        forth = shortest(start, start_rad, end, end_rad, radius_m)
        back = shortest(end, end_rad + np.pi, start, start_rad + np.pi, radius_m)
        assert _length_m(back) == pytest.approx(_length_m(forth), abs=1e-6)


def test_nothing_leads_from_a_place_to_itself():
    assert not shortest((3.0, 4.0), 1.0, (3.0, 4.0), 1.0, 50.0)
    assert not shortest((3.0, 4.0), 1.0, (3.0, 4.0), 1.0 + 2 * np.pi, 50.0)


@pytest.mark.parametrize("heading", np.linspace(-3, 3, 13))
def test_straight_ahead_is_a_straight(heading):
    end = (700.0 + 300.0 * np.cos(heading), -200.0 + 300.0 * np.sin(heading))
    assert _spelt(shortest((700.0, -200.0), heading, end, heading, 25.0)).strip("LR") == "S"
    assert _length_m(shortest((700.0, -200.0), heading, end, heading, 25.0)) == pytest.approx(300, abs=1e-6)


@pytest.mark.parametrize(
    "end, end_rad, spelt, length",
    [
        ((0, 2), np.pi, "L", np.pi),  # one half circle
        ((0, -2), np.pi, "R", np.pi),
        ((0, 5), np.pi, "LSL", np.pi + 3),
        ((1, 1), np.pi / 2, "L", np.pi / 2),
        ((3, 1), np.pi / 2, "SL", 2 + np.pi / 2),
        ((2, 2), 0, "LR", np.pi),  # two quarters
        ((0, 0), np.pi, "LRL", 7 * np.pi / 3),  # three circles that touch each other
        ((0, 1), np.pi, "RLR", np.pi + 4 * np.arccos(0.75)),  # a bulb: centres 3 apart, two sides of 2
    ],
)
def test_ways_known_in_closed_form(end, end_rad, spelt, length):
    radius_m = 30.0
    pieces = shortest(ORIGIN, 0.0, (radius_m * end[0], radius_m * end[1]), end_rad, radius_m)
    assert _spelt(pieces) == spelt
    assert _length_m(pieces) == pytest.approx(radius_m * length, abs=1e-6)


@pytest.mark.parametrize("shake", [1e-15, 1e-13, 1e-12])
def test_rounding_adds_no_loops(shake):
    draw = np.random.Generator(np.random.PCG64(3))
    for end, end_rad in [((0, 60), np.pi), ((30, 30), np.pi / 2), ((200, 0), 0), ((60, 60), 0), ((0, 0), 0)]:
        length_m = _length_m(shortest(ORIGIN, 0.0, end, end_rad, 30.0))
        for dx, dy, turn in draw.uniform(-shake, shake, (50, 3)):
            shaken = shortest(ORIGIN, 0.0, (end[0] + dx, end[1] + dy), end_rad + turn, 30.0)
            # Two circles that overlap by 1e-12 m are joined by a straight of some sqrt(30 m * 1e-12 m) = 5 um.
            assert _length_m(shaken) == pytest.approx(length_m, abs=1e-4)


def test_rounding_does_not_choose_the_side():
    draw = np.random.Generator(np.random.PCG64(5))
    shakes = draw.uniform(-1e-13, 1e-13, (50, 3))
    assert {_spelt(shortest(ORIGIN, 0.0, (x, y), np.pi + turn, 30.0)) for x, y, turn in shakes} == {"LRL"}
