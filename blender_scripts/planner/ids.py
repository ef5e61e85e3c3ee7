"""Object and material indices of the index planes.

Object index 0 is sky. Ground, water and every plant species have one index each. Every actor has its own, which is the
same in all clips of a dataset and serves as the actor's track id.
"""

from __future__ import annotations

from collections.abc import Sequence

from .faults import ConfigError

GROUND, WATER, FIRST_PLANT, FIRST_ACTOR = 1, 2, 3, 101
LAST = 32767  # Blender clamps a larger pass_index silently


def plan_indices(actor_names: Sequence[str]) -> dict[str, int]:
    """Index of each actor, counted up from FIRST_ACTOR in the order given; ConfigError past LAST."""
    most = LAST - FIRST_ACTOR + 1
    if len(actor_names) > most:
        raise ConfigError(
            f"scene.groups = {len(actor_names)} actors; expected at most {most}, one object index each"
        )
    return {name: FIRST_ACTOR + k for k, name in enumerate(actor_names)}


def plan_plant_indices(plant_names: Sequence[str]) -> dict[str, int]:
    """Index of each plant species, counted up from FIRST_PLANT in the order given; ConfigError past FIRST_ACTOR."""
    most = FIRST_ACTOR - FIRST_PLANT
    if len(plant_names) > most:
        raise ConfigError(
            f"scene.plants = {len(plant_names)} species; expected at most {most}, one object index each"
        )
    return {name: FIRST_PLANT + k for k, name in enumerate(plant_names)}


def plan_fire_indices(plants: int, fires: int) -> list[int]:
    """Indices of the fires, after those of all plant species; ConfigError past FIRST_ACTOR."""
    first = FIRST_PLANT + plants
    if first + fires > FIRST_ACTOR:
        raise ConfigError(
            f"scene.fires = {fires} fires; expected at most {FIRST_ACTOR - first} beside {plants} species of plants,"
            " one object index each"
        )
    return list(range(first, first + fires))


def plan_material_indices(pairs: Sequence[tuple[str, str]]) -> dict[tuple[str, str], int]:
    """Index of each (material, part), with an empty part for surfaces without parts, from 1 in order of first use."""
    return {pair: 1 + k for k, pair in enumerate(dict.fromkeys(pairs))}
