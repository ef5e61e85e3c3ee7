"""Loops pass through their corners, have the right length, and turn smoothly."""

import numpy as np
import pytest

from planner.geometry.splines import Loop

CORNERS = [[30, 0], [5, 28], [-30, 3], [-4, -20]]
UNEVEN = [[30, 0], [29, 7], [5, 28], [-30, 3], [-26, -6], [-4, -20]]


def test_it_passes_through_its_corners():
    points, _ = Loop(CORNERS).at(np.linspace(0, Loop(CORNERS).length_m, 20001))
    gap = np.linalg.norm(points[:, None] - np.array(CORNERS), axis=2).min(axis=0)
    assert gap.max() < 0.5 * Loop(CORNERS).length_m / 20000 + 1e-9  # half a step


def test_distance_along_it_is_distance_walked():
    loop = Loop(CORNERS)
    points, _ = loop.at(np.linspace(0, loop.length_m, 1001))
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    # Within a table step the pace follows the curve's speed, which changes by about its 64th part from step to step.
    assert steps == pytest.approx(loop.length_m / 1000, rel=0.03)
    assert steps.sum() == pytest.approx(loop.length_m, rel=2e-4)


def test_a_round_loop_is_as_long_as_its_circle():
    angle = 2 * np.pi * np.arange(24) / 24
    loop = Loop(100 * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    # Catmull-Rom through points h = 2 pi / 24 apart leaves the circle by about h^4 / 100 of its radius.
    assert loop.length_m == pytest.approx(2 * np.pi * 100, rel=2e-4)


def test_it_goes_round_for_ever_and_backwards():
    loop = Loop(CORNERS)
    ahead, _ = loop.at(12.5 + 3 * loop.length_m)
    behind, _ = loop.at(12.5 - 2 * loop.length_m)
    assert ahead == pytest.approx(loop.at(12.5)[0]) and behind == pytest.approx(loop.at(12.5)[0])


def test_tangents_are_unit_and_continuous():
    loop = Loop(UNEVEN)
    points, tangents = loop.at(np.linspace(0, loop.length_m, 4001))
    assert np.linalg.norm(tangents, axis=1) == pytest.approx(1)
    chords = np.diff(points, axis=0)
    chords /= np.linalg.norm(chords, axis=1, keepdims=True)
    # Curvature stays under 1 / m here: over a 5 cm step the direction turns by less than .05 rad.
    assert (chords * tangents[:-1]).sum(axis=1).min() > np.cos(0.05)
    assert (tangents[1:] * tangents[:-1]).sum(axis=1).min() > np.cos(0.05)
