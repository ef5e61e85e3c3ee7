"""Reads text files, and numbers in them, that others wrote."""

from __future__ import annotations

import json
from pathlib import Path

from ..faults import ConfigError

_MOST_SHOWN = 40  # characters of a value in a fault


def read_text(file: str, where: str) -> str:
    """A file's text in UTF-8, without its byte order mark; ConfigError, naming `where`, if it cannot be read."""
    try:
        return Path(file).read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise ConfigError(f"{where} = {file}; expected a readable file ({error.strerror})") from error
    except ValueError as error:  # of a path, too
        raise ConfigError(f"{where} = {file}; expected a text file in UTF-8 ({error})") from error


def shown(value) -> str:
    """A value of a JSON file as it stands there, cut short if it is long."""
    try:
        text = json.dumps(value)
    except RecursionError:  # lists in lists, as deep as json.loads could just read
        return "[[[…"
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}…"


def is_number(value) -> bool:
    """Whether a value of a JSON file is a number, which Python thinks true and false are, too."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def checked_number(value, where: str, what: str, low: float, high: float, unit: str) -> float:
    """A value of a JSON file that is a number from low to high; else ConfigError, naming `where`."""
    if not is_number(value) or not low <= value <= high:
        of_unit = f" {unit}" if is_number(value) else ""
        raise ConfigError(f"{where} = {shown(value)}{of_unit}; expected {what}, {low:g} to {high:g} {unit}")
    return float(value)
