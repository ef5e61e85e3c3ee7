"""Traces of groups on the ground: paths along their loops, and trampled halos where they stay. Lengths in m."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .. import assets
from ..geometry.splines import Loop
from ..land.roads import TRACK_M
from ..land.strands import Halo, Strand
from ..land.trodden import Treads
from .actors import Actor
from .behaviours import behaves
from .routes import ROAD

# Estimates.
_PERSON_HALF_M, _HERD_HALF_M, _WHEEL_HALF_M = 0.2, (0.28, 0.18, 0.23, 0.15), 0.2
_WANDER_M, _MOST_WANDER_M = 2.4, 8.0  # of one path, and of the strands of a wide herd
_GRAZED = 0.6  # share of a strand of animals that graze along their way
_LEADS = 3  # points of a loop from which trails lead to the water
_STAND_SHARE, _GROUP_SHARE = 0.8, 0.45  # of bare ground around each stationary member, and around the group
_MOST_GROUP_M = 30.0


def plan_treads(groups: Sequence[dict], loops: Mapping[str, Loop], actors: Sequence[Actor]) -> Treads:
    """The treads of the groups of a config, whose members are among `actors`."""
    strands: dict[str, Strand] = {}
    for group in groups:
        if group.get("path", ROAD) != ROAD:
            found = _strands(group, loops[group["path"]])
            strands |= {strand.name: _wider(strand, strands.get(strand.name)) for strand in found}
    return Treads(list(strands.values()), _halos(groups, actors), _sources(groups, loops))


def _strands(group: dict, loop: Loop) -> list[Strand]:
    """One path of people, several strands of animals, or two of wheels, along a loop."""
    category, name, spread_m = _category(group), f'tread/{group["path"]}', group.get("spread_m", 0.0)
    if category == "vehicle":
        return [
            Strand(loop, f"{name}/wheels/{side}", [_WHEEL_HALF_M] * 2, [0.9] * 2, 0.1, 60.0, side * TRACK_M)
            for side in (-1, 1)
        ]
    if category == "human":
        return [Strand(loop, f"{name}/people", [_PERSON_HALF_M] * 2, [1.0] * 2, _WANDER_M, 34.0, frays=0.4)]
    count = min(len(_HERD_HALF_M), 2 + int(spread_m / 4.0), 1 + group["count"])
    wander_m = min(_MOST_WANDER_M, _WANDER_M + 0.6 * spread_m)
    share = _GRAZED if behaves(group, "graze") else 1.0
    return [
        Strand(loop, f"{name}/herd/{k}", [half_m] * 2, [share] * 2, wander_m, 30.0 + 11.0 * k)
        for k, half_m in enumerate(_HERD_HALF_M[:count])
    ]


def _wider(strand: Strand, other: Strand | None) -> Strand:
    """The wider strand of two groups with the same strand."""
    return other if other is not None and other.wander_m > strand.wander_m else strand


def _sources(groups: Sequence[dict], loops: Mapping[str, Loop]) -> list[np.ndarray]:
    walked = dict.fromkeys(
        group["path"] for group in groups if group.get("path", ROAD) != ROAD and _category(group) != "vehicle"
    )
    return [
        loops[path].at(loops[path].length_m * (k + 0.37) / _LEADS)[0]
        for path in walked
        for k in range(_LEADS)
    ]


def _halos(groups: Sequence[dict], actors: Sequence[Actor]) -> list[Halo]:
    """Halos of the groups that stay on land: around each member, and around all of them."""
    halos = []
    for group in groups:
        if "place" not in group or behaves(group, "float") or _category(group) == "vehicle":
            continue
        members = [actor for actor in actors if actor.group == group["name"]]
        at_m = [actor.path(np.zeros(1))[0][0] for actor in members]
        halos += [_stand(actor, place_m) for actor, place_m in zip(members, at_m)]
        middle_m = np.mean(at_m, axis=0)
        off_m = np.sqrt(((at_m - middle_m) ** 2).sum(axis=1)).max()
        reach_m = min(_MOST_GROUP_M, 3.0 + 1.3 * float(off_m))
        halos.append(Halo(middle_m, 0.2 * reach_m, reach_m, _GROUP_SHARE))
    return halos


def _stand(actor: Actor, place_m: np.ndarray) -> Halo:
    half_m = actor.room.half_length_m
    return Halo(place_m, 0.5 * half_m, 1.5 + 1.6 * half_m, _STAND_SHARE)


def _category(group: dict) -> str:
    return assets.load("species", group["species"])["category"]
