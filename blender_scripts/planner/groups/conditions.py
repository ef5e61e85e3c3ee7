"""Inputs of an actor's temperatures besides its species and the weather: its engine, and its last bath."""

from __future__ import annotations

from .. import assets
from ..faults import ConfigError
from ..noise import stream
from .behaviours import WALKING, behaves

_RUNNING_S = 3600.0  # default running time of an engine: it is warm
_HEAT = "body_heat"  # of materials and their parts


def check_condition(where: str, group: dict) -> None:
    """Raise ConfigError if a group of the config states an engine or a bath that its species cannot have."""
    if "engine" in group:
        _check_engine(where, group)
    if "wet_s" in group and not any(heat.get("wet_when_bathed", 0) > 0 for heat in _heats(group["species"])):
        raise ConfigError(
            f"{where}.wet_s = {group['wet_s']:g} s; expected none, since a bath does not cool a"
            f" {group['species']}: its material has no wet_when_bathed"
        )


def condition(group: dict, member: int, seed: int) -> dict:
    """Keys `engine` and `wet_s` of a member's object in the manifest; without them, the thermal core decides.

    A parked vehicle without a stated time has none. Animals of a species with `wet_s`, which bathes now and then, are
    wet since a time drawn from that range; floating ones since now.
    """
    keys = {}
    engine = group.get("engine", {})
    if engine and (engine["state"] != "parked" or "since_s" in engine):
        keys["engine"] = {"state": engine["state"], "since_s": engine.get("since_s", _RUNNING_S)}
    wet_s = group.get("wet_s", _wet_by_nature_s(group, member, seed))
    if wet_s is not None:
        keys["wet_s"] = wet_s
    return keys


def _wet_by_nature_s(group: dict, member: int, seed: int) -> float | None:
    data = assets.load("species", group["species"])
    if "wet_s" not in data:
        return None
    if behaves(group, "float"):
        return 0.0
    least_s, most_s = data["wet_s"]
    return round(float(stream(seed, f'bath/{group["name"]}', member).uniform(least_s, most_s)), 3)


def _check_engine(where: str, group: dict) -> None:
    state, species = group["engine"]["state"], group["species"]
    if not any(heat["kind"] == "engine" for heat in _heats(species)):
        raise ConfigError(f"{where}.engine is given; expected none, since a {species} has no engine")
    moves = behaves(group, *WALKING)
    if (state == "driving") != moves:
        rule = '"driving", since the group moves' if moves else '"idling" or "parked", since the group stands'
        raise ConfigError(f'{where}.engine.state = "{state}"; expected {rule}')


def _heats(species: str) -> list[dict]:
    """All heat models of a species, of the whole and of parts."""
    material = assets.load("materials", assets.load("species", species)["material"])
    entries = [material, *material.get("parts", {}).values()]
    return [entry[_HEAT] for entry in entries if _HEAT in entry]
