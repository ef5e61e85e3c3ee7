"""Warm beds: the ground on which members of a group lay until some time before scene time 0. Lengths in m."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .. import assets
from ..faults import ConfigError
from ..land.terrain import Terrain
from ..noise import stream
from .actors import Actor

_LYING = (
    0.6,
    1.4,
)  # length and width of the contact with the ground, relative to the standing body: an estimate
_BESIDE = (0.8, 1.6)  # body lengths from a bed to its animal, an estimate
_TRIES = 16


def check_beds(where: str, group: dict) -> None:
    """Raise ConfigError if a group of the config has beds that its species cannot leave."""
    species, beds = group["species"], group.get("beds")
    if beds is None:
        return
    data = assets.load("species", species)
    heat = assets.load("materials", data["material"]).get("body_heat", {"kind": "air"})
    if "lie" not in data.get("postures", {}) or heat["kind"] not in ("coat", "skin"):
        raise ConfigError(
            f"{where}.beds is given; expected none, since the species {species} does not lie and warm the ground"
        )
    if beds["count"] > group["count"]:
        raise ConfigError(
            f"{where}.beds.count = {beds['count']}; expected at most the group's {group['count']} members"
        )


def plan_beds(groups: Sequence[dict], actors: Sequence[Actor], terrain: Terrain, seed: int) -> list[dict]:
    """Entries of `beds` in the baked scene, those of a group's first members.

    A bed is at the position of its animal left_s before time 0 if it walks, and otherwise beside it, on dry ground.
    """
    beds = []
    for group in groups:
        if "beds" in group:
            members = [actor for actor in actors if actor.group == group["name"]]
            for k, actor in enumerate(members[: group["beds"]["count"]]):
                beds.append(_bed(actor, group["beds"], terrain, stream(seed, f'bed/{group["name"]}', k)))
    return beds


def _bed(actor: Actor, beds: dict, terrain: Terrain, rng: np.random.Generator) -> dict:
    place, heading = _place(actor, beds["left_s"], terrain, rng)
    room = actor.room
    half_m = np.multiply(_LYING, (room.half_length_m, room.half_width_m))
    return {
        "place_m": np.round(place, 6).tolist(),
        "heading_rad": round(float(heading), 9),
        "half_m": np.round(half_m, 6).tolist(),
        "left_s": beds["left_s"],
        "lain_s": beds["lain_s"],
    }


def _place(
    actor: Actor, left_s: float, terrain: Terrain, rng: np.random.Generator
) -> tuple[np.ndarray, float]:
    """Position [m] and heading [rad] of a bed."""
    walked_m = actor.schedule.mean_m_s * left_s
    points, headings = actor.path(np.array([actor.start_m - walked_m]))
    if walked_m > 0:
        return points[0], np.arctan2(headings[0, 1], headings[0, 0])
    for _ in range(_TRIES):
        angle = rng.uniform(0.0, 2.0 * np.pi)
        away_m = rng.uniform(*_BESIDE) * 2.0 * actor.room.half_length_m
        place = points[0] + away_m * np.array([np.cos(angle), np.sin(angle)])
        dry = not terrain.waters or float(terrain.shore_m(*place[:, None])[0]) > actor.room.half_length_m
        if dry and np.abs(place).max() < 0.5 * terrain.size_m:
            break
    return place, rng.uniform(-np.pi, np.pi)
