"""Small lands with their covers, and the fine grid on them."""

from __future__ import annotations

from scenes import tiny
from planner.land.covers import Layer, plan_covers
from planner.land.fine_grid import FineGrid
from planner.land.road_plan import plan_road
from planner.land.terrain import Terrain, build_terrain

SIZE_M, SEED = 241, 5
WILD = {"pan_radius_m": 8, "craggy_fraction": 0.1, "road": {"width_m": 3.8, "fork": True}}


def small_land(**changes) -> tuple[Terrain, list[Layer], FineGrid]:
    """A place of 241 m, with changed settings of its terrain."""
    settings = tiny()["scene"]["terrain"] | {"size_m": SIZE_M} | changes
    terrain = build_terrain(settings, SEED)
    terrain = terrain.with_road(plan_road(settings["road"], terrain, SEED))
    return terrain, plan_covers(terrain, settings, SEED), FineGrid(terrain.size_m)
