"""Read the user's height and density maps: grey PNG files, and OpenEXR files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..faults import ConfigError
from ..images import read_values
from ..regular_files import read_regular

_MOST_BYTES = 2 << 30  # more than an EXR of so many pixels has


def read_grey(path: Path, where: str) -> np.ndarray:
    """Values [row from the top, column] of an image: 0 to 1 for a PNG file, unchanged for the first channel of an EXR.

    ConfigError, naming `where` and the file, if it cannot be read, is not grey or has values that are not finite.
    """
    try:
        is_empty = not read_regular(Path(path), _MOST_BYTES)
    except OSError as error:
        raise ConfigError(f"{where} = {path}; expected a readable file ({error.strerror})") from error
    if is_empty:
        raise ConfigError(f"{where} = {path}; expected an image, and the file is empty")
    try:
        values = read_values(Path(path))
    except ValueError as error:
        raise ConfigError(f"{where} = {path}; expected a grey PNG or an EXR file ({error})") from error
    if min(values.shape) < 2:
        raise ConfigError(
            f"{where} = {path}, {values.shape[1]} x {values.shape[0]} pixels; expected 2 x 2 or more"
        )
    if not np.isfinite(values).all():
        raise ConfigError(f"{where} = {path}; expected finite values in all pixels")
    return values


def sample(values: np.ndarray, size_m: float, x_m, y_m) -> np.ndarray:
    """Values interpolated bilinearly: corner pixels lie on the corners of the place, with the top row in the north."""
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
