"""Culverts and small bridges where the road crosses a gully on a bank. Lengths in m."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .. import assets
from ..geometry.rotations import heading_of
from ..land.corridors import Corridors
from ..land.roads import Road
from ..land.terrain import Terrain
from .layout import Standing

_APART_M = 40.0  # between crossings
_BUILT_FOR_M = 3.8  # width of the road that the walls of the assets are for
_WALL_STEP_M = 0.5
# Least height of the bank for each; estimates. In lower gullies the road is a ford.
_KINDS = (("bridge", 1.0), ("culvert", 0.4))


def plan_crossings(terrain: Terrain, corridors: Corridors) -> list[Standing]:
    """A pair of walls at each high bank of the road; of nearby banks, at the highest.

    Where a corridor meets a wall, there is none.
    """
    road, found = terrain.road, []
    if road is None:
        return found
    for _, thing in sorted(_candidates(terrain, road), key=lambda each: -each[0]):
        apart_m = [np.linalg.norm(thing.point_m - other.point_m) for other in found]
        if min(apart_m, default=np.inf) >= _APART_M and _is_clear(thing, road.width_m, corridors):
            found.append(thing)
    return found


def _candidates(terrain: Terrain, road: Road) -> Iterator[tuple[float, Standing]]:
    """The bank's height and its crossing, for all points of the road where it is high enough."""
    land = terrain.with_road(None)
    for points_m, bed_m in zip(road.points_m, road.bed_m):
        ahead_m = np.gradient(points_m, axis=0)
        for k, height_m in enumerate(bed_m - land.height_m(*points_m.T)):
            name = next((kind for kind, least_m in _KINDS if height_m >= least_m), None)
            if name is not None:
                yaw_rad = float(np.arctan2(ahead_m[k, 1], ahead_m[k, 0]))
                yield float(height_m), Standing(name, points_m[k], yaw_rad, road.width_m / _BUILT_FOR_M)


def _is_clear(thing: Standing, width_m: float, corridors: Corridors) -> bool:
    """Whether walls are clear of corridors."""
    clear_m = assets.standing(thing.name)["clearance_m"]
    along_m = np.arange(-thing.foot_m, thing.foot_m + _WALL_STEP_M, _WALL_STEP_M)[:, None]
    ahead, left = heading_of(thing.yaw_rad), heading_of(thing.yaw_rad + 0.5 * np.pi)
    middle_m = thing.point_m + along_m * ahead
    walls_m = np.concatenate([middle_m + side * 0.5 * width_m * left for side in (-1.0, 1.0)])
    return corridors.is_clear(walls_m, clear_m)
