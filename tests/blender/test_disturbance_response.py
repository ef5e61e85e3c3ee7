"""Offsets in gusts, tilt and lags: they satisfy their differential equations."""

import numpy as np
import pytest

from planner.flight.aircraft import FIXED_WING, MULTIROTOR
from planner.flight.filters import lag_error, states
from planner.flight.gusts import WIND_M_S, gusts_m_s, intensities_m_s, scales_m
from planner.flight.disturbance_response import (
    _HOLDS,
    lagged_angles,
    disturbance_response,
    tilt_rad,
    unsteadiness_rad,
)
from planner.geometry.rotations import by_vector

STEP_S = 0.02
SPEED_M_S = {MULTIROTOR: 8.0, FIXED_WING: 16.0}
# Standard deviations of offsets in m, as the docstring of `disturbance_response` gives them: along the nose, left, up.
OFFSETS_M = {
    (MULTIROTOR, "light"): (0.23, 0.23, 0.11),
    (MULTIROTOR, "moderate"): (0.45, 0.44, 0.21),
    (MULTIROTOR, "severe"): (0.67, 0.65, 0.30),
    (FIXED_WING, "light"): (1.71, 1.29, 1.22),
    (FIXED_WING, "moderate"): (3.30, 2.50, 2.24),
    (FIXED_WING, "severe"): (4.73, 3.60, 3.04),
}


def _response(hold, omega):
    """Offset in m for each m/s of a gust of this frequency."""
    braked = 1.0 / hold.drag_s + hold.damping_per_s
    return 1.0 / hold.drag_s / (hold.stiffness_per_s2 - omega**2 + 1j * omega * braked)


def _offset_m(hold, axis: int, severity: str, airspeed_m_s: float) -> float:
    """Standard deviation in Dryden's spectrum, 60 m up."""
    omega = np.geomspace(1e-5, 1e3, 20_001)
    scale_s = scales_m(60.0)[axis == 2] / airspeed_m_s
    at = (omega * scale_s) ** 2
    shape = 2.0 / (1.0 + at) if axis == 0 else (1.0 + 3.0 * at) / (1.0 + at) ** 2
    density = intensities_m_s(severity, 60.0)[axis == 2] ** 2 * scale_s / np.pi * shape
    density *= np.abs(_response(hold, omega)) ** 2
    return float(np.sqrt((0.5 * (density[1:] + density[:-1]) * np.diff(omega)).sum()))


def test_states_are_those_of_the_recursion():
    rng = np.random.default_rng(1)
    kept, added = np.array([[0.95, 0.1], [-0.2, 0.9]]), rng.normal(size=(2, 1_000))
    whole, state = states(kept, added), np.zeros(2)
    for k in range(1_000):
        state = kept @ state + added[:, k]
        assert whole[:, k] == pytest.approx(state, rel=1e-12, abs=1e-12)
    for moments in (1, 100, 256, 257, 999):
        assert np.array_equal(states(kept, added[:, :moments]), whole[:, :moments])


@pytest.mark.parametrize("kind", [MULTIROTOR, FIXED_WING])
@pytest.mark.parametrize("hz", [0.02, 0.1, 0.5])
def test_a_sine_gust_moves_it_as_the_equation_says(kind: str, hz: float):
    time_s, omega = STEP_S * np.arange(10_000), 2.0 * np.pi * hz
    swayed = disturbance_response(np.tile(np.sin(omega * time_s)[:, None], 3), STEP_S, kind)
    turning = np.exp(1j * omega * time_s)
    for axis, hold in enumerate(_HOLDS[kind]):
        offset = _response(hold, omega) * turning
        control = -(hold.stiffness_per_s2 + 1j * omega * hold.damping_per_s) * offset
        settled = slice(5_000, None)
        # A sine that is linear between moments is (omega step)^2 / 12 too small.
        tolerance = (omega * STEP_S) ** 2 / 10.0 + 1e-9
        assert np.abs(swayed.offset_m[:, axis] - offset.imag)[settled].max() < tolerance * np.abs(offset[0])
        assert np.abs(swayed.control_m_s2[:, axis] - control.imag)[settled].max() < tolerance * np.abs(
            control[0]
        )


def test_it_is_exact_between_moments_for_gusts_that_are_linear_there():
    coarse = gusts_m_s(1, "a", "severe", 60.0, 20.0, 500, 0.1)
    fine = np.stack([np.interp(np.arange(4_991) / 10.0, np.arange(500), axis) for axis in coarse.T], axis=-1)
    for kind in (MULTIROTOR, FIXED_WING):
        expected, seen = disturbance_response(coarse, 0.1, kind), disturbance_response(fine, 0.01, kind)
        assert seen.offset_m[::10] == pytest.approx(expected.offset_m, abs=1e-10)
        assert seen.control_m_s2[::10] == pytest.approx(expected.control_m_s2, abs=1e-9)


@pytest.mark.parametrize("kind, severity", OFFSETS_M)
def test_offsets_are_as_large_as_documented(kind: str, severity: str):
    airspeed_m_s = float(np.hypot(SPEED_M_S[kind], WIND_M_S[severity]))
    expected = [_offset_m(hold, axis, severity, airspeed_m_s) for axis, hold in enumerate(_HOLDS[kind])]
    assert OFFSETS_M[kind, severity] == pytest.approx(expected, abs=0.006)
    for offset in OFFSETS_M[kind, severity]:
        assert f"{offset:.2f}" in disturbance_response.__doc__


