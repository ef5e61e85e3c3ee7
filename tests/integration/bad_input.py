"""What a bad input is, and what may be made in spite of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

FRAME = "000001.exr"
RUN = ("convert", "one", "--out", "out", "--quiet")

# What is made in spite of it.
NOTHING, NO_CLIP, OTHERS, ALL = "nothing", "no clip", "the other frames", "all frames"


@dataclass(frozen=True)
class BadInput:
    """One of them. `spoil` has a folder of good passes, three frames of clip one, to do its worst to."""

    group: str
    name: str
    spoil: Callable[[Path], None]
    code: int
    told: str  # standard error, without "veldt: " at the beginning of its lines
    made: str
    more: tuple[str, ...] = ()  # arguments
