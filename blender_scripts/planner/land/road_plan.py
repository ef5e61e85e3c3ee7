"""The course of the road: a loop through the scene, off water and steep ground, and a fork that leads out of it."""

from __future__ import annotations

import numpy as np

from ..geometry.splines import Line, Loop
from ..noise import stream
from .roads import Road, lay_road
from .terrain import Terrain, slope_deg
from .ways import CORNERS, SLOPE_STEP_M, Passable, plan_loop

_RADII = (
    0.3,
    0.26,
    0.34,
    0.22,
)  # radii to try, as shares of the scene's side; the first with a passable loop is used
_WANDER = 0.22
_SHORE_M = 25.0
_STEEPEST_DEG = 14.0  # estimate: steepest slope that a lorry can drive
_MOST_CRAG = 0.3
_BORDER_M = 15.0
_BEND_RAD = np.radians(25.0)  # largest turn between successive segments of the spur
_STRETCHES = 4
_CHECK_M = 4.0


def plan_road(settings: dict, terrain: Terrain, seed: int) -> Road | None:
    """The road of `scene.terrain.road` over a terrain; None if there is none, or if no ground is suitable."""
    if settings["width_m"] <= 0:
        return None
    passable = _fit_ground(terrain)
    if "points_m" in settings:
        loop: Loop | None = Loop(settings["points_m"])
    else:
        loop = _plan_loop(terrain.size_m, passable, seed)
    if loop is None:
        return None
    spur = _plan_spur(loop, terrain, passable, seed) if settings["fork"] else None
    return lay_road(loop, spur, settings["width_m"], terrain.size_m, terrain.cell_m, terrain.height_m)


def _fit_ground(terrain: Terrain) -> Passable:
    def passable(x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
        fit = np.maximum(np.abs(x_m), np.abs(y_m)) < 0.5 * terrain.size_m - _BORDER_M
        fit &= terrain.shore_m(x_m, y_m) > _SHORE_M
        fit &= slope_deg(terrain, x_m, y_m, SLOPE_STEP_M) < _STEEPEST_DEG
        return fit & (terrain.crag.share(x_m, y_m) < _MOST_CRAG) if terrain.crag else fit

    return passable


def _plan_loop(size_m: float, passable: Passable, seed: int) -> Loop | None:
    drawn = (plan_loop((0.0, 0.0), radius * size_m, _WANDER, passable, seed, "road") for radius in _RADII)
    return next((loop for loop in drawn if loop is not None), None)


def _plan_spur(loop: Loop, terrain: Terrain, passable: Passable, seed: int) -> Line | None:
    """A road from one of the loop's corners out towards the border: the first that is entirely passable."""
    rng = stream(seed, "road/spur")
    for corner in rng.permutation(CORNERS):
        at_m = loop.corners_at_m[corner % (len(loop.corners_at_m) - 1)]
        point, _ = loop.at(at_m)
        corners = [point]
        bearing = np.arctan2(point[1], point[0])
        stretch_m = (0.5 * terrain.size_m - _BORDER_M - np.abs(point).max()) / _STRETCHES
        for _ in range(_STRETCHES):
            bearing += _BEND_RAD * rng.uniform(-1.0, 1.0)
            corners.append(corners[-1] + stretch_m * np.array([np.cos(bearing), np.sin(bearing)]))
        spur = Line(corners)
        if passable(*spur.points_m(_CHECK_M).T).all():
            return spur
    return None
