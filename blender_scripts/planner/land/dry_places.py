"""Check that positions in a config lie on dry ground."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..faults import ConfigError
from .terrain import Terrain


def check_dry_place(
    where: str, place_m: Sequence[float], terrain: Terrain, reach_m: float, shore_m: float, note: str = ""
) -> None:
    """Raise ConfigError unless a position is reach_m inside the border and shore_m from water.

    where: its key in the config, such as "scene.fires[0]"; note: explanation of the reach.
    """
    x_m, y_m = (float(value) for value in place_m)
    found = f"{where}.place = [{x_m:g}, {y_m:g}] m; expected"
    within_m = 0.5 * terrain.size_m - reach_m
    if max(abs(x_m), abs(y_m)) > within_m:
        raise ConfigError(f"{found} within {within_m:g} m of the middle in x and y{note}")
    if terrain.waters and float(terrain.shore_m(np.array([x_m]), np.array([y_m]))[0]) < shore_m:
        raise ConfigError(f"{found} dry ground, not water")
