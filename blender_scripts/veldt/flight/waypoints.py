"""Points on a flight path."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Waypoint:
    """A place to fly to: height_m above ground or above the datum; hold_s to stay there.

    speed_m_s applies from here on; None keeps the speed.
    """

    point_m: tuple[float, float]
    height_m: float
    is_agl: bool
    hold_s: float = 0.0
    speed_m_s: float | None = None
