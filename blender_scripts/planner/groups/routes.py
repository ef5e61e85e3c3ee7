"""Generate loops to walk on around a point, off water and steep ground, for configs that do not give their corners."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..faults import ConfigError
from ..geometry.splines import Loop
from ..land.terrain import Terrain, slope_deg
from ..land.ways import SLOPE_STEP_M, plan_loop

ROAD = "road"  # reserved name of the road's loop
_SHORE_M = 8.0
_STEEPEST_DEG = 22.0  # estimate: slopes that herds and people avoid on long walks
_BORDER_M = 20.0


def plan_loops(paths: Mapping[str, dict], terrain: Terrain, seed: int) -> dict[str, Loop]:
    """The loops of `scene.paths` by name: those given by their corners, those generated, and the road's."""
    road = {ROAD: terrain.road.loop} if terrain.road is not None else {}
    return road | {
        name: Loop(path["points_m"]) if "points_m" in path else _drawn(name, path, terrain, seed)
        for name, path in paths.items()
    }


def _drawn(name: str, path: dict, terrain: Terrain, seed: int) -> Loop:
    """A generated loop: off water, and off steep ground if possible."""

    def dry(x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
        inside = np.maximum(np.abs(x_m), np.abs(y_m)) < 0.5 * terrain.size_m - _BORDER_M
        return inside & (terrain.shore_m(x_m, y_m) > _SHORE_M)

    def gentle(x_m: np.ndarray, y_m: np.ndarray) -> np.ndarray:
        return dry(x_m, y_m) & (slope_deg(terrain, x_m, y_m, SLOPE_STEP_M) < _STEEPEST_DEG)

    for passable in (gentle, dry):
        loop = plan_loop(path["centre_m"], path["radius_m"], path["wander"], passable, seed, name)
        if loop is not None:
            return loop
    raise ConfigError(
        f'scene.paths.{name} = {path["radius_m"]:g} m about {path["centre_m"]} m; expected space for a loop there,'
        " within the place and off water"
    )
