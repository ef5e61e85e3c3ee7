"""Temperatures of surfaces by the weather."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import veldt._core as _core
from .home import home
from .runs import json_of


class HeatOfDay:
    """The temperatures of all materials over a day that repeats itself, by their heat balances. A material's
    temperatures are computed at its first use (about a tenth of a second), and cached.

    >>> HeatOfDay("winter").temperature_k("soil", solar_h=3)
    """

    def __init__(self, season: str = "winter", weather: dict[str, Any] | None = None) -> None:
        """`weather`: keys of a config's section `weather` that override the season's. ConfigError if invalid."""
        self._day = _core.Day(season, json_of({"weather": weather or {}}, "weather"), home())

    @property
    def materials(self) -> list[str]:
        """Names of the materials that have a heat balance, in order."""
        return self._day.materials

    def air_k(self, solar_h: ArrayLike) -> NDArray[np.float64]:
        """Air temperature [K] at local solar times [h], any finite numbers."""
        return self._day.air_k(solar_h)

    def temperature_k(
        self,
        material: str,
        solar_h: ArrayLike,
        *,
        sky_view: ArrayLike = 1,
        sunlit: ArrayLike = 1,
        moisture: ArrayLike | None = None,
        normal: ArrayLike = (0, 0, 1),
    ) -> NDArray[np.float64]:
        """Temperature [K] of surfaces of one material; all arguments but `material` broadcast as in NumPy.

        solar_h: local solar time [h]. sky_view: visible share of the sky, 0 to 1. sunlit: share of the day's direct
        sunlight, 0 to 1. moisture: 0 dry to 1 saturated; None: that of open ground after the last rain. normal: (…, 3)
        unit vectors east, north, up. Values outside are clamped. Interpolated in tables: off by up to a fifth of a
        kelvin. ConfigError for an unknown material, numbers that are not finite, and shapes that do not broadcast.
        """
        given = {
            "solar_h": solar_h,
            "sky_view": sky_view,
            "sunlit": sunlit,
            "moisture": self._day.open_moisture if moisture is None else moisture,
            "normal": normal,
        }
        numbers = {name: _core.finite_numbers(value, name) for name, value in given.items()}
        normals = numbers.pop("normal")
        shapes = [*(value.shape for value in numbers.values()), normals.shape[:-1]]
        if normals.shape[-1:] != (3,) or not _broadcast(shapes):
            raise _core.ConfigError(
                f"shapes {', '.join(map(str, [*shapes[:-1], normals.shape]))}; expected some that broadcast, and "
                "(…, 3) of normal"
            )
        hours, *places = np.broadcast_arrays(*numbers.values(), normals[..., 0])
        result = np.empty(hours.shape)
        all_normals = np.broadcast_to(normals, (*hours.shape, 3))
        for hour in np.unique(hours):
            now = hours == hour
            of_hour = [place[now] for place in places[:3]]
            result[now] = self._day.temperatures_k(material, float(hour), *of_hour, all_normals[now])
        return result


def _broadcast(shapes: list[tuple[int, ...]]) -> bool:
    try:
        np.broadcast_shapes(*shapes)
    except ValueError:
        return False
    return True
