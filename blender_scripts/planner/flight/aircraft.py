"""The performance limits of an aircraft."""

from __future__ import annotations

import math
from dataclasses import dataclass

GRAVITY_M_S2 = 9.80665  # standard gravity
_MOST_ACCELERATION_M_S2 = 3.0  # estimate: acceleration and braking on surveys, at any bank angle

MULTIROTOR = "multirotor"
FIXED_WING = "fixed_wing"


@dataclass(frozen=True)
class Aircraft:
    """A multirotor, which stops at corners, or a fixed wing, which cannot; bank_rad: largest bank angle, above 0."""

    kind: str
    speed_m_s: float
    bank_rad: float

    @property
    def turn_radius_m(self) -> float:
        """Radius of a level turn at full bank and speed: v^2 / (g tan(bank))."""
        return self.speed_m_s**2 / (GRAVITY_M_S2 * math.tan(self.bank_rad))

    @property
    def acceleration_m_s2(self) -> float:
        """Acceleration and deceleration of a multirotor: that of leaning by bank_rad, at most 3 m/s^2."""
        return min(GRAVITY_M_S2 * math.tan(self.bank_rad), _MOST_ACCELERATION_M_S2)


def aircraft_of(plan: dict) -> Aircraft:
    """The aircraft of a flight plan."""
    return Aircraft(plan["aircraft"], plan["speed_m_s"], math.radians(plan["bank_deg"]))
