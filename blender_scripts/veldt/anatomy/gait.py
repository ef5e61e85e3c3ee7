"""Positions of feet: fixed on the ground during stance, moving through the air to the next footprint otherwise.

Everything depends on the distance walked, not on time, so feet stand still whenever the body does.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..geometry.easing import smooth
from ..geometry.rotations import about, facing, left_of, unit
from ..land.terrain import Terrain

_GRAVITY_M_S2 = 9.81
_WALKING_FROUDE = (0.02, 0.3)  # of speeds that walking strides are given for; faster walkers step more often
_SOLE_M = 0.12  # before and behind a foot, where the ground's slope below it is measured

Path = Callable[
    [np.ndarray], tuple[np.ndarray, np.ndarray]
]  # distances (n,) to points (n, 2), headings (n, 2)


@dataclass(frozen=True)
class Leg:
    """A leg's bones from the hip down, the point about which its foot rolls over the toe, and its timing.

    phase: fraction of a stride at which it touches down; glide: fraction of the foot's offset from its place below the
    body that the hip follows, as shoulder blades and hips do; heel_rad: angle of the heel when the foot lifts off.
    """

    bones: tuple[int, int, int]
    toe_m: np.ndarray
    phase: float
    glide: float
    lift_m: float
    heel_rad: float


@dataclass(frozen=True)
class Footing:
    """The foot of one leg at n moments: toe_m (n, 3), rotation (n, 3, 3), bearing (n,) true while on the ground."""

    toe_m: np.ndarray
    rotation: np.ndarray
    bearing: np.ndarray


def stride_m(speed_m_s: float, leg_m: float) -> float:
    """Length of a walking stride: 2.3 legs times the Froude number to the power 0.3 (Alexander 1976, solved for it).

    Speeds are clamped to the range of a walk; leg_m is the height of the hip.
    """
    froude = np.clip(speed_m_s**2 / (_GRAVITY_M_S2 * leg_m), *_WALKING_FROUDE)
    return float(2.3 * leg_m * froude**0.3)


def footing(
    leg: Leg, stance: float, stride: float, scale: float, path: Path, ground: Terrain, walked_m, pace
) -> Footing:
    """A leg's foot after walked_m (n,) along a path; `stance` is the fraction of a stride that it is on the ground.

    Footprint n is where the leg's place below the body is in the middle of the n-th stance. pace (n,), from 0 standing
    to 1 walking, scales how high feet are lifted: a walker that stops in mid-stride puts its feet down.
    """
    steps = walked_m / stride - leg.phase
    number = np.floor(steps)
    on_ground = np.minimum((steps - number) / stance, 1.0)
    in_air = np.maximum((steps - number - stance) / (1.0 - stance), 0.0)
    middle_m = (number + leg.phase + 0.5 * stance) * stride
    from_m, from_heading = _print(leg, scale, path, middle_m)
    to_m, to_heading = _print(leg, scale, path, middle_m + stride)
    share = smooth(in_air)[:, None]
    x_m, y_m = (from_m + share * (to_m - from_m)).T
    heading = unit(from_heading + share * (to_heading - from_heading))
    lift_m = leg.lift_m * scale * pace * 16.0 * (in_air * (1.0 - in_air)) ** 2
    heel = leg.heel_rad * pace * (smooth((on_ground - 0.55) / 0.45) - smooth(in_air / 0.8))
    return Footing(
        np.column_stack([x_m, y_m, ground.height_m(x_m, y_m) + lift_m]),
        _on_slope(ground, x_m, y_m, heading) @ about("y", heel),
        in_air == 0.0,
    )


def _print(leg: Leg, scale: float, path: Path, middle_m) -> tuple[np.ndarray, np.ndarray]:
    """Footprints (n, 2) of stances centred on these distances, and their headings (n, 2)."""
    point, heading = path(middle_m)
    return point + scale * (facing(heading) @ leg.toe_m)[:, :2], heading


def _on_slope(ground: Terrain, x_m, y_m, heading: np.ndarray) -> np.ndarray:
    """Rotations (n, 3, 3) of feet flat on the ground."""
    rises = []
    for along in (heading, left_of(heading)):
        ahead = ground.height_m(x_m + _SOLE_M * along[:, 0], y_m + _SOLE_M * along[:, 1])
        behind = ground.height_m(x_m - _SOLE_M * along[:, 0], y_m - _SOLE_M * along[:, 1])
        rises.append((ahead - behind) / (2.0 * _SOLE_M))
    return facing(heading) @ about("y", -np.arctan(rises[0])) @ about("x", np.arctan(rises[1]))
