"""Faults in a config, described so that the user can fix them."""

from __future__ import annotations

import difflib
import signal
from collections.abc import Collection, Iterable


class ConfigError(Exception):
    """A well-formed but invalid config: `<where> = <value> <unit>; expected <rule>`."""


class ProcessLost(Exception):
    """A child process ended before its work was done; `killed` if by a signal from outside, such as when memory runs
    out.
    """

    def __init__(self, name: str, code: int):
        """code: -N for signal N."""
        how = (
            f"was killed by signal {-code} ({signal.strsignal(-code)})"
            if code < 0
            else f"ended with exit code {code}"
        )
        super().__init__(f"{name} {how}")
        self.killed = -code in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """`; did you mean "x"?` for the closest known name, or an empty string if none is close."""
    near = difflib.get_close_matches(name, list(known), n=1)
    return f'; did you mean "{near[0]}"?' if near else ""


def listing(names: Iterable[str]) -> str:
    """Names as part of a sentence; `none` if there are none."""
    return ", ".join(sorted(names)) or "none"


def check_known(name: str, there: Collection[str], where: str, what: str) -> None:
    """Raise ConfigError, which lists the known names, unless `name` is one of them."""
    if name not in there:
        raise ConfigError(f'{where} = "{name}"; expected {what}: {listing(there)}{did_you_mean(name, there)}')
