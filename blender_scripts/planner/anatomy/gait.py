"""Positions of feet: fixed on the ground during stance, moving through the air to the next footprint otherwise.

Everything depends on the distance walked, not on time, so feet stand still whenever the body does.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.easing import smooth
from ..geometry.components import about, facing, product, unit
from ..land.terrain import Terrain

_GRAVITY_M_S2 = 9.81
_WALKING_FROUDE = (0.02, 0.3)  # range in which walking strides are known; faster walkers take more steps
_STRIKE = 0.12  # of a stance, until the foot is flat: at 7 % of a stride (Perry 1992)
_SOLE_M = 0.12  # before and behind a foot, to measure the ground's slope

# Distances (..., n) to points (..., n, 2) and headings (..., n, 2).
Path = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Leg:
    """A leg's bones from the hip down, the point about which its foot rolls over the toe, and its timing.

    phase: fraction of a stride at which it touches down; glide: fraction of the foot's offset from its neutral position
    that the hip follows, as shoulder blades and hips do; heel_rad: angle of the heel when the foot lifts off;
    strike_rad: angle of the toe at touch-down, from which the foot rolls over its heel, foot_m behind the toe.
    """

    bones: tuple[int, int, int]
    toe_m: np.ndarray
    phase: float
    glide: float
    lift_m: float
    heel_rad: float
    strike_rad: float = 0.0
    foot_m: float = 0.0


@dataclass(frozen=True)
class Footing:
    """The feet of legs at n moments.

    toe_m (3, legs, n), rotation (3, 3, legs, n), bearing (legs, n): true while on the ground; strike_rad (legs, n):
    angle of raised toes, when the heel carries the weight.
    """

    toe_m: np.ndarray
    rotation: np.ndarray
    bearing: np.ndarray
    strike_rad: np.ndarray


def stride_m(speed_m_s: float, leg_m: float) -> float:
    """Length of a walking stride: 2.3 legs times the Froude number to the power 0.3 (Alexander 1976, solved for it).

    Speeds are clamped to the range of a walk; leg_m is the height of the hip.
    """
    froude = np.clip(speed_m_s**2 / (_GRAVITY_M_S2 * leg_m), *_WALKING_FROUDE)
    return float(2.3 * leg_m * froude**0.3)


def footing(
    legs: Sequence[Leg], stance: float, stride, scale, path: Path, ground: Terrain, walked_m, pace
) -> Footing:
    """The feet of legs after walked_m (n,) along a path; stride and scale are numbers or (n,).

    `stance` is the fraction of a stride that a foot is on the ground.
    Footprint n is the point below the leg's hip in the middle of the n-th stance. pace (n,), from 0 standing to 1
    walking, scales how high feet are lifted: a walker that stops in mid-stride puts its feet down.
    """
    phase, lift_m, heel_rad, strike_rad, foot_m = (
        np.array([getattr(leg, name) for leg in legs])[:, None]
        for name in ("phase", "lift_m", "heel_rad", "strike_rad", "foot_m")
    )
    steps = walked_m / stride - phase
    number = np.floor(steps)
    on_ground = np.minimum((steps - number) / stance, 1.0)
    in_air = np.maximum((steps - number - stance) / (1.0 - stance), 0.0)
    middle_m = (number + phase + 0.5 * stance) * stride
    point_m, heading = _prints(legs, scale, path, np.stack([middle_m, middle_m + stride]))
    share = smooth(in_air)
    x_m, y_m = _between(point_m, share)
    height_m, flat = _soles(ground, x_m, y_m, unit(_between(heading, share)))
    lift_m = lift_m * scale * pace * 16.0 * (in_air * (1.0 - in_air)) ** 2
    heel = heel_rad * pace * (smooth((on_ground - 0.55) / 0.45) - smooth(in_air / 0.8))
    strike = strike_rad * pace * (smooth(2.0 * in_air - 1.0) + 1.0 - smooth(on_ground / _STRIKE))
    toe_m = np.stack([x_m, y_m, height_m + lift_m])
    toe_m += foot_m * scale * (np.sin(strike) * flat[:, 2] - (1.0 - np.cos(strike)) * flat[:, 0])
    return Footing(toe_m, product(flat, about("y", heel - strike)), in_air == 0.0, strike)


def _prints(legs: Sequence[Leg], scale, path: Path, middle_m) -> tuple[np.ndarray, np.ndarray]:
    """Footprints (2, from and to, legs, n) of stances centred on distances (from and to, legs, n); their headings."""
    point, heading = (np.moveaxis(part, -1, 0) for part in path(middle_m))
    left = np.stack([-heading[1], heading[0]])
    ahead_m, aside_m, _ = np.array([leg.toe_m for leg in legs]).T[:, :, None]
    return point + scale * (heading * ahead_m + left * aside_m), heading


def _between(ends: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Values (2, legs, n) at shares (legs, n) of the way between their two ends (2, from and to, legs, n)."""
    return ends[:, 0] + share * (ends[:, 1] - ends[:, 0])


def _soles(ground: Terrain, x_m, y_m, heading: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Heights (legs, n) of the ground below feet, and rotations (3, 3, legs, n) of feet flat on it."""
    ahead, left = _SOLE_M * heading, _SOLE_M * np.stack([-heading[1], heading[0]])
    off_x, off_y = np.stack([np.zeros_like(ahead), ahead, -ahead, left, -left], axis=1)
    height_m, *ends_m = ground.height_m(x_m + off_x, y_m + off_y)
    pitch, roll = ((ends_m[k] - ends_m[k + 1]) / (2.0 * _SOLE_M) for k in (0, 2))
    turn = product(facing(heading), about("y", -np.arctan(pitch)))
    return height_m, product(turn, about("x", np.arctan(roll)))
