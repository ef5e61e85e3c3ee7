"""Loops to walk on that a config asks for but does not draw: round about a place, off water and steep ground."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ..faults import ConfigError
from ..noise import stream
from ..plants.placement import slope_deg
from ..geometry.splines import Loop
from ..land.terrain import Terrain

ROAD = "road"  # the name of the road's own loop
CORNERS = 12
_TRIES = 40
_STEP = 0.04  # of the radius, by which a corner on bad ground is moved
_CHECK_M = 4.0  # between the places looked at along a loop

_SHORE_M = 8.0
_STEEPEST_DEG = 22.0  # estimate: what herds and people on long ways avoid
_BORDER_M = 20.0
SLOPE_STEP_M = 8.0  # ways cross gullies, but keep off hillsides

Passable = Callable[[np.ndarray, np.ndarray], np.ndarray]  # x_m, y_m (n,) to (n,) booleans


def plan_loops(paths: Mapping[str, dict], terrain: Terrain, seed: int) -> dict[str, Loop]:
    """The loops of `scene.paths` by name: those given by their corners, those drawn, and the road's."""
    road = {ROAD: terrain.road.loop} if terrain.road is not None else {}
    return road | {
        name: Loop(path["points_m"]) if "points_m" in path else _drawn(name, path, terrain, seed)
        for name, path in paths.items()
    }


def plan_loop(
    centre_m, radius_m: float, wander: float, passable: Passable, seed: int, name: str
) -> Loop | None:
    """A loop about `centre_m` whose corners are radius_m from it, give or take a share `wander` at random.

    Corners are moved out or in, the nearest way, until all of the loop is passable; None if that cannot be had.
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
        # 1, -1, 2, -2, … steps from where it was drawn.
        steps = (tries + 1) // 2 * np.where(tries % 2 == 1, 1.0, -1.0)
        radii_m = np.maximum(drawn_m + _STEP * radius_m * steps, 0.2 * radius_m)
    return None


def _drawn(name: str, path: dict, terrain: Terrain, seed: int) -> Loop:
    """The loop of a path that is to be drawn: off water, and off steep ground if that can be had."""

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
        f'scene.paths.{name} = {path["radius_m"]:g} m about {path["centre_m"]} m; expected room for a loop there,'
        " within the place and off water"
    )


def _bad_corners(loop: Loop, passable: Passable) -> np.ndarray:
    """Which corners (n,) are at an end of a segment that is not passable all along."""
    along_m = np.linspace(0.0, loop.length_m, int(loop.length_m / _CHECK_M) + 2)
    bad_m = along_m[~passable(*loop.at(along_m)[0].T)]
    segment = np.clip(np.searchsorted(loop.corners_at_m, bad_m, "right") - 1, 0, CORNERS - 1)
    bad = np.zeros(CORNERS, bool)
    bad[segment] = bad[(segment + 1) % CORNERS] = True
    return bad
