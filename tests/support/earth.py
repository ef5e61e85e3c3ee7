"""Places on Earth, as tests compute them."""

from __future__ import annotations

import math

import numpy as np


def earth_coordinates_m(latitude_deg: float, longitude_deg: float, height_m: float) -> np.ndarray:
    """Earth-centred coordinates (3,) on the WGS 84 ellipsoid."""
    squared = (2 - 1 / 298.257223563) / 298.257223563
    lat, lon = math.radians(latitude_deg), math.radians(longitude_deg)
    normal_m = 6378137 / math.sqrt(1 - squared * math.sin(lat) ** 2)
    return np.array(
        [
            (normal_m + height_m) * math.cos(lat) * math.cos(lon),
            (normal_m + height_m) * math.cos(lat) * math.sin(lon),
            (normal_m * (1 - squared) + height_m) * math.sin(lat),
        ]
    )


def axes_at(latitude_deg: float, longitude_deg: float) -> np.ndarray:
    """East, north and up of a place, in rows."""
    lat, lon = math.radians(latitude_deg), math.radians(longitude_deg)
    return np.array(
        [
            [-math.sin(lon), math.cos(lon), 0],
            [-math.sin(lat) * math.cos(lon), -math.sin(lat) * math.sin(lon), math.cos(lat)],
            [math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)],
        ]
    )
