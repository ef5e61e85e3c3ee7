"""Geographic positions in metres on a tangent plane of the Earth."""

from __future__ import annotations

import math

import numpy as np

MOST_AWAY_M = 20_000.0  # largest distance of a flight from the origin; farther away, curvature matters

# The ellipsoid: NIMA TR8350.2, "Department of Defense World Geodetic System 1984", third edition (2000), table 3.1.
SEMI_MAJOR_M = 6_378_137.0
FLATTENING = 1.0 / 298.257223563
_ECCENTRICITY_2 = FLATTENING * (2.0 - FLATTENING)


def radii_m(latitude_deg: float) -> tuple[float, float]:
    """Radii of curvature of the ellipsoid: in the meridian, and in the prime vertical (TR8350.2, section 3.2)."""
    sine = math.sin(math.radians(latitude_deg))
    squeezed = 1.0 - _ECCENTRICITY_2 * sine * sine
    across_m = SEMI_MAJOR_M / math.sqrt(squeezed)
    return across_m * (1.0 - _ECCENTRICITY_2) / squeezed, across_m


def east_north_m(latitude_deg, longitude_deg, origin_deg: tuple[float, float]) -> np.ndarray:
    """East and north (..., 2) of latitudes and longitudes (...) from an origin, also across the meridian of 180 deg.

    Differences of angles times the radii of curvature at the origin. At a distance d, the error against the tangent
    plane of the ellipsoid at the origin is up to (0.58 tan |latitude| + 0.005) d^2 / 6370 km: 0.14 m at 2 km and 20 deg
    of latitude, 4 m at 5 km and 60 deg. The origin must not be a pole.
    """
    along_m, across_m = radii_m(origin_deg[0])
    north_deg = np.asarray(latitude_deg, float) - origin_deg[0]
    east_deg = np.asarray(longitude_deg, float) - origin_deg[1]
    east_deg = east_deg - 360.0 * np.round(east_deg / 360.0)
    parallel_m = across_m * math.cos(math.radians(origin_deg[0]))
    return np.stack([parallel_m * np.radians(east_deg), along_m * np.radians(north_deg)], axis=-1)
