"""Logs of real flights: position and attitude of a camera over time.

They are .csv files whose first line names the columns. Columns, in any order: time_s; x_m and y_m in the scene, or
latitude_deg and longitude_deg (WGS 84); z_m above the scene's datum, agl_m above its ground, or altitude_m above its
ground at home; and, for the camera, yaw_deg clockwise from north, pitch_deg above the horizon (-90: straight down) and
roll_deg, positive with the right side down.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..faults import ConfigError, check_known
from ..plausible import ALTITUDE_M, LATITUDE_DEG, LONGITUDE_DEG
from .geodesy import MOST_AWAY_M, east_north_m
from .texts import read_text
from .waypoints import SurfaceAt

_RANGES = {  # by column: minimum, maximum
    "time_s": (-1e11, 1e11),
    "x_m": (-100_000.0, 100_000.0),
    "y_m": (-100_000.0, 100_000.0),
    "latitude_deg": LATITUDE_DEG,
    "longitude_deg": LONGITUDE_DEG,
    "z_m": ALTITUDE_M,
    "agl_m": ALTITUDE_M,
    "altitude_m": ALTITUDE_M,
    "yaw_deg": (-360.0, 360.0),
    "pitch_deg": (-90.0, 90.0),
    "roll_deg": (-180.0, 180.0),
}
_PLANE, _EARTH = ("x_m", "y_m"), ("latitude_deg", "longitude_deg")
_HEIGHTS = ("z_m", "agl_m", "altitude_m")
_ALWAYS = ("time_s", "yaw_deg", "pitch_deg", "roll_deg")


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
    """The log in a .csv file; the latitude and longitude of the first line are mapped to home_m [x, y].

    ConfigError if it cannot be read; `where` is its key in the config.
    """
    name = Path(file).name
    table, numbers = _read_table(read_text(file, where), name)
    if not table:
        raise ConfigError(f"{where} = {file}; expected a header and lines of numbers, and the file is empty")
    reference = next(column for column in _HEIGHTS if column in table)
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
    if _PLANE[0] in table:
        return np.column_stack([table[column] for column in _PLANE])
    latitude_deg, longitude_deg = (table[column] for column in _EARTH)
    offset_m = east_north_m(latitude_deg, longitude_deg, (latitude_deg[0], longitude_deg[0]))
    away_m = np.hypot(*offset_m.T)
    if away_m.max() > MOST_AWAY_M:
        k = int(np.argmax(away_m > MOST_AWAY_M))
        raise ConfigError(
            f"{name}: line {numbers[k]} = {away_m[k] / 1000:.1f} km from the first position;"
            f" expected at most {MOST_AWAY_M / 1000:g} km"
        )
    return offset_m + np.array(home_m, float)


def _read_table(text: str, name: str) -> tuple[dict[str, np.ndarray], list[int]]:
    """Columns (n,) by name, n >= 2, and the line number of each row; both empty for a text without lines.

    Times must increase. ConfigError, beginning with the file's `name`, if the text is not a valid log.
    """
    lines = _lines(text, name)
    if not lines:
        return {}, []
    (_, header), *rows = lines
    columns = _columns(header, name)
    values = np.array([_values(row, columns, f"{name}: line {line}") for line, row in rows])
    if len(values) < 2:
        raise ConfigError(f"{name} = {len(values)} lines of numbers; expected at least 2")
    table, numbers = dict(zip(columns, values.T)), [line for line, _ in rows]
    _check_times(table["time_s"], numbers, name)
    return table, numbers


def _lines(text: str, name: str) -> list[tuple[int, list[str]]]:
    """Non-empty lines with their numbers."""
    reader = csv.reader(io.StringIO(text, newline=""))
    try:
        return [(reader.line_num, [field.strip() for field in row]) for row in reader if row]
    except csv.Error as error:
        raise ConfigError(
            f"{name}: line {reader.line_num}: expected values between commas ({error})"
        ) from error


def _columns(header: Sequence[str], name: str) -> list[str]:
    """The columns named by a header; ConfigError if they are not those of a log."""
    if all(_number(field) is not None for field in header):
        raise ConfigError(f"{name}: line 1 = {_cut(','.join(header))}; expected the names of the columns")
    for k, column in enumerate(header):
        check_known(column, _RANGES, f"{name}: column {k + 1}", "a column")
        if column in header[:k]:
            raise ConfigError(f'{name}: column {k + 1} = "{column}"; expected each column once')
    for column in _ALWAYS:
        if column not in header:
            raise ConfigError(f"{name}: column {column} is missing; expected {', '.join(_ALWAYS)}")
    _check_one_of(header, (_PLANE, _EARTH), name)
    _check_one_of(header, [(height,) for height in _HEIGHTS], name)
    return list(header)


def _check_one_of(header: Sequence[str], groups: Sequence[Sequence[str]], name: str) -> None:
    """Check that a header names all columns of exactly one group."""
    there = [column for group in groups for column in group if column in header]
    if there not in [list(group) for group in groups]:
        found = f"= {', '.join(there)}" if there else "are missing"
        rule = ", or ".join(" and ".join(group) for group in groups)
        raise ConfigError(f"{name}: columns {found}; expected either {rule}")


def _values(row: Sequence[str], columns: Sequence[str], where: str) -> list[float]:
    if len(row) != len(columns):
        raise ConfigError(f"{where} = {len(row)} values; expected {len(columns)}, as many as columns")
    values = [_number(field) for field in row]
    for field, value, column in zip(row, values, columns):
        low, high = _RANGES[column]
        if value is None or not low <= value <= high:
            raise ConfigError(
                f"{where}, {column} = {_cut(field)}; expected a number from {low:g} to {high:g}"
            )
    return values


def _number(field: str) -> float | None:
    """The value of a field; ConfigError if it is not a number."""
    try:
        return None if "_" in field else float(field)  # float() accepts 1_000
    except ValueError:
        return None


def _cut(field: str) -> str:
    return f'"{field}"' if len(field) <= 40 else f'"{field[:40]}…"'


def _check_times(time_s: np.ndarray, numbers: Sequence[int], name: str) -> None:
    late = np.flatnonzero(np.diff(time_s - time_s[0]) <= 0)
    if late.size:
        k = int(late[0]) + 1
        raise ConfigError(
            f"{name}: line {numbers[k]}, time_s = {time_s[k]:.12g} s;"
            f" expected more than {time_s[k - 1]:.12g} s, the time before"
        )
