"""Faults of a config, in words a user can act on."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Iterable


class ConfigError(Exception):
    """A config that is well formed but cannot be meant: `<where> = <value> <unit>; expected <rule>`."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """`; did you mean "x"?` for the closest known name, or nothing where none is close."""
    near = difflib.get_close_matches(name, list(known), n=1)
    return f'; did you mean "{near[0]}"?' if near else ""


def listing(names: Iterable[str]) -> str:
    """Names in a sentence; `none` where there are none."""
    return ", ".join(sorted(names)) or "none"


def check_known(name: str, there: Collection[str], where: str, what: str) -> None:
    """ConfigError that lists what there is, unless `name` is there."""
    if name not in there:
        raise ConfigError(f'{where} = "{name}"; expected {what}: {listing(there)}{did_you_mean(name, there)}')
