"""Loops around a point that stay on passable ground."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..geometry.splines import Loop
from ..noise import stream

CORNERS = 12
SLOPE_STEP_M = 8.0  # distance over which slope is measured: paths cross gullies but avoid hillsides
_TRIES = 40
_STEP = 0.04  # of the radius: step by which a corner on impassable ground is moved
_CHECK_M = 4.0  # between the points checked along a loop

Passable = Callable[[np.ndarray, np.ndarray], np.ndarray]  # x_m, y_m (n,) to (n,) booleans


def plan_loop(
    centre_m, radius_m: float, wander: float, passable: Passable, seed: int, name: str
) -> Loop | None:
    """A loop around `centre_m` with corners at radius_m, varied randomly by a fraction `wander` of it.

    Corners are moved in or out, by as little as possible, until the whole loop is passable; None if there is no such
    loop.
    """
    rng = stream(seed, f"route/{name}")
    angle = (
        2.0
        * np.pi
        * (np.arange(CORNERS) + 0.5 * rng.uniform(-1.0, 1.0, CORNERS) * min(wander, 0.5))
        / CORNERS
    )
    drawn_m = radius_m * (1.0 + wander * rng.uniform(-1.0, 1.0, CORNERS))
    outward = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    radii_m, tries = drawn_m.copy(), np.zeros(CORNERS, np.int64)
    for _ in range(_TRIES):
        loop = Loop(np.asarray(centre_m, float) + radii_m[:, None] * outward)
        bad = _bad_corners(loop, passable)
        if not bad.any():
            return loop
        tries[bad] += 1
        # 1, -1, 2, -2, … steps from the original position.
        steps = (tries + 1) // 2 * np.where(tries % 2 == 1, 1.0, -1.0)
        radii_m = np.maximum(drawn_m + _STEP * radius_m * steps, 0.2 * radius_m)
    return None


def _bad_corners(loop: Loop, passable: Passable) -> np.ndarray:
    """Mask of corners (n,) at either end of a segment that is not passable all along."""
    along_m = np.linspace(0.0, loop.length_m, int(loop.length_m / _CHECK_M) + 2)
    bad_m = along_m[~passable(*loop.at(along_m)[0].T)]
    segment = np.clip(np.searchsorted(loop.corners_at_m, bad_m, "right") - 1, 0, CORNERS - 1)
    bad = np.zeros(CORNERS, bool)
    bad[segment] = bad[(segment + 1) % CORNERS] = True
    return bad
