"""Gait: strides for speeds, and feet that stand still on the ground until they step."""

from dataclasses import replace

import numpy as np
import pytest

from creatures import PONY, Hills, apart, circle
from planner.anatomy.bodies import body_of
from planner.anatomy.gait import footing, smooth, stride_m

BODY = body_of(PONY, "mare")
STRIDE_M = stride_m(1.1, BODY.leg_m)
HILLS = Hills(0.4, wave_m=20)


def _feet(walked_m, pace=1.0):
    """Feet of all legs on a path with a radius of about three body lengths over hills."""
    pace = np.broadcast_to(pace, walked_m.shape)
    return apart(footing(BODY.legs, BODY.stance, STRIDE_M, 1.0, circle(6.0), HILLS, walked_m, pace))


def test_a_stride_is_as_long_as_alexander_measured():
    # Human walkers of 0.9 m legs take 1.4 to 1.6 m at 1.4 m/s; 2.3 x 0.9 x 0.222^0.3 = 1.32.
    assert stride_m(1.4, 0.9) == pytest.approx(1.32, abs=0.01)
    # An elephant of 1.9 m legs at 1.2 m/s: 2.3 x 1.9 x 0.0773^0.3 = 2.03.
    assert stride_m(1.2, 1.9) == pytest.approx(2.03, abs=0.01)


def test_strides_lengthen_with_speed_within_the_range_of_a_walk():
    speeds = [0.0, 0.3, 1.0, 2.0, 9.0]
    strides = [stride_m(speed, 0.9) for speed in speeds]
    assert strides == sorted(strides) and strides[0] > 0.5
    assert strides[-1] < 2 * 0.9 * 0.85  # half of it is at most what two legs can spread to


def test_a_foot_stands_still_while_it_bears_the_body():
    walked_m = np.linspace(0, 5 * STRIDE_M, 2001)
    for foot in _feet(walked_m):
        both = foot.bearing[1:] & foot.bearing[:-1]
        slide = np.linalg.norm(np.diff(foot.toe_m[:, :2], axis=0), axis=1) / np.diff(walked_m)
        assert slide[both].max() < 1e-9
        assert foot.bearing.mean() == pytest.approx(BODY.stance, abs=0.01)


def test_feet_are_on_the_ground_and_never_in_it():
    walked_m = np.linspace(0, 5 * STRIDE_M, 2001)
    for foot in _feet(walked_m):
        above = foot.toe_m[:, 2] - HILLS.height_m(*foot.toe_m[:, :2].T)
        assert np.abs(above[foot.bearing]).max() < 1e-9
        assert above.min() > -1e-9
        assert above.max() == pytest.approx(0.12, abs=1e-3)


def test_a_footprint_is_below_the_hip_in_the_middle_of_its_stance():
    for k, leg in enumerate(BODY.legs):
        walked_m = (np.arange(1, 6) + leg.phase + 0.5 * BODY.stance) * STRIDE_M
        foot = _feet(walked_m)[k]
        point, heading = circle(6.0)(walked_m)
        left = np.stack([-heading[:, 1], heading[:, 0]], axis=1)
        assert foot.toe_m[:, :2] == pytest.approx(point + leg.toe_m[0] * heading + leg.toe_m[1] * left)


def test_legs_together_have_the_feet_of_each_alone():
    walked_m = np.linspace(0, 3 * STRIDE_M, 100)
    legs = [replace(leg, lift_m=0.1 + 0.02 * k) for k, leg in enumerate(BODY.legs)]
    given = BODY.stance, STRIDE_M, 1.0, circle(6.0), HILLS, walked_m, np.linspace(0.2, 1.0, 100)
    for leg, among in zip(legs, apart(footing(legs, *given))):
        (alone,) = apart(footing([leg], *given))
        assert np.array_equal(among.toe_m, alone.toe_m)
        assert np.array_equal(among.rotation, alone.rotation)
        assert np.array_equal(among.bearing, alone.bearing)


def test_feet_move_without_a_jump():
    walked_m = np.linspace(0, 3 * STRIDE_M, 20001)
    for foot in _feet(walked_m):
        step = np.linalg.norm(np.diff(foot.toe_m, axis=0), axis=1) / np.diff(walked_m)
        # In the air a foot makes a stride in 0.38 of one, at most 1.5 times as fast as in the mean, and goes up hills.
        assert step.max() < 1.5 / 0.38 * 1.5
        turn = np.abs(np.diff(foot.rotation, axis=0)).max() / (walked_m[1] / STRIDE_M)
        assert turn < 30  # radians a stride: what a heel does in a swing, and no jump


def test_an_animal_that_stops_in_mid_stride_puts_its_feet_down():
    walked_m = np.linspace(0, STRIDE_M, 101)
    for foot in _feet(walked_m, pace=0.0):
        assert np.abs(foot.toe_m[:, 2] - HILLS.height_m(*foot.toe_m[:, :2].T)).max() < 1e-9


def test_feet_depend_on_distance_and_not_on_time():
    there, again = _feet(np.array([3.3, 3.3]))[0].toe_m
    assert np.array_equal(there, again)


def test_smooth_runs_from_0_to_1():
    assert smooth(np.array([-1, 0, 0.5, 1, 2])) == pytest.approx([0, 0, 0.5, 1, 1])


def test_a_foot_that_strikes_rolls_over_its_heel():
    """Its toe is up by 20 degrees at touch-down, its heel on the ground until it is flat; then it is as others."""
    foot_m, strike_rad = 0.2, np.radians(20.0)
    leg = replace(BODY.legs[0], strike_rad=strike_rad, foot_m=foot_m)
    walked_m = (np.linspace(0.0, BODY.stance, 101) + leg.phase + 2.0) * STRIDE_M
    given = BODY.stance, STRIDE_M, 1.0, circle(1e9), Hills(0.0), walked_m, np.ones(101)
    (strikes,), (flat,) = (apart(footing([each], *given)) for each in (leg, BODY.legs[0]))
    heel_m = strikes.toe_m - foot_m * strikes.rotation[:, :, 0]
    up = strikes.strike_rad > 0
    assert (
        strikes.strike_rad[0] == pytest.approx(strike_rad) and 8 < up.sum() < 16
    )  # until 12 % of the stance
    assert strikes.toe_m[0, 2] == pytest.approx(foot_m * np.sin(strike_rad))
    assert heel_m[up] == pytest.approx(np.tile(heel_m[0], (up.sum(), 1)), abs=1e-6)
    assert heel_m[up, 2] == pytest.approx(np.zeros(up.sum()), abs=1e-9)
    assert np.array_equal(strikes.toe_m[~up], flat.toe_m[~up])
