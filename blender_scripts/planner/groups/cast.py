"""Place the groups of a config on paths or at positions, as actors."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .. import ids
from ..faults import ConfigError
from ..geometry.splines import Loop, Spot
from ..land.corridors import Corridor, Corridors
from .actors import Actor
from .behaviours import Draft, draft_members, member_names, spacing_of
from .collision_discs import TIMES_S, Crowd, cover, gather
from .formations import form, half_breadth_m, march, settle
from .herds import plan_places
from .meetings import choose_start
from .placement import find_spots, fitting
from .site_rules import Land, venue

_CORRIDOR_STEP_M = 0.8
_NEAR_M = 10.0  # from its position: how far a formation may move to find space
_TIGHTEST = (
    0.3  # least fraction of a distance along the path that remains on the inside of a curve; loops are wider
)


@dataclass(frozen=True)
class Cast:
    """All actors, in the order of the config's groups, and the ground reserved for them."""

    actors: list[Actor]
    corridors: list[Corridor]


@dataclass(frozen=True)
class _Group:
    """A group of the config, at `where`, whose members have no position yet."""

    where: str
    entry: dict
    drafts: list[Draft]

    @property
    def name(self) -> str:
        return self.entry["name"]

    @property
    def is_walking(self) -> bool:
        return "path" in self.entry


def plan_cast(groups: Sequence[dict], land: Land, seed: int) -> Cast:
    """All members of all groups, each with its object index.

    Stationary groups keep off the paths and off each other. Groups on paths then get their starting points, unless the
    config gives them: first those without `meets`, so that the others can meet them.
    """
    index = ids.plan_indices([name for entry in groups for name in member_names(entry)])
    drawn = [
        _Group(f"scene.groups[{k}]", entry, draft_members(entry, seed)) for k, entry in enumerate(groups)
    ]
    corridors = [_path_corridor(group, land) for group in drawn if group.is_walking]
    walked = Corridors(corridors)
    crowds: dict[str, Crowd] = {}
    placed: dict[str, Actor] = {}
    for group in sorted(drawn, key=_turn):
        if group.is_walking:
            actors = _on_path(group, land, crowds, index, seed)
        else:
            actors = _at_place(group, land, walked, crowds, index, seed)
        crowds[group.name] = _crowd(actors)
        placed |= {actor.name: actor for actor in actors}
    still = [
        _spot_corridor(placed[name])
        for group in drawn
        if not group.is_walking
        for name in member_names(group.entry)
    ]
    return Cast([placed[name] for name in index], corridors + still)


def _turn(group: _Group) -> int:
    """The order in which a group is placed: the most constrained groups come first."""
    if not group.is_walking:
        return 1
    return 0 if "start_m" in group.entry else 3 if "meets" in group.entry else 2


def _on_path(
    group: _Group, land: Land, crowds: Mapping[str, Crowd], index: Mapping[str, int], seed: int
) -> list[Actor]:
    """The members along their path, each at its position in the group."""
    entry, loop = group.entry, land.loops[group.entry["path"]]
    rooms = [draft.room for draft in group.drafts]
    spread_m = entry.get("spread_m", 0.0)
    spacing_m = spacing_of(entry)
    if "formation" in entry:
        places = march(entry["formation"], len(rooms), spacing_m, loop.length_m, seed, group.name)
    else:
        shrink = _shrink(loop, spread_m)
        places = plan_places(rooms, spacing_m, spread_m, loop.length_m, seed, group.name, shrink)
    if len(places) < len(rooms):
        raise ConfigError(
            f"{group.where}.count = {len(rooms)}; expected at most {len(places)}: no more fit on path"
            f' "{entry["path"]}", which is {loop.length_m:.0f} m long'
        )

    def begun_at(start_m: float) -> list[Actor]:
        return [
            _actor(group, draft, land, index, loop, start_m + place.along_m, place.lateral_m)
            for draft, place in zip(group.drafts, places)
        ]

    if "start_m" in entry:
        return begun_at(entry["start_m"])
    met = entry.get("meets")
    start_m = choose_start(
        loop.length_m,
        lambda start_m: _crowd(begun_at(start_m)),
        list(crowds.values()),
        [crowds[met]] if met else [],
        entry["meets_within_m"],
        seed,
        group.name,
    )
    if start_m is None:
        raise ConfigError(
            f'{group.where}.meets = "{met}"; expected a group that path "{entry["path"]}" can bring {group.name} within'
            f' {entry["meets_within_m"]:g} m of in ten minutes'
        )
    return begun_at(start_m)


