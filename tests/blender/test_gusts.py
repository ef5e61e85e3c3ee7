"""Dryden turbulence: strengths, scales and spectrum, from the first moment on and for any length."""

import numpy as np
import pytest

from planner.flight.gusts import WIND_M_S, gusts_m_s, intensities_m_s, scales_m

# Values are drawn from fixed seeds, so the tests always see the same ones. For other seeds, and for changes that draw
# other numbers, each bound is one of five standard deviations: broken by chance once in 1.7 million checks.
SIGMAS = 5.0


def _chi_square_bounds(freedom: float) -> tuple[float, float]:
    """Least and largest mean of squares of `freedom` standard normal values (Wilson & Hilferty 1931)."""
    spread = 2.0 / (9.0 * freedom)
    return tuple((1.0 - spread + sign * SIGMAS * np.sqrt(spread)) ** 3 for sign in (-1.0, 1.0))


def _gusts(name: str, moments: int, height_m=30.0, airspeed_m_s=20.0, step_s=0.02, severity="moderate"):
    return gusts_m_s(7, name, severity, height_m, airspeed_m_s, moments, step_s)


def _spectrum(axis: int, hz: np.ndarray) -> np.ndarray:
    """Dryden's one-sided spectrum in (m/s)^2 per Hz of samples 0.02 s apart, including aliases."""
    strength = intensities_m_s("moderate", 30.0)[axis == 2]
    scale_s = scales_m(30.0)[axis == 2] / 20.0
    omega = 2.0 * np.pi * np.abs(hz[:, None] + np.arange(-40, 41) * 50.0) * scale_s
    first = 4.0 * scale_s / (1.0 + omega**2)
    second = 2.0 * scale_s * (1.0 + 3.0 * omega**2) / (1.0 + omega**2) ** 2
    return strength**2 * (first if axis == 0 else second).sum(axis=1)


def test_winds_are_those_of_the_specification():
    knots = {severity: wind / (1852 / 3600) for severity, wind in WIND_M_S.items()}
    assert knots == pytest.approx({"none": 0, "light": 15, "moderate": 30, "severe": 45})


def test_strengths_and_scales_are_those_of_the_specification():
    # 1000 ft up, 0.177 + 0.000823 x 1000 = 1: gusts are alike in all directions.
    assert intensities_m_s("light", 304.8) == pytest.approx((0.77167, 0.77167), rel=1e-4)
    assert scales_m(304.8) == pytest.approx((304.8, 304.8))
    # 100 ft up, by hand: 0.2593^0.4 = 0.5829, and 100 ft / 0.2593^1.2 = 504.9 ft.
    assert intensities_m_s("severe", 30.48) == pytest.approx((2.315 / 0.5829, 2.315), rel=1e-3)
    assert scales_m(30.48) == pytest.approx((504.9 * 0.3048, 30.48), rel=1e-3)


def test_below_ten_feet_and_above_a_thousand_it_is_as_there():
    assert scales_m(0.0) == scales_m(3.048) and scales_m(-5.0) == scales_m(3.048) != scales_m(3.1)
    assert scales_m(900.0) == scales_m(304.8) and intensities_m_s("light", 900.0) == intensities_m_s(
        "light", 304.8
    )
    assert np.isfinite(_gusts("a", 500, height_m=-5.0)).all()


def test_the_air_is_still_without_turbulence():
    assert not _gusts("a", 100, severity="none").any()


def test_strengths_are_right_from_the_first_moment_on():
    """15 checks of as many squares as there are names."""
    names = 400
    values = np.array([_gusts(f"clip_{k}", 501, airspeed_m_s=60.0) for k in range(names)])
    level_m_s, up_m_s = intensities_m_s("moderate", 30.0)
    squares = (values[:, [0, 1, 5, 50, 500]] / [level_m_s, level_m_s, up_m_s]) ** 2
    least, most = _chi_square_bounds(names)
    assert np.all((squares.mean(axis=0) > least) & (squares.mean(axis=0) < most))


def test_axes_are_independent():
    """3 checks: a correlation of n independent pairs has the standard deviation 1 / sqrt(n)."""
    names = 400
    first = np.array([_gusts(f"clip_{k}", 1)[0] for k in range(names)])
    off_diagonal = np.corrcoef(first.T)[np.triu_indices(3, 1)]
    assert np.all(np.abs(off_diagonal) < SIGMAS / np.sqrt(names))


@pytest.fixture(scope="module", name="runs")
def _runs() -> np.ndarray:
    """20 runs of 8192 moments, (20, 8192, 3)."""
    return np.array([_gusts(f"run_{k}", 8192) for k in range(20)])


@pytest.mark.parametrize("axis", [0, 1, 2], ids=["nose", "left", "up"])
def test_the_spectrum_is_drydens(runs: np.ndarray, axis: int):
    """8 octaves from 0.05 Hz to 12.5 Hz, 24 checks in all: once in 70,000 seeds one fails.

    Over its spectrum, each line of a Hann window's power is the mean of two squares; lines three apart are independent.
    """
    moments = runs.shape[1]
    window = np.hanning(moments + 1)[:-1]
    lines = np.fft.rfft(window * runs[:, :, axis])
    power = 2.0 * 0.02 * (np.abs(lines) ** 2).mean(axis=0) / (window**2).sum()
    bin_ = np.arange(8, moments // 4, 3)
    octave = np.log2(bin_ / 8.0).astype(int)
    share = power[bin_] / _spectrum(axis, bin_ / (moments * 0.02))
    for band in range(8):
        least, most = _chi_square_bounds(2 * len(runs) * (octave == band).sum())
        assert least < share[octave == band].mean() < most


@pytest.mark.parametrize("step_s", [0.5, 5.0])
def test_coarse_steps_are_samples_of_the_same_process(step_s: float):
    """Products of neighbours, exp(-d) and exp(-d) (1 - d/2) at d time scales, and squares: 6 checks."""
    names = 2000
    pairs = np.array([_gusts(f"clip_{k}", 2, step_s=step_s) for k in range(names)])
    level_m_s, up_m_s = intensities_m_s("moderate", 30.0)
    pairs /= [level_m_s, level_m_s, up_m_s]
    steps = step_s * 20.0 / np.array(scales_m(30.0))[[0, 0, 1]]
    expected = np.exp(-steps) * [1.0, 1.0 - 0.5 * steps[1], 1.0 - 0.5 * steps[2]]
    # The product of two standard normal values of correlation c has the variance 1 + c^2.
    bound = SIGMAS * np.sqrt((1.0 + expected**2) / names)
    assert np.all(np.abs((pairs[:, 0] * pairs[:, 1]).mean(axis=0) - expected) < bound)
    least, most = _chi_square_bounds(names)
    assert np.all((least < (pairs[:, 1] ** 2).mean(axis=0)) & ((pairs[:, 1] ** 2).mean(axis=0) < most))


def test_more_moments_begin_with_the_same_gusts():
    longer = _gusts("a", 3_000)
    for moments in (1, 2, 255, 256, 257, 1_500):
        assert np.array_equal(_gusts("a", moments), longer[:moments])


def test_other_names_and_seeds_have_other_gusts():
    assert not np.array_equal(_gusts("a", 10), _gusts("b", 10))
    assert not np.array_equal(_gusts("a", 10), gusts_m_s(8, "a", "moderate", 30.0, 20.0, 10, 0.02))
