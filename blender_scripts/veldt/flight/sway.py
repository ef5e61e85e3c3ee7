"""How gusts push an aircraft about that holds its place, how it leans, and what of that its gimbal lets through."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .aircraft import FIXED_WING, GRAVITY_M_S2, MULTIROTOR
from .filters import lag_error, product, states

_NOTHING = 1e-18  # a smaller share of a sum is lost in rounding


@dataclass(frozen=True)
class Hold:
    """Along one axis: drag takes up a gust within drag_s, and the autopilot steers against offset and speed."""

    drag_s: float
    stiffness_per_s2: float
    damping_per_s: float


# Along the nose, left, up. Times of drag are estimates: a multirotor leans 30 degrees to fly 17 m/s, and its rotors
# thrust the more the faster air sinks through them; a wing of 6 kg/m^2 flies 16 m/s, its drag coefficient is 0.05, its
# side force 0.3 and its lift 4.5 for each rad (2 m / (rho V S C), half of it along the nose).
# A multirotor's gains are PX4's defaults: damping is MPC_XY_VEL_P_ACC 1.8 and MPC_Z_VEL_P_ACC 4, stiffness these times
# MPC_XY_P 0.95 and MPC_Z_P 1. A wing steers left and right as by PX4's NPFG_PERIOD 10 s and NPFG_DAMPING 0.7, and
# comes back up or down in FW_T_ALT_TC 5 s, that is (1 / drag + damping) / stiffness; how this is shared out between the
# gains is an estimate, and so is its hold along the nose, at half the pace of the one sideways.
_HOLDS = {
    MULTIROTOR: (Hold(3.0, 1.71, 1.8), Hold(3.0, 1.71, 1.8), Hold(1.5, 4.0, 4.0)),
    FIXED_WING: (Hold(6.0, 0.099, 0.44), Hold(2.0, 0.395, 0.88), Hold(0.14, 2.4, 5.0)),
}


@dataclass(frozen=True)
class Sway:
    """At n moments: offset_m (n, 3) from where the aircraft should be; control_m_s2 (n, 3) by which it steers back."""

    offset_m: np.ndarray
    control_m_s2: np.ndarray


def sway(gusts_m_s: np.ndarray, step_s: float, kind: str) -> Sway:
    """How gusts (n, 3) along the nose, to the left and up move an aircraft of a kind, in these axes.

    x'' = (w - x') / drag - damping x' - stiffness x along each axis, from rest in its place at the first moment. Exact
    for gusts that are linear from one moment to the next, for steps up to 1 s. The mean wind is left out: autopilots
    learn to lean against it. Standard deviations in m, 60 m above ground:

                              light                moderate             severe
        multirotor at 8 m/s   0.23, 0.23, 0.11     0.45, 0.44, 0.21     0.67, 0.65, 0.30
        fixed wing at 16 m/s  1.71, 1.29, 1.22     3.30, 2.50, 2.24     4.73, 3.60, 3.04
    """
    held = [_held(gusts, step_s, hold) for gusts, hold in zip(gusts_m_s.T, _HOLDS[kind])]
    offset_m, control_m_s2 = (np.stack(each, axis=-1) for each in zip(*held))
    return Sway(offset_m, control_m_s2)


def tilt_rad(acceleration_m_s2: np.ndarray) -> np.ndarray:
    """Rotation vectors (n, 3) in the world, about level axes, that lean thrust towards level accelerations (n, 2).

    z x a / g: the angle's tangent instead of the angle, a tenth too much at 30 degrees.
    """
    x, y = acceleration_m_s2.T / GRAVITY_M_S2
    return np.stack([-y, x, np.zeros_like(x)], axis=-1)


def unsteadiness_rad(leaning_rad: np.ndarray, lag_s: float, step_s: float) -> np.ndarray:
    """What a gimbal that evens out leaning (n, 3) with a lag lets through of it (n, 3); without a lag, nothing."""
    return lag_error(leaning_rad, lag_s, step_s)


def lagged_angles(commanded_rad: np.ndarray, lag_s: float, step_s: float) -> np.ndarray:
    """Angles (n,) that a gimbal takes up with a lag, the commanded ones (n,) without; these jump by no whole turns."""
    return commanded_rad - lag_error(commanded_rad, lag_s, step_s)


def _held(gusts_m_s: np.ndarray, step_s: float, hold: Hold) -> tuple[np.ndarray, np.ndarray]:
    """Offset (n,) and steering acceleration (n,) along an axis."""
    moved = _transition(step_s, hold)[:2]
    pushed = np.zeros((2, len(gusts_m_s)))
    pushed[:, 1:] = moved[:, 2:3] * gusts_m_s[:-1] + moved[:, 3:] * np.diff(gusts_m_s)
    offset_m, speed_m_s = states(moved[:, :2], pushed)
    return offset_m, -hold.damping_per_s * speed_m_s - hold.stiffness_per_s2 * offset_m


def _transition(step_s: float, hold: Hold) -> np.ndarray:
    """Offset, speed, gust and the gust's change in a step (4, 4), from those at its beginning: a matrix exponential."""
    braked = 1.0 / hold.drag_s + hold.damping_per_s
    rate = np.zeros((4, 4))
    rate[0, 1] = step_s
    rate[1, :3] = -hold.stiffness_per_s2 * step_s, -braked * step_s, step_s / hold.drag_s
    rate[2, 3] = 1.0
    total, term, k = np.eye(4), np.eye(4), 0
    while np.abs(term).max() > _NOTHING:
        k += 1
        term = product(term, rate) / k
        total += term
    return total
