"""Members of a group before they have a position: bodies, sizes and schedules."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import assets
from ..anatomy.bodies import Body, build_body, draw_variant, drawn
from ..noise import stream
from .formations import SPACING_M
from .herds import Room
from .schedules import Drinking, Schedule, Steady, StopAndGo

# The posture that each behaviour needs besides standing and walking.
POSTURES = {
    "walk": "walk",
    "stand": "walk",
    "graze": "graze",
    "drink": "graze",
    "lie": "lie",
    "float": "float",
    "sit": "sit",
    "crouch": "crouch",
    "bend": "bend",
}
WALKING = ("walk", "graze")
_SPACING_M = 4.0  # along a path, by default
_OF_WALKERS = (
    "walk",
    "graze",
    "drink",
)  # behaviours of a body that stands as it walks; a grazer lowers its head


@dataclass(frozen=True)
class Draft:
    """A member without a position: scale relative to its drawn body; phase, 0 to 1, of all periodic motion."""

    name: str
    species: str
    variant: str
    scale: float
    phase: float
    walking_m_s: float
    schedule: Schedule
    posture: str

    @property
    def body(self) -> Body:
        """The member's body at its drawn size."""
        return build_body(self.species, self.variant, self.posture)

    @property
    def room(self) -> Room:
        """The footprint of the standing body, or of one that rests on the ground."""
        rests_m = self.body.postures[self.posture].rests_m
        half_m = self.scale * (self.body.reach_m if rests_m is None else np.array(rests_m))
        return Room(float(half_m[0]), float(half_m[1]), self.schedule.reach_m)


def behaviours_of(group: dict) -> dict[str, float]:
    """The behaviours of a group of the config, with shares of its members; by default, groups on paths walk and others
    stand."""
    return group.get("behaviours") or {group.get("behaviour", "walk" if "path" in group else "stand"): 1.0}


def behaves(group: dict, *behaviours: str) -> bool:
    """Whether members of a group have one of these behaviours."""
    return any(behaviour in behaviours for behaviour in behaviours_of(group))


def _behaviour(group: dict, k: int, seed: int) -> str:
    """The behaviour of a group's k-th member."""
    shares = behaviours_of(group)
    return (
        drawn(shares, stream(seed, f'behaviour/{group["name"]}', k))
        if len(shares) > 1
        else next(iter(shares))
    )


def _posture(species: str, behaviour: str, seed: int, name: str, k: int) -> str:
    """One of the species' postures for a behaviour: named like it, or beginning with its name and `_`."""
    if behaviour in _OF_WALKERS:
        return "walk"
    known = assets.load("species", species).get("postures", {})
    able = [posture for posture in known if f"{posture}_".startswith(f"{behaviour}_")]
    return drawn(dict.fromkeys(able, 1.0), stream(seed, f"posture/{name}", k)) if able else "walk"


def spacing_of(group: dict) -> float:
    """The distance between members of a group of the config."""
    return group.get("spacing_m", SPACING_M if "formation" in group else _SPACING_M)


def member_names(group: dict) -> list[str]:
    """NAME_1, NAME_2, …"""
    return [f'{group["name"]}_{k + 1}' for k in range(group["count"])]


def draft_members(group: dict, seed: int) -> list[Draft]:
    """The members of a group of the config."""
    return [_draft(group, k, name, seed) for k, name in enumerate(member_names(group))]


def _draft(group: dict, k: int, name: str, seed: int) -> Draft:
    data = assets.load("species", group["species"])
    given, behaviour = group.get("variants"), _behaviour(group, k, seed)
    variant = (
        given[k % len(given)] if given else draw_variant(group["species"], seed, group["name"], k, behaviour)
    )
    rng = stream(seed, f'actor/{group["name"]}', k)
    scale, phase = rng.uniform(*data["variants"][variant]["size_range"]), rng.uniform()
    speed_m_s = group.get("speed_m_s", data["speed_m_s"])
    return Draft(
        name=name,
        species=group["species"],
        variant=variant,
        scale=scale,
        phase=phase,
        walking_m_s=speed_m_s,
        schedule=_schedule(group, k, behaviour, speed_m_s, phase, seed),
        posture=_posture(group["species"], behaviour, seed, group["name"], k),
    )


def _schedule(group: dict, k: int, behaviour: str, speed_m_s: float, phase: float, seed: int) -> Schedule:
    if behaviour == "graze":
        return StopAndGo(seed, group["name"], k, speed_m_s)
    if behaviour == "drink":
        return Drinking(phase)
    return Steady(speed_m_s if behaviour == "walk" else 0.0)
