# SPDX-License-Identifier: GPL-3.0-or-later
"""Grouping of objects into targets, and the meaning of each. No bpy: objects need only the attributes used here."""

from __future__ import annotations

from dataclasses import dataclass

LARGEST_INDEX = 32767  # of Blender's pass_index


@dataclass(frozen=True)
class Target:
    """An entity with one object index: an actor, or all background of one kind and material."""

    name: str
    kind: str  # a class of the manifest: actor, plant, ground, water
    material: str
    category: str = ""
    species: str = ""

    @property
    def is_actor(self) -> bool:
        """Whether it is labelled."""
        return self.kind == "actor"


def owner_of(thing, collections_of):
    """The object or collection whose assignment applies to an object; None if it has none.

    The object's own, that of its nearest parent, or that of the nearest collection around any of them.
    `collections_of(object)` are the collections around an object, nearest first.
    """
    line = []
    while thing is not None:
        line.append(thing)
        thing = thing.parent
    around = [collection for each in line for collection in collections_of(each)]
    return next((each for each in [*line, *around] if each.veldt.kind != "unset"), None)


def target_of(owner, rest: str) -> Target:
    """The target of an owner; background of the material `rest` if there is none."""
    if owner is None:
        return Target(f"unassigned_{rest}", "ground", rest)
    said = owner.veldt
    if said.kind != "actor":
        return Target(said.material, said.kind, said.material)
    return Target(said.target or owner.name, "actor", said.material, said.category, said.species)


def copy_of(target: Target, instancer: str, number: tuple[int, ...]) -> Target:
    """The target of one instance of an actor, by the instancer and its instance number."""
    name = "_".join([target.name, instancer, *map(str, number)])
    return Target(name, target.kind, target.material, target.category, target.species)


class Indices:
    """Object indices from 1 and track ids from 1, in the order in which targets are first seen."""

    def __init__(self) -> None:
        self._indices: dict[Target, int] = {}

    def index_of(self, target: Target) -> int:
        """The index of a target; ValueError if there are more than Blender can number."""
        if target not in self._indices and len(self._indices) == LARGEST_INDEX:
            raise ValueError(f"targets = {LARGEST_INDEX + 1}; expected at most {LARGEST_INDEX}")
        return self._indices.setdefault(target, len(self._indices) + 1)

    def objects(self) -> list[dict]:
        """The list `objects` of a manifest."""
        entries, tracks = [], 0
        for target, index in self._indices.items():
            entry = {"index": index, "name": target.name, "class": target.kind, "material": target.material}
            if target.is_actor:
                tracks += 1
                entry |= {"category": target.category, "track_id": tracks}
                entry |= {"species": target.species} if target.species else {}
            entries.append(entry)
        return entries
