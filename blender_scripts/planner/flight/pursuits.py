"""Flights that follow or orbit a moving target."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.rotations import heading_of
from ..groups.actors import Actor, track

_STEP_S = 0.1  # time step of targets and their followers; faster motion is irrelevant
_MARGIN_S = 12.0  # before and after, for averages
_TARGET_SIGMA_S = 1.0  # a pilot follows the general direction of a target, not each of its turns
_HEADING_SIGMA_S = 3.0
_EASING_S = 2.0  # over which an aircraft changes its speed


@dataclass(frozen=True)
class Pursuit:
    """The wanted position of an aircraft, point_m (n, 2), and its target, target_m (n, 3)."""

    point_m: np.ndarray
    target_m: np.ndarray
    bearing_rad: np.ndarray  # (n,) from the wanted position to the target


def follow(plan: dict, actors: Sequence[Actor], time_s: np.ndarray) -> Pursuit:
    """Beside a target at azimuth_deg, at the distance that gives look_angle_deg over level ground, up to speed_m_s.

    time_s (n,) increases from 0.
    """
    coarse_s = _coarse_times(time_s)
    target_m, heading = _smoothed_targets(actors, coarse_s)
    rise_m = plan["altitude_m"] - (target_m[:, 2] if plan["altitude_reference"] == "datum" else 0.0)
    back_m = np.abs(rise_m) / np.tan(np.radians(plan["look_angle_deg"])) + np.zeros(len(coarse_s))
    outward_rad = _continuous_angle(heading) + np.radians(plan["azimuth_deg"])
    wanted_m = target_m[:, :2] + back_m[:, None] * heading_of(outward_rad)
    point_m = _averaged(_chased(wanted_m, plan["speed_m_s"] * _STEP_S), _EASING_S)
    return Pursuit(
        _at(time_s, coarse_s, point_m),
        _at(time_s, coarse_s, target_m),
        _at(time_s, coarse_s, outward_rad + np.pi),
    )


def orbit(plan: dict, actors: Sequence[Actor], height_at, time_s: np.ndarray) -> Pursuit:
    """Circle a target or centre_m at radius_m and speed_m_s, starting at azimuth_deg."""
    if actors:
        coarse_s = _coarse_times(time_s)
        target_m = _at(time_s, coarse_s, _smoothed_targets(actors, coarse_s)[0])
    else:
        x_m, y_m = plan["centre_m"]
        target_m = np.tile([x_m, y_m, float(height_at(x_m, y_m))], (len(time_s), 1))
    sense = 1.0 if plan["turn"] == "left" else -1.0
    outward_rad = np.radians(plan["azimuth_deg"]) + sense * plan["speed_m_s"] / plan["radius_m"] * time_s
    point_m = target_m[:, :2] + plan["radius_m"] * heading_of(outward_rad)
    return Pursuit(point_m, target_m, outward_rad + np.pi)


def _coarse_times(time_s: np.ndarray) -> np.ndarray:
    """Moments from well before 0 to well past the last time; their values do not depend on the last time."""
    first, last = -round(_MARGIN_S / _STEP_S), int(np.ceil((time_s[-1] + _MARGIN_S) / _STEP_S))
    return np.arange(first, last + 1) * _STEP_S


def _smoothed_targets(actors: Sequence[Actor], time_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The smoothed mean position of the actors' bodies (n, 3) and their smoothed mean heading (n, 2)."""
    tracks = [track(actor, time_s) for actor in actors]
    middle_m = np.mean([t.position_m for t in tracks], axis=0)
    middle_m[:, 2] += np.mean([actor.bounds_m[:, 2].mean() for actor in actors])
    heading = _smoothed(np.sum([t.heading for t in tracks], axis=0), _HEADING_SIGMA_S)
    length = np.linalg.norm(heading, axis=1, keepdims=True)
    # Members that walk in all directions have no common heading; +x is an arbitrary choice.
    level = np.where(length > 1e-9, heading / np.maximum(length, 1e-9), [1.0, 0.0])
    return _smoothed(middle_m, _TARGET_SIGMA_S), level


def _chased(wanted_m: np.ndarray, step_m: float) -> np.ndarray:
    """Points (n, 2) that follow others by at most step_m per moment."""
    x_m, y_m = wanted_m[0].tolist()
    chased = []
    for to_x_m, to_y_m in wanted_m.tolist():
        dx_m, dy_m = to_x_m - x_m, to_y_m - y_m
        share = min(1.0, step_m / max((dx_m * dx_m + dy_m * dy_m) ** 0.5, 1e-12))
        x_m, y_m = x_m + share * dx_m, y_m + share * dy_m
        chased.append((x_m, y_m))
    return np.array(chased)


def _smoothed(values: np.ndarray, sigma_s: float) -> np.ndarray:
    """Values (n, k) averaged by a Gaussian truncated at three sigma; the ends are extended by their last values."""
    reach = round(3.0 * sigma_s / _STEP_S)
    taps = np.exp(-0.5 * (np.arange(-reach, reach + 1) * _STEP_S / sigma_s) ** 2)
    return _filtered(values, taps / taps.sum())


def _averaged(values: np.ndarray, over_s: float) -> np.ndarray:
    count = 2 * round(0.5 * over_s / _STEP_S) + 1
    return _filtered(values, np.full(count, 1.0 / count))


def _filtered(values: np.ndarray, taps: np.ndarray) -> np.ndarray:
    reach = len(taps) // 2
    padded = np.pad(values, ((reach, reach), (0, 0)), mode="edge")
    return sum(tap * padded[k : k + len(values)] for k, tap in enumerate(taps))


def _continuous_angle(heading: np.ndarray) -> np.ndarray:
    return np.unwrap(np.arctan2(heading[:, 1], heading[:, 0]))


def _at(time_s: np.ndarray, coarse_s: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values (m, …) given at coarse moments, linearly interpolated."""
    if values.ndim == 1:
        return np.interp(time_s, coarse_s, values)
    return np.stack([np.interp(time_s, coarse_s, column) for column in values.T], axis=-1)
