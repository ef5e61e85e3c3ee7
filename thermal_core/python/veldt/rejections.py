"""Rejected external input: counted by reason, and reported at most once a minute for each."""

from __future__ import annotations

import math
from collections.abc import Callable

from veldt import ConfigError

_EACH_S = 60.0


class Unusable(ConfigError):
    """Received input that cannot be used. `reason`: one of a few, in two or three words."""

    def __init__(self, reason: str, where: str, value: object, expected: str) -> None:
        super().__init__(f"{where} = {_shown(value)}; expected {expected}")
        self.reason = reason


class Rejections:
    """Counts by reason. Reasons are few and fixed, so that a flood of faults takes no more memory."""

    def __init__(self, report: Callable[[str], None] = lambda _: None) -> None:
        """report: receives a line of text for the first fault of a reason, and for the next after a minute or more."""
        self.counts: dict[str, int] = {}
        self._report = report
        self._reported_s: dict[str, float] = {}

    def add(self, fault: Unusable, now_s: float, times: int = 1) -> None:
        """Count a rejection at a time [s] of a monotonic clock."""
        count = self.counts[fault.reason] = self.counts.get(fault.reason, 0) + times
        if now_s - self._reported_s.get(fault.reason, -math.inf) >= _EACH_S:
            self._reported_s[fault.reason] = now_s
            self._report(f"rejected: {fault} ({fault.reason}; {count} up to now)")

    def __len__(self) -> int:
        """Total of all reasons."""
        return sum(self.counts.values())

    def __str__(self) -> str:
        """Such as "3 out of range, 1 no fix"."""
        return ", ".join(f"{count} {reason}" for reason, count in self.counts.items())


def number_within(where: str, value: object, unit: str, least: float, most: float) -> float:
    """A received number. Unusable if it is not a number, or out of bounds."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise Unusable("wrong type", where, value, "a number")
    if not least <= value <= most:
        reason = "not a number" if math.isnan(value) else "out of range"
        raise Unusable(reason, where, f"{value:.9g} {unit}".rstrip(), f"{least:.9g} to {most:.9g}")
    return float(value)


def _shown(value: object) -> str:
    """Short, and without control characters for terminals."""
    text = value if isinstance(value, str) else repr(value)
    text = text.encode("ascii", "backslashreplace").decode()
    text = "".join(letter if letter.isprintable() else "?" for letter in text)
    return text if len(text) <= 60 else text[:57] + "..."
