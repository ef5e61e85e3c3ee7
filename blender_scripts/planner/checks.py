"""Checks beyond the schema: configs whose values are valid one by one but contradict each other."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from . import assets
from .faults import ConfigError, check_known
from .flight.flight_checks import check_entry
from .geometry.splines import Loop, self_crossing
from .groups.behaviours import member_names
from .groups.routes import ROAD
from .plants.placement import by_area

_MOST_CELLS = 4000  # per side: 32 million triangles, some 10 GB in Blender
_MOST_PLANTS = 2_000_000  # of a species
_LEAST_LOOP_M = 1.0
_LOOP_STEP_M = 1.0


def check_names(config: dict) -> None:
    """Check that everything named exists and that names are unique where they must be."""
    groups = config["scene"]["groups"]
    _check_unique([group["name"] for group in groups], "scene.groups[{}].name", "a name no other group has")
    targets = _targets(groups)
    for kind in ("clips", "flights"):
        for k, entry in enumerate(config[kind]):
            check_entry(f"{kind}[{k}]", entry, targets)


def check_size(scene: dict) -> None:
    """Check that the scene fits in memory."""
    size_m, cell_m = scene["terrain"]["size_m"], scene["terrain"]["cell_m"]
    if size_m > _MOST_CELLS * cell_m:
        raise ConfigError(
            f"scene.terrain.cell_m = {cell_m:g} m; expected at least {size_m / _MOST_CELLS:g} m"
            f" for size_m = {size_m:g} m"
        )


def check_plants(scene: dict) -> None:
    """Check that every species exists, grows somewhere, and fits in memory."""
    size_m = scene["terrain"]["size_m"]
    most_per_ha = _MOST_PLANTS / (size_m**2 / 1e4)
    for name, wanted in scene["plants"].items():
        check_known(name, assets.names("plants"), "scene.plants", "a plant")
        where = f"scene.plants.{name}.per_ha"
        per_ha = max(by_area(wanted["per_ha"]))
        if per_ha <= 0:
            raise ConfigError(f"{where} = {wanted['per_ha']} per ha; expected more than 0 per ha somewhere")
        if per_ha > most_per_ha:
            raise ConfigError(
                f"{where} = {per_ha:g} per ha; expected at most {most_per_ha:g} per ha for size_m = {size_m:g} m"
            )


def check_paths(scene: dict) -> None:
    """Check that every path is either given by its corners or drawn around a centre."""
    for name, path in scene["paths"].items():
        where = f"scene.paths.{name}"
        if ("points_m" in path) == ("centre_m" in path):
            found = "both are given" if "points_m" in path else "neither is given"
            raise ConfigError(f"{where}: {found}; expected points_m, or centre_m and radius_m")
        if "centre_m" in path and "radius_m" not in path:
            raise ConfigError(
                f"{where}.radius_m is missing; expected the mean distance of the loop from centre_m"
            )
        if name == ROAD:
            raise ConfigError(f'{where}; expected another name: "{ROAD}" is the road of scene.terrain')


def check_road(terrain: dict, is_wet: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> None:
    """Check that a road given by its corners is a loop on dry ground that does not cross itself."""
    if terrain["road"]["width_m"] <= 0 or "points_m" not in terrain["road"]:
        return
    where, loop = "scene.terrain.road.points_m", Loop(terrain["road"]["points_m"])
    _check_loop(where, loop, 0.0, 0.5 * terrain["size_m"])
    points = loop.points_m(_LOOP_STEP_M)
    wet = np.flatnonzero(is_wet(*points.T))
    if len(wet) > 0:
        x_m, y_m = points[wet[0]]
        raise ConfigError(
            f"{where}: the loop is in water at x = {x_m:.1f} m, y = {y_m:.1f} m; expected dry ground"
        )


def check_loops(scene: dict, loops: Mapping[str, Loop]) -> None:
    """Check that loops have a length, do not cross themselves, and keep their walkers on the terrain."""
    for name, loop in loops.items():
        spread_m = max(
            (g.get("spread_m", 0.0) for g in scene["groups"] if g.get("path") == name), default=0.0
        )
        _check_loop(f"scene.paths.{name}", loop, spread_m, 0.5 * scene["terrain"]["size_m"])


def _targets(groups: list[dict]) -> dict[str, None]:
    """Names that a flight can follow: groups and members of groups, all unique."""
    members = dict.fromkeys(name for group in groups for name in member_names(group))
    for k, group in enumerate(groups):
        if group["name"] in members:
            raise ConfigError(
                f'scene.groups[{k}].name = "{group["name"]}"; expected a name no member of a group has'
            )
    return members | dict.fromkeys(group["name"] for group in groups)


def _check_unique(names: list[str], where: str, rule: str) -> None:
    seen = set()
    for k, name in enumerate(names):
        if name in seen:
            raise ConfigError(f'{where.format(k)} = "{name}"; expected {rule}')
        seen.add(name)


def _check_loop(where: str, loop: Loop, spread_m: float, half_m: float) -> None:
    """Check that the loop has a length, keeps all walkers on the terrain's square, and does not cross itself."""
    if loop.length_m < _LEAST_LOOP_M:
        raise ConfigError(f"{where} = {loop.length_m:.1f} m long; expected at least {_LEAST_LOOP_M:.0f} m")
    _check_inside(where, loop, spread_m, half_m)
    crossing_m = self_crossing(loop.points_m(_LOOP_STEP_M))
    if crossing_m is not None:
        x_m, y_m = crossing_m
        raise ConfigError(
            f"{where}: the loop crosses itself at x = {x_m:.1f} m, y = {y_m:.1f} m; expected a loop that does not"
        )


def _check_inside(where: str, loop: Loop, spread_m: float, half_m: float) -> None:
    """Check that the loop, widened by the walkers' spread, is within the terrain's square."""
    points, _ = loop.at(np.arange(0.0, loop.length_m, _LOOP_STEP_M))
    reach = np.abs(points).max(axis=1) + spread_m
    farthest = int(np.argmax(reach))
    if reach[farthest] > half_m:
        x_m, y_m = points[farthest]
        beside = f" (and walkers {spread_m:g} m beside it)" if spread_m > 0 else ""
        raise ConfigError(
            f"{where}: the loop reaches x = {x_m:.1f} m, y = {y_m:.1f} m{beside};"
            f" expected within {half_m:g} m of the middle in x and y"
        )
