"""The format of the table of bad inputs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

FRAME = "000001.exr"
RUN = ("convert", "one", "--out", "out", "--quiet")

# The output in spite of the fault.
NOTHING, NO_CLIP, OTHERS, ALL = "nothing", "no clip", "the other frames", "all frames"


@dataclass(frozen=True)
class BadInput:
    """A bad input. `spoil` receives a folder with valid passes, three frames of clip one, and damages it."""

    group: str
    name: str
    spoil: Callable[[Path], None]
    code: int
    message: str  # standard error, without "veldt: " at the beginning of its lines
    made: str
    more: tuple[str, ...] = ()  # arguments