def test_offsets_in_flown_turbulence_are_as_large():
    """Five standard deviations of a mean square over an hour of a process that forgets within 15 s, 240 times."""
    airspeed_m_s = float(np.hypot(8.0, WIND_M_S["light"]))
    gusts = gusts_m_s(3, "hour", "light", 60.0, airspeed_m_s, 180_000, STEP_S)
    mean_square = (disturbance_response(gusts, STEP_S, MULTIROTOR).offset_m ** 2).mean(axis=0)
    share = mean_square / np.square(OFFSETS_M[MULTIROTOR, "light"])
    assert np.all(np.abs(share - 1.0) < 5.0 * np.sqrt(2.0 / 240.0))


def test_it_starts_at_rest_and_stays_there_in_still_air():
    swayed = disturbance_response(np.zeros((100, 3)), STEP_S, FIXED_WING)
    assert not swayed.offset_m.any() and not swayed.control_m_s2.any()
    assert not disturbance_response(np.ones((2, 3)), STEP_S, MULTIROTOR).offset_m[0].any()


def test_later_gusts_change_no_bit():
    gusts = gusts_m_s(1, "a", "severe", 60.0, 20.0, 3_000, STEP_S)
    whole = disturbance_response(gusts, STEP_S, MULTIROTOR)
    lean = tilt_rad(whole.control_m_s2[:, :2])
    for moments in (2, 256, 1_111):
        part = disturbance_response(gusts[:moments], STEP_S, MULTIROTOR)
        assert np.array_equal(part.offset_m, whole.offset_m[:moments])
        assert np.array_equal(part.control_m_s2, whole.control_m_s2[:moments])
        part_rad = unsteadiness_rad(lean[:moments], 0.1, STEP_S)
        assert np.array_equal(part_rad, unsteadiness_rad(lean, 0.1, STEP_S)[:moments])


def test_thrust_leans_towards_the_acceleration():
    acceleration = np.array([[1.0, 0.0], [0.0, 0.5], [-0.4, 0.3], [0.0, 0.0]])
    lean = by_vector(tilt_rad(acceleration)) @ [0.0, 0.0, 1.0]
    assert lean[:, :2] == pytest.approx(acceleration / 9.80665, rel=3e-3)
    assert not tilt_rad(acceleration)[:, 2].any()


def test_a_lag_approaches_a_new_value_as_exp_says():
    time_s, lag_s = STEP_S * np.arange(200), 0.3
    commanded = np.where(time_s > 0.5 * STEP_S, 2.0, 1.0)  # linear from 1 to 2 in the first step
    since_s = time_s[1:] - STEP_S
    left = lag_s / STEP_S * (1.0 - np.exp(-STEP_S / lag_s)) * np.exp(-since_s / lag_s)
    assert lagged_angles(commanded, lag_s, STEP_S)[1:] == pytest.approx(2.0 - left, abs=1e-12)


def test_a_lag_follows_a_turn_its_lag_behind():
    time_s = STEP_S * np.arange(1_000)
    behind = 0.7 * time_s - lagged_angles(0.7 * time_s, 0.3, STEP_S)
    assert behind == pytest.approx(0.7 * 0.3 * (1.0 - np.exp(-time_s / 0.3)), abs=1e-12)


def test_a_gimbal_without_lag_follows_commands_exactly():
    commanded = np.random.default_rng(1).normal(size=300)
    assert np.array_equal(lagged_angles(commanded, 0.0, STEP_S), commanded)
    assert not unsteadiness_rad(np.tile(commanded[:, None], 3), 0.0, STEP_S).any()


def test_what_does_not_turn_is_held_to_the_bit():
    assert set(lagged_angles(np.full(1_000, 0.1), 0.3, STEP_S)) == {0.1}
    assert not unsteadiness_rad(np.full((1_000, 3), 0.1), 0.3, STEP_S).any()


def test_a_gimbal_lets_through_what_is_faster_than_it():
    time_s, lag_s = STEP_S * np.arange(5_000), 0.1
    for hz in (0.1, 1.0, 3.0):
        omega = 2.0 * np.pi * hz
        leaning = np.tile(np.sin(omega * time_s)[:, None], 3)
        gain = np.abs(unsteadiness_rad(leaning, lag_s, STEP_S)[2_500:]).max()
        assert gain == pytest.approx((omega * lag_s) ** 2 / (1.0 + (omega * lag_s) ** 2), rel=0.02)


def test_a_gimbal_holds_its_direction_on_what_tilts_evenly():
    leaning = 0.4 * STEP_S * np.arange(500)[:, None] * np.ones(3)  # 23 deg/s
    left = unsteadiness_rad(leaning, 0.05, STEP_S)
    assert np.degrees(np.abs(left).max()) == pytest.approx(np.degrees(0.4 * 0.05 / np.e), rel=0.05)
    assert np.abs(left[100:]).max() < 1e-12


def test_lags_treat_each_column_alone():
    values = np.random.default_rng(1).normal(size=(500, 3))
    together = lag_error(values, 0.2, STEP_S)
    for column in range(3):
        assert np.array_equal(together[:, column], lag_error(values[:, column], 0.2, STEP_S))
