"""The response of an aircraft to gusts: its displacement, its tilt, and the part of it that the gimbal lets through."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .aircraft import FIXED_WING, GRAVITY_M_S2, MULTIROTOR
from .filters import lag_error, product, states

_NOTHING = 1e-18  # a smaller term of a sum is lost in rounding


@dataclass(frozen=True)
class Hold:
    """Dynamics along one axis: drag with time constant drag_s, and an autopilot that acts against offset and speed."""

    drag_s: float
    stiffness_per_s2: float
    damping_per_s: float


# Forward, left, up. Drag time constants are estimates: a multirotor leans 30 degrees to fly 17 m/s, and its rotors
# gain thrust with the speed of the air sinking through them; a wing of 6 kg/m^2 flies 16 m/s with a drag coefficient of
# 0.05 and coefficients of side force 0.3 and lift 4.5 per rad (2 m / (rho V S C), half of it forward).
# A multirotor's gains are PX4's defaults: damping is MPC_XY_VEL_P_ACC 1.8 and MPC_Z_VEL_P_ACC 4, stiffness these times
# MPC_XY_P 0.95 and MPC_Z_P 1. A wing steers laterally with PX4's NPFG_PERIOD 10 s and NPFG_DAMPING 0.7, and returns to
# its height in FW_T_ALT_TC 5 s, that is (1 / drag + damping) / stiffness; how this is divided between the gains is an
# estimate, and so is its forward control, at half the rate of the lateral one.
_HOLDS = {
    MULTIROTOR: (Hold(3.0, 1.71, 1.8), Hold(3.0, 1.71, 1.8), Hold(1.5, 4.0, 4.0)),
    FIXED_WING: (Hold(6.0, 0.099, 0.44), Hold(2.0, 0.395, 0.88), Hold(0.14, 2.4, 5.0)),
}


@dataclass(frozen=True)
class Disturbance:
    """At n moments: offset_m (n, 3) from the wanted position; control_m_s2 (n, 3), the acceleration back towards it."""

    offset_m: np.ndarray
    control_m_s2: np.ndarray


def disturbance_response(gusts_m_s: np.ndarray, step_s: float, kind: str) -> Disturbance:
    """The response of a kind of aircraft to gusts (n, 3) forward, left and up, in these axes.

    x'' = (w - x') / drag - damping x' - stiffness x along each axis, starting at rest at the wanted position. Exact for
    gusts that are linear between moments, for steps up to 1 s. The mean wind is left out: autopilots compensate for
    it. Standard deviations in m, 60 m above ground:

                              light                moderate             severe
        multirotor at 8 m/s   0.23, 0.23, 0.11     0.45, 0.44, 0.21     0.67, 0.65, 0.30
        fixed wing at 16 m/s  1.71, 1.29, 1.22     3.30, 2.50, 2.24     4.73, 3.60, 3.04
    """
    held = [_held(gusts, step_s, hold) for gusts, hold in zip(gusts_m_s.T, _HOLDS[kind])]
    offset_m, control_m_s2 = (np.stack(each, axis=-1) for each in zip(*held))
    return Disturbance(offset_m, control_m_s2)


def tilt_rad(acceleration_m_s2: np.ndarray) -> np.ndarray:
    """Rotation vectors (n, 3) in world axes, about horizontal axes, that tilt thrust towards accelerations (n, 2).

    z x a / g: the tangent of the angle instead of the angle, a tenth too large at 30 degrees.
    """
    x, y = acceleration_m_s2.T / GRAVITY_M_S2
    return np.stack([-y, x, np.zeros_like(x)], axis=-1)


def unsteadiness_rad(leaning_rad: np.ndarray, lag_s: float, step_s: float) -> np.ndarray:
    """The tilt (n, 3) that remains after a gimbal with a lag compensates for tilt (n, 3); zero without a lag.

    Its gyroscopes measure rates and its loop integrates them, so that none remains of a tilt at a constant rate: a
    second-order high pass, critically damped, s^2 / (s + 1 / lag)^2.
    """
    return lag_error(lag_error(leaning_rad, lag_s, step_s), lag_s, step_s)


def lagged_angles(commanded_rad: np.ndarray, lag_s: float, step_s: float) -> np.ndarray:
    """Angles (n,) of a gimbal that follows commanded angles (n,), which are unwrapped, with a lag."""
    return commanded_rad - lag_error(commanded_rad, lag_s, step_s)


def _held(gusts_m_s: np.ndarray, step_s: float, hold: Hold) -> tuple[np.ndarray, np.ndarray]:
    """Offset (n,) and steering acceleration (n,) along an axis."""
    moved = _transition(step_s, hold)[:2]
    pushed = np.zeros((2, len(gusts_m_s)))
    pushed[:, 1:] = moved[:, 2:3] * gusts_m_s[:-1] + moved[:, 3:] * np.diff(gusts_m_s)
    offset_m, speed_m_s = states(moved[:, :2], pushed)
    return offset_m, -hold.damping_per_s * speed_m_s - hold.stiffness_per_s2 * offset_m


def _transition(step_s: float, hold: Hold) -> np.ndarray:
    """The transition (4, 4) of offset, speed, gust and the gust's change over one step: a matrix exponential."""
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
