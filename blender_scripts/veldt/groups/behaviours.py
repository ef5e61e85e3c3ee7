"""Members of a group before they have a position: bodies, sizes and schedules."""

from __future__ import annotations

from dataclasses import dataclass

from .. import assets
from ..anatomy.bodies import Body, build_body, draw_variant
from ..noise import stream
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
}
WALKING = ("walk", "graze")


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
        return build_body(self.species, self.variant)

    @property
    def room(self) -> Room:
        """The footprint of the standing body."""
        half_m = self.scale * self.body.reach_m
        return Room(float(half_m[0]), float(half_m[1]), self.schedule.reach_m)


def behaviour_of(group: dict) -> str:
    """The behaviour of a group of the config; by default, groups on paths walk and others stand."""
    return group.get("behaviour", "walk" if "path" in group else "stand")


def member_names(group: dict) -> list[str]:
    """NAME_1, NAME_2, …"""
    return [f'{group["name"]}_{k + 1}' for k in range(group["count"])]


def draft_members(group: dict, seed: int) -> list[Draft]:
    """The members of a group of the config."""
    return [_draft(group, k, name, seed) for k, name in enumerate(member_names(group))]


def _draft(group: dict, k: int, name: str, seed: int) -> Draft:
    data = assets.load("species", group["species"])
    given = group.get("variants")
    variant = given[k % len(given)] if given else draw_variant(group["species"], seed, group["name"], k)
    rng = stream(seed, f'actor/{group["name"]}', k)
    scale, phase = rng.uniform(*data["variants"][variant]["size_range"]), rng.uniform()
    speed_m_s = group.get("speed_m_s", data["speed_m_s"])
    posture = POSTURES[behaviour_of(group)]
    return Draft(
        name=name,
        species=group["species"],
        variant=variant,
        scale=scale,
        phase=phase,
        walking_m_s=speed_m_s,
        schedule=_schedule(group, k, speed_m_s, phase, seed),
        posture=posture if posture in ("lie", "float") else "walk",
    )


def _schedule(group: dict, k: int, speed_m_s: float, phase: float, seed: int) -> Schedule:
    behaviour = behaviour_of(group)
    if behaviour == "graze":
        return StopAndGo(seed, group["name"], k, speed_m_s)
    if behaviour == "drink":
        return Drinking(phase)
    return Steady(speed_m_s if behaviour == "walk" else 0.0)
