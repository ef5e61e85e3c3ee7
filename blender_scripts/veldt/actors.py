"""Who walks where: members of groups on loops, as pure functions of time."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import assets, ids
from .bodies import Body, build_body
from .noise import stream
from .splines import Loop
from .terrain import Terrain


@dataclass(frozen=True)
class Actor:
    """One animal or person: scale is relative to its species' drawn body, lateral_m to the left of the loop."""

    name: str
    group: str
    species: str
    index: int
    loop: Loop
    start_m: float
    lateral_m: float
    speed_m_s: float
    scale: float

    @property
    def body(self) -> Body:
        """Its body at the drawn size."""
        return build_body(self.species)

    @cached_property
    def bounds_m(self) -> np.ndarray:
        """Box (2, 3) of its body in actor axes at its own size, over a whole stride."""
        return self.scale * self.body.bounds_m()


@dataclass(frozen=True)
class Track:
    """An actor at n moments: position_m (n, 3) on the ground, heading (n, 2) unit vectors, strides (n,) walked."""

    position_m: np.ndarray
    heading: np.ndarray
    strides: np.ndarray

    @property
    def heading_rad(self) -> np.ndarray:
        """Counter-clockwise from +x, within [-pi, pi]."""
        return np.arctan2(self.heading[:, 1], self.heading[:, 0])


def plan_actors(groups: list[dict], loops: dict[str, Loop], seed: int) -> list[Actor]:
    """All members of all groups in the config's order, each with its object index."""
    index = ids.plan_indices([name for group in groups for name in member_names(group)])
    return [
        _member(group, k, name, loops, index[name], seed)
        for group in groups
        for k, name in enumerate(member_names(group))
    ]


def member_names(group: dict) -> list[str]:
    """NAME_1, NAME_2, …"""
    return [f'{group["name"]}_{k + 1}' for k in range(group["count"])]


def track(actor: Actor, terrain: Terrain, time_s: np.ndarray) -> Track:
    """Where the actor is at each time (n,): it walks its loop at its speed for ever, feet on the ground."""
    walked_m = actor.start_m + actor.speed_m_s * np.asarray(time_s, float)
    point, heading = actor.loop.at(walked_m)
    left = np.stack([-heading[:, 1], heading[:, 0]], axis=1)
    xy = point + actor.lateral_m * left
    position = np.column_stack([xy, terrain.height_m(xy[:, 0], xy[:, 1])])
    return Track(position, heading, walked_m / (actor.scale * actor.body.stride_m))


def _member(group: dict, k: int, name: str, loops: dict[str, Loop], index: int, seed: int) -> Actor:
    species = assets.load("species", group["species"])
    rng = stream(seed, f'actor/{group["name"]}', k)
    return Actor(
        name=name,
        group=group["name"],
        species=group["species"],
        index=index,
        loop=loops[group["path"]],
        start_m=group["start_m"] - k * group["spacing_m"],
        lateral_m=group["spread_m"] * rng.uniform(-1.0, 1.0),
        speed_m_s=group.get("speed_m_s", species["speed_m_s"]),
        scale=rng.uniform(*species["size_range"]),
    )
