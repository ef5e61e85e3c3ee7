"""Predict what a config will show without rendering it, and cut its long flights into clips."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from .cuts import clips_of, cut
from .faults import ConfigError
from .sightings import sightings
from .world import World


@dataclass(frozen=True)
class Outlook:
    """A clip, and for each frame whether an actor's box overlaps the picture, and the height above ground."""

    clip: dict
    seen: np.ndarray
    agl_m: np.ndarray


# How a function is applied to each entry of a config: map, or one that uses more cores. Results keep the order.
Each = Callable[[Callable, list], Iterable]


def plan_dataset(world: World, each: Each = map) -> dict:
    """Frames and heights of each clip, including those cut from flights, and the numbers of actors and plants."""
    outlooks = list(_outlooks(world, each))
    _check_ids([outlook.clip["id"] for outlook in outlooks])
    return {
        "clips": [_described(outlook) for outlook in outlooks],
        "cut_clips": [outlook.clip for outlook in outlooks[len(world.config["clips"]) :]],
        "objects": len(world.actors),
        "plants": sum(len(planting.scale) for planting in world.plantings.values()),
    }


def with_flights_cut(world: World) -> World:
    """The same world with the flights of its config replaced by clips."""
    if not world.config["flights"]:
        return world
    clips = [outlook.clip for outlook in _outlooks(world, map)]
    return replace(world, config={**world.config, "clips": clips, "flights": []})


def _outlooks(world: World, each: Each) -> Iterator[Outlook]:
    """Of the clips, then of those cut from flights."""
    entries = [*world.config["clips"], *world.config["flights"]]
    for outlooks in each(lambda entry: _outlooks_of(world, entry), entries):
        yield from outlooks


def _outlooks_of(world: World, entry: dict) -> list[Outlook]:
    """Of a clip, or of the clips cut from a flight."""
    flight = world.flight(entry)
    seen = sightings(world.intrinsics, flight, world.actors)
    if "keep" not in entry:  # a clip
        return [Outlook(entry, seen, flight.agl_m)]
    stretches = cut(entry, seen, world.config["seed"])
    if not stretches:
        place = world.config["flights"].index(entry)
        raise ConfigError(
            f'flights[{place}].keep = "{entry["keep"]}": no actor comes into the picture; expected one, or "all"'
        )
    parts = [slice(first, first + frames) for first, frames in stretches]
    return [
        Outlook(clip, seen[part], flight.agl_m[part]) for clip, part in zip(clips_of(entry, stretches), parts)
    ]


def _check_ids(ids: list[str]) -> None:
    """Check that the config's own clips, which come first, have other ids than those cut from flights."""
    last = {name: k for k, name in enumerate(ids)}
    for k, name in enumerate(ids):
        if last[name] != k:
            raise ConfigError(f'clips[{k}].id = "{name}"; expected an id that no clip of a flight has')


def _described(outlook: Outlook) -> dict:
    clip = outlook.clip
    return {
        "id": clip["id"],
        "flight": clip.get("of_flight", ""),
        "frames": clip["frames"],
        "duration_s": round(clip["frames"] / clip["frame_rate_hz"], 3),
        "frames_with_actors": int(outlook.seen.sum()),
        "min_agl_m": round(float(outlook.agl_m.min()), 3),
        "max_agl_m": round(float(outlook.agl_m.max()), 3),
    }
