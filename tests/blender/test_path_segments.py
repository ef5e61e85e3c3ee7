"""Straights, arcs, turns and laws of motion."""

import numpy as np
import pytest

from planner.flight.speed_profile import Steady, StopToStop
from planner.flight.path_segments import Arc, Straight, turn_rad


@pytest.mark.parametrize("sweep_rad", [1.2, -1.2])
def test_arcs_turn_to_the_side_of_their_sweep(sweep_rad):
    arc = Arc((3.0, 4.0), 10.0, 0.5, sweep_rad)
    points, course_rad = arc.at(np.array([0.0, 6.0, arc.length_m]))
    angle_rad = 0.5 + np.array([0, np.sign(sweep_rad) * 0.6, sweep_rad])
    assert points == pytest.approx(
        np.array([3, 4]) + 10 * np.stack([np.cos(angle_rad), np.sin(angle_rad)], axis=1)
    )
    assert course_rad == pytest.approx(angle_rad + np.sign(sweep_rad) * np.pi / 2)
    assert (course_rad[0], course_rad[-1]) == pytest.approx(arc.courses_rad)


def test_straights_lead_from_start_to_end():
    straight = Straight((1.0, 2.0), (4.0, 6.0))
    points, course_rad = straight.at(np.array([0.0, 2.5, 5.0]))
    assert points == pytest.approx(np.array([[1, 2], [2.5, 4], [4, 6]]))
    assert course_rad == pytest.approx(np.arctan2(4, 3))


@pytest.mark.parametrize(
    "start_deg, end_deg, turn_deg",
    [
        (0, 90, 90),
        (0, 270, -90),
        (170, -170, 20),
        (0, 180, 180),
        (180, 0, 180),
        (0, -180 - 1e-12, 180),
        (720, 10, 10),
    ],
)
def test_turns_are_the_shortest_way_round(start_deg, end_deg, turn_deg):
    assert turn_rad(*np.radians([start_deg, end_deg])) == pytest.approx(np.radians(turn_deg))


@pytest.mark.parametrize("law", [Steady(50.0, 7.0), StopToStop(50.0, 7.0, 2.0), StopToStop(3.0, 7.0, 2.0)])
def test_laws_of_motion_go_all_the_way(law):
    time_s = np.linspace(0, law.duration_s, 1001)
    along_m = law.along_m(time_s)
    assert (along_m[0], along_m[-1]) == pytest.approx((0, law.length_m))
    assert (np.diff(along_m) >= 0).all() and np.diff(along_m).max() <= 7.0 * time_s[1] * (1 + 1e-9)
