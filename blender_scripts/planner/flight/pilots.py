"""The flights of a config's clips; those cut from one flight share its trajectory."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from ..camera import Intrinsics, camera_of
from ..groups.actors import Actor
from ..land.terrain import Terrain
from .autopilot import Surroundings, plan_trajectory
from .flight_checks import check_height
from .poses import Flight, Trajectory, flight_of

_KEPT = 16  # trajectories: enough for the flights of most configs, and few enough for configs with thousands


def frames_of(entry: dict) -> int:
    """Number of frames of a clip or flight of a config."""
    if "frames" in entry:
        return entry["frames"]
    return int(np.floor(entry["duration_s"] * entry["frame_rate_hz"] + 1e-9))


class Pilot:
    """Computes a config's clips and flights; it keeps the trajectories of the latest few flights."""

    def __init__(self, config: dict, terrain: Terrain, actors: Sequence[Actor], intrinsics: Intrinsics):
        self._terrain, self._actors = terrain, actors
        self._intrinsics, self._seed = intrinsics, config["seed"]
        self._until_s: dict[str, float] = {}
        self._where: dict[str, str] = {}
        self._entries: dict[str, dict] = {}
        self._trajectory = lru_cache(_KEPT)(self._planned)
        for kind in ("clips", "flights"):
            for k, entry in enumerate(config[kind]):
                name = _name(entry)
                self._where.setdefault(name, f"{kind}[{k}]")
                self._entries.setdefault(name, entry)
                self._until_s[name] = max(self._until_s.get(name, 0.0), _times(entry)[-1])

    def flight(self, entry: dict) -> Flight:
        """The frames of one of the clips or flights, or of a clip cut from one; ConfigError if it cannot be flown."""
        name = _name(entry)
        flight = flight_of(self._trajectory(name), _times(entry), self._terrain)
        check_height(self._where[name], flight)
        return flight

    def _planned(self, name: str) -> Trajectory:
        entry = self._entries[name]
        plan = entry["flight"]
        target = plan.get("target")
        actors = [actor for actor in self._actors if target in (actor.name, actor.group)]
        around = Surroundings(self._terrain, actors, camera_of(entry, self._intrinsics), self._seed)
        return plan_trajectory(self._where[name], plan, name, self._until_s[name], around)


def _name(entry: dict) -> str:
    """The name shared by all clips of one flight."""
    return entry.get("of_flight", entry["id"])


def _times(entry: dict) -> np.ndarray:
    return entry["start_s"] + np.arange(frames_of(entry)) / entry["frame_rate_hz"]
