"""Metres from an origin agree with an independent computation in Earth-centred coordinates."""

import math

import numpy as np
import pytest

from planner.flight.geodesy import FLATTENING, SEMI_MAJOR_M, east_north_m


def _ecef_m(latitude_deg, longitude_deg):
    """Earth-centred coordinates (..., 3) of places on the ellipsoid, by its parametric latitude."""
    parametric = np.arctan((1 - FLATTENING) * np.tan(np.radians(latitude_deg)))
    longitude = np.radians(longitude_deg)
    axis_m = SEMI_MAJOR_M * np.cos(parametric)
    polar_m = SEMI_MAJOR_M * (1 - FLATTENING) * np.sin(parametric)
    return np.stack([axis_m * np.cos(longitude), axis_m * np.sin(longitude), polar_m], axis=-1)


@pytest.mark.parametrize("latitude_deg", [-60.0, -20.0, 0.0, 2.3, 45.0, 60.0])
@pytest.mark.parametrize("distance_m", [300.0, 2000.0, 5000.0])
def test_metres_are_those_of_the_plane_that_touches_the_earth(latitude_deg, distance_m):
    """To the second order, the plane is off by (e^2 tan / 2 + 0.005 n^2, e n tan) / R; the third is added."""
    turn = np.linspace(0, 2 * np.pi, 73)
    north_deg = np.degrees(distance_m * np.cos(turn) / SEMI_MAJOR_M)
    east_deg = np.degrees(distance_m * np.sin(turn) / SEMI_MAJOR_M / np.cos(np.radians(latitude_deg)))
    longitude_deg = 179.99
    beyond_deg = (longitude_deg + east_deg + 180) % 360 - 180  # over the date line
    got_m = east_north_m(latitude_deg + north_deg, beyond_deg, (latitude_deg, longitude_deg))
    phi, lam = np.radians([latitude_deg, longitude_deg])
    axes = np.array(
        [
            [-np.sin(lam), np.cos(lam), 0.0],
            [-np.sin(phi) * np.cos(lam), -np.sin(phi) * np.sin(lam), np.cos(phi)],
        ]
    )
    here_m = _ecef_m(latitude_deg, longitude_deg)
    true_m = (_ecef_m(latitude_deg + north_deg, beyond_deg) - here_m) @ axes.T
    off_m = np.hypot(*(got_m - true_m).T).max()
    tangent = abs(math.tan(phi))
    second_m = (0.58 * tangent + 0.005) * distance_m**2 / 6.37e6
    third_m = (1 + tangent**2) * distance_m**3 / 6.37e6**2
    assert off_m < 1.01 * second_m + third_m
    if tangent > 0.3:
        assert off_m > 0.95 * second_m - third_m
