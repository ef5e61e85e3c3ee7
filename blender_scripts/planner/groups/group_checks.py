"""Check groups for unknown names and contradictory settings."""

from __future__ import annotations

from collections.abc import Collection

from .. import assets
from ..anatomy.bodies import variant_names
from ..faults import ConfigError, check_known, listing
from .beds import check_beds
from .behaviours import POSTURES, WALKING, behaviours_of, spacing_of
from .conditions import check_condition
from .formations import LEAST_M, ON_PATHS


def check_groups(groups: list[dict], paths: Collection[str]) -> None:
    """Check that every group has a species, a path or a `place`, and a behaviour of its species; `paths`: known."""
    names = [group["name"] for group in groups]
    for k, group in enumerate(groups):
        where = f"scene.groups[{k}]"
        check_known(group["species"], assets.names("species"), f"{where}.species", "a species")
        for j, variant in enumerate(group.get("variants", [])):
            species = group["species"]
            check_known(variant, variant_names(species), f"{where}.variants[{j}]", f"a variant of {species}")
        _check_where(where, group, paths)
        _check_behaviour(where, group)
        if "formation" in group:
            _check_formation(where, group)
        check_condition(where, group)
        check_beds(where, group)
        if "meets" in group:
            _check_meeting(where, k, groups, names)


def _check_where(where: str, group: dict, paths: Collection[str]) -> None:
    if ("path" in group) == ("place" in group):
        found = "path and place are both given" if "path" in group else "path is missing"
        raise ConfigError(f"{where}: {found}; expected a path to walk on, or a place to stay at")
    if "path" in group:
        check_known(group["path"], paths, f"{where}.path", "a path of scene.paths")


def _check_behaviour(where: str, group: dict) -> None:
    species = group["species"]
    able = [name for name, posture in POSTURES.items() if posture == "walk" or posture in _postures(species)]
    if "behaviours" in group:
        _check_shares(where, group, able)
        return
    (behaviour,) = behaviours_of(group)
    if behaviour not in able:
        raise ConfigError(
            f'{where}.behaviour = "{behaviour}"; expected what a {species} can do: {listing(able)}'
        )
    if "place" in group and behaviour in WALKING:
        staying = [name for name in able if name not in WALKING]
        raise ConfigError(f'{where}.behaviour = "{behaviour}"; expected at a place: {listing(staying)}')
    if "path" in group and behaviour == "float":
        raise ConfigError(f'{where}.behaviour = "float"; expected place = "water" or "pan", not a path')


def _check_shares(where: str, group: dict, able: Collection[str]) -> None:
    """Check shares of behaviours: of a stationary group, for behaviours of its species, and not all 0."""
    if "behaviour" in group:
        raise ConfigError(f"{where}: behaviour and behaviours are both given; expected one of them")
    if "path" in group:
        raise ConfigError(f"{where}.behaviours is given; expected a place: members on a path all do the same")
    for behaviour in group["behaviours"]:
        check_known(behaviour, able, f"{where}.behaviours", f"what a {group['species']} can do")
    if not any(group["behaviours"].values()):
        raise ConfigError(f"{where}.behaviours are all 0; expected one share above 0")


def _check_formation(where: str, group: dict) -> None:
    formation = group["formation"]
    if "path" in group and formation not in ON_PATHS:
        raise ConfigError(f'{where}.formation = "{formation}"; expected on a path: {listing(ON_PATHS)}')
    if isinstance(group.get("place"), str):
        raise ConfigError(f'{where}.place = "{group["place"]}"; expected [x, y] for a formation')
    if spacing_of(group) < LEAST_M:
        raise ConfigError(
            f"{where}.spacing_m = {spacing_of(group):g} m; expected at least {LEAST_M:g} m in a formation"
        )


def _postures(species: str) -> Collection[str]:
    return assets.load("species", species).get("postures", {})


def _check_meeting(where: str, k: int, groups: list[dict], names: list[str]) -> None:
    group, met = groups[k], groups[k]["meets"]
    check_known(met, [name for name in names if name != group["name"]], f"{where}.meets", "another group")
    if "path" not in group:
        raise ConfigError(
            f"{where}.meets is given; expected a path: a group at a place cannot move to meet others"
        )
    if "start_m" in group:
        raise ConfigError(f"{where}.start_m is given; expected none, since meets determines it")
    if "meets" in groups[names.index(met)] and names.index(met) > k:
        raise ConfigError(f'{where}.meets = "{met}"; expected a group listed before it, or one without meets')
