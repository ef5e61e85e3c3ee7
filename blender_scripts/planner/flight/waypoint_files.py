"""Flights from files: missions of QGroundControl, and logs."""

from __future__ import annotations

from pathlib import Path

from ..faults import ConfigError
from .logs import Log, read_log
from .qgc_plans import read_plan
from .waypoints import SurfaceAt, Waypoint


def read_waypoints(file: str, home_m, ground_m: SurfaceAt, where: str) -> list[Waypoint] | Log:
    """The content of a .plan (`qgc_plans.read_plan`) or a .csv (`logs.read_log`), with its home at home_m [x, y].

    ConfigError if it cannot be read, naming the file; `where` is its key in the config.
    """
    suffix = Path(file).suffix.lower()
    if suffix == ".plan":
        return read_plan(file, home_m, ground_m, f"{where}.file")
    if suffix == ".csv":
        return read_log(file, home_m, f"{where}.file")
    raise ConfigError(f"{where}.file = {file}; expected a .plan of QGroundControl or a log as .csv")