def _at_place(
    group: _Group,
    land: Land,
    walked: Corridors,
    crowds: Mapping[str, Crowd],
    index: Mapping[str, int],
    seed: int,
) -> list[Actor]:
    """The members at spots of the group's area."""
    rooms = [draft.room for draft in group.drafts]
    draw, allowed = venue(group.where, group.entry, group.drafts, land, walked, seed)
    standing = list(crowds.values())
    if "formation" in group.entry:
        found = _in_formation(group, fitting(rooms, allowed, standing), seed)
    else:
        found = find_spots(rooms, draw, allowed, standing, seed, group.name)
    if len(found) < len(rooms):
        raise ConfigError(
            f"{group.where}.count = {len(rooms)}; expected at most {len(found)}: there is no space for more"
            f' at place = {group.entry["place"]}, off paths and other groups'
        )
    return [_actor(group, draft, land, index, spot, 0.0, 0.0) for draft, spot in zip(group.drafts, found)]


def _in_formation(group: _Group, fits: Callable[[Spot], bool], seed: int) -> list[Spot]:
    """The spots of a group that stays together; ConfigError if there is no space for it near its position."""
    entry, rooms = group.entry, [draft.room for draft in group.drafts]
    stands = form(entry["formation"], rooms, spacing_of(entry), entry.get("spread_m"), seed, group.name)
    found = settle(stands, entry["place"], fits, _NEAR_M, seed, group.name)
    if not found:
        raise ConfigError(
            f'{group.where}.formation = "{entry["formation"]}"; expected space for {len(rooms)} members within'
            f' {_NEAR_M:g} m of place = {entry["place"]}, off paths and other groups'
        )
    return found


def _actor(
    group: _Group, draft: Draft, land: Land, index: Mapping[str, int], route, start_m: float, lateral_m: float
) -> Actor:
    return Actor(
        **vars(draft),
        group=group.name,
        index=index[draft.name],
        route=route,
        start_m=start_m,
        lateral_m=lateral_m,
        terrain=land.terrain,
    )


def _crowd(actors: Sequence[Actor]) -> Crowd:
    """The discs of a group's members over time."""
    moves = any(actor.schedule.mean_m_s > 0 for actor in actors)
    time_s = TIMES_S if moves else TIMES_S[:1]
    bodies = []
    for actor in actors:
        room = actor.room
        place = actor.path(actor.start_m + actor.schedule.at(time_s).walked_m)
        bodies.append((cover(room.half_length_m, room.half_width_m), *place))
    return gather(bodies)


def _path_corridor(group: _Group, land: Land) -> Corridor:
    loop = land.loops[group.entry["path"]]
    widest_m = max(draft.room.half_width_m for draft in group.drafts)
    return Corridor(loop.points_m(_CORRIDOR_STEP_M), _half_breadth_m(group.entry) + widest_m)


def _half_breadth_m(entry: dict) -> float:
    """The largest distance of a group's members from their path."""
    if "formation" in entry:
        return half_breadth_m(entry["formation"], entry["count"], spacing_of(entry))
    return entry.get("spread_m", 0.0)


def _spot_corridor(actor: Actor) -> Corridor:
    room = actor.room
    return Corridor(actor.path(np.zeros(1))[0], float(np.hypot(room.half_length_m, room.half_width_m)))


def _shrink(loop: Loop, spread_m: float) -> float:
    """The fraction of a distance along a loop that remains spread_m inside its tightest curve."""
    heading = loop.at(np.arange(0.0, loop.length_m, 1.0))[1]
    turn = np.abs(np.arctan2(*_sin_cos(heading, np.roll(heading, -1, axis=0))))[:-1]
    return float(np.clip(1.0 - spread_m * turn.max(initial=0.0), _TIGHTEST, 1.0))


def _sin_cos(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1)
