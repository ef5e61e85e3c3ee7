"""Logs of real flights: position and attitude of a camera over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..faults import ConfigError
from .geodesy import MOST_AWAY_M, east_north_m
from .log_tables import EARTH, HEIGHTS, PLANE, read_table
from .places import SurfaceAt
from .texts import read_text


@dataclass(frozen=True)
class Log:
    """A camera at n moments, n >= 2, the first at time 0.

    time_s (n,), increasing; point_m (n, 2); height_m (n,) in the given reference: z_m, agl_m or altitude_m; bearing_rad
    (n,) counter-clockwise from +x, unwrapped, depression_rad (n,), roll_rad (n,); home_m [x, y].
    """

    time_s: np.ndarray
    point_m: np.ndarray
    height_m: np.ndarray
    reference: str
    bearing_rad: np.ndarray
    depression_rad: np.ndarray
    roll_rad: np.ndarray
    home_m: tuple[float, float]

    @property
    def duration_s(self) -> float:
        """From the first moment to the last."""
        return float(self.time_s[-1])

    def at(
        self, time_s: np.ndarray, ground_m: SurfaceAt
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """position_m (n, 3), bearing_rad, depression_rad and roll_rad (n,) at times (n,), linear between moments.

        Looking straight down, the bearing is that of the picture's top. Times are clamped to 0 and duration_s.
        """
        columns = (*self.point_m.T, self.height_m, self.bearing_rad, self.depression_rad, self.roll_rad)
        x_m, y_m, z_m, *angles_rad = (np.interp(time_s, self.time_s, column) for column in columns)
        if self.reference == "agl_m":
            z_m = z_m + ground_m(x_m, y_m)
        elif self.reference == "altitude_m":
            z_m = z_m + ground_m(*np.array(self.home_m)[:, None])
        return np.column_stack([x_m, y_m, z_m]), *angles_rad


def read_log(file: str, home_m, where: str) -> Log:
    """The log in a .csv file (`log_tables`); the latitude and longitude of the first line are mapped to home_m [x, y].

    ConfigError if it cannot be read; `where` is its place in the config.
    """
    name = Path(file).name
    table, numbers = read_table(read_text(file, where), name)
    if not table:
        raise ConfigError(f"{where} = {file}; expected a header and lines of numbers, and the file is empty")
    reference = next(column for column in HEIGHTS if column in table)
    return Log(
        table["time_s"] - table["time_s"][0],
        _points(table, numbers, home_m, name),
        table[reference],
        reference,
        np.unwrap(np.radians(90.0 - table["yaw_deg"])),
        -np.radians(table["pitch_deg"]),
        np.unwrap(np.radians(table["roll_deg"])),
        (float(home_m[0]), float(home_m[1])),
    )


def _points(table: dict[str, np.ndarray], numbers: Sequence[int], home_m, name: str) -> np.ndarray:
    """Positions (n, 2) in the scene."""
    if PLANE[0] in table:
        return np.column_stack([table[column] for column in PLANE])
    latitude_deg, longitude_deg = (table[column] for column in EARTH)
    offset_m = east_north_m(latitude_deg, longitude_deg, (latitude_deg[0], longitude_deg[0]))
    away_m = np.hypot(*offset_m.T)
    if away_m.max() > MOST_AWAY_M:
        k = int(np.argmax(away_m > MOST_AWAY_M))
        raise ConfigError(
            f"{name}: line {numbers[k]} = {away_m[k] / 1000:.1f} km from the first position;"
            f" expected at most {MOST_AWAY_M / 1000:g} km"
        )
    return offset_m + np.array(home_m, float)
