"""Read the user's height and density maps: grey PNG files, and OpenEXR files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..faults import ConfigError
from ..images import read_values
from ..plausible import LAND_M
from ..regular_files import read_regular

_MOST_BYTES = 2 << 30  # more than the largest accepted EXR
_MISSING = np.array(
    [-9999.0, -32767.0, -32768.0, -99999.0]
)  # values that mark cells without a height in elevation models
_ROUNDING = 1e-3  # of shares that were 0 to 1 before a filter


def read_height_shares(given: dict, where: str) -> np.ndarray:
    """Shares of height_m [row from the top, column] of `scene.terrain.heightmap`, whose key in the config is `where`.

    Uses file, height_m and channel. Shares in an EXR may be below 0 or above 1: the land is from -500 to 9000 m high,
    or within height_m. ConfigError for other heights, for marks of missing data (-9999, -32767, -32768, -99999) and as
    read_grey().
    """
    shares = read_grey(given["file"], f"{where}.file", given.get("channel"))
    low_m, high_m = given["height_m"]
    with np.errstate(over="ignore", invalid="ignore"):
        heights_m = low_m + (high_m - low_m) * shares
    least_m, most_m = min(low_m, high_m, LAND_M[0]), max(low_m, high_m, LAND_M[1])
    is_height = (heights_m >= least_m) & (heights_m <= most_m) & ~np.isin(shares, _MISSING)
    _check_all(
        is_height, shares, f"{where}.file = {given['file']}", f"heights of {least_m:g} to {most_m:g} m"
    )
    return shares


def read_density(given: dict, where: str) -> np.ndarray:
    """Values 0 to 1 [row from the top, column] of `scene.terrain.density_map`; ConfigError for others."""
    values = read_grey(given["file"], f"{where}.file", given.get("channel"))
    is_share = (values >= -_ROUNDING) & (values <= 1.0 + _ROUNDING)
    _check_all(is_share, values, f"{where}.file = {given['file']}", "0 to 1")
    return values


def read_grey(path: Path, where: str, channel: str | None = None) -> np.ndarray:
    """Values [row from the top, column] of an image: 0 to 1 for a PNG file, unchanged for the channel of an EXR.

    ConfigError, naming `where` and the file, if it cannot be read, is not grey, or has several channels without
    `channel` naming one. Values are not checked.
    """
    try:
        is_empty = not read_regular(Path(path), _MOST_BYTES)
    except OSError as error:
        raise ConfigError(f"{where} = {path}; expected a readable file ({error.strerror})") from error
    if is_empty:
        raise ConfigError(f"{where} = {path}; expected an image, and the file is empty")
    try:
        values = read_values(Path(path), channel)
    except ValueError as error:
        raise ConfigError(f"{where} = {path}; expected a grey PNG or an EXR file ({error})") from error
    if min(values.shape) < 2:
        raise ConfigError(
            f"{where} = {path}, {values.shape[1]} x {values.shape[0]} pixels; expected 2 x 2 or more"
        )
    return values


def _check_all(is_fine: np.ndarray, values: np.ndarray, where: str, expected: str) -> None:
    if is_fine.all():
        return
    odd = values[~is_fine]
    raise ConfigError(
        f"{where}, {odd.size} of {values.size} pixels with values such as {odd[0]:g};"
        f" expected {expected} in every pixel, none without data"
    )


def sample(values: np.ndarray, size_m: float, x_m, y_m) -> np.ndarray:
    """Values interpolated bilinearly: corner pixels lie on the corners of the scene, with the top row in the north."""
    rows, columns = values.shape
    u, column = _split((np.asarray(x_m, float) / size_m + 0.5) * (columns - 1), columns)
    v, row = _split((0.5 - np.asarray(y_m, float) / size_m) * (rows - 1), rows)
    top = values[row, column] * (1 - u) + values[row, column + 1] * u
    bottom = values[row + 1, column] * (1 - u) + values[row + 1, column + 1] * u
    return top * (1 - v) + bottom * v


def _split(place: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Fraction beyond the pixel before a position, and the index of that pixel, clamped to the image."""
    place = np.clip(place, 0.0, count - 1.0)
    number = np.minimum(place.astype(np.int64), count - 2)
    return place - number, number
