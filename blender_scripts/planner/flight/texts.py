"""Read untrusted text files and the numbers in them."""

from __future__ import annotations

import json
import stat
from pathlib import Path

from ..faults import ConfigError

_MOST_BYTES = 256 << 20  # of a file; a day's log at 50 Hz
_MOST_SHOWN = 40  # characters of a value in a message


def read_text(file: str, where: str) -> str:
    """A file's text in UTF-8, without its byte order mark.

    ConfigError, naming `where`, if it cannot be read, is not a regular file, or has more than 256 MiB.
    """
    try:
        status = Path(file).stat()
        if not stat.S_ISREG(status.st_mode):
            raise ConfigError(f"{where} = {file}; expected a regular file")
        if status.st_size > _MOST_BYTES:
            raise ConfigError(
                f"{where} = {file}, {status.st_size} bytes; expected at most {_MOST_BYTES} bytes (256 MiB)"
            )
        return Path(file).read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise ConfigError(f"{where} = {file}; expected a readable file ({error.strerror})") from error
    except ValueError as error:  # also raised for invalid paths
        raise ConfigError(f"{where} = {file}; expected a text file in UTF-8 ({error})") from error


def shown(value) -> str:
    """A value of a JSON file as written there, truncated if it is long."""
    try:
        text = json.dumps(value)
    except RecursionError:  # nested as deeply as json.loads can still read
        return "[[[…"
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}…"


def is_number(value) -> bool:
    """Whether a value of a JSON file is a number; Python's bool, a subclass of int, is not."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def checked_number(value, where: str, what: str, low: float, high: float, unit: str) -> float:
    """A value of a JSON file if it is a number from low to high; else ConfigError, naming `where`."""
    if not is_number(value) or not low <= value <= high:
        of_unit = f" {unit}" if is_number(value) else ""
        raise ConfigError(f"{where} = {shown(value)}{of_unit}; expected {what}, {low:g} to {high:g} {unit}")
    return float(value)
