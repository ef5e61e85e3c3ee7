"""Plan the clips of a config: cut its long flights, and predict the contents of each clip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .cuts import clips_of, cut
from .faults import ConfigError
from .flight.poses import Flight
from .sightings import sightings
from .workers import Cores
from .world import World


@dataclass(frozen=True)
class Outlook:
    """A clip, its flight, and for each frame whether an actor's box overlaps the picture."""

    clip: dict
    flight: Flight
    seen: np.ndarray


def plan_clips(
    world: World,
    cores: Cores = Cores(),
    bake: Callable[[Outlook], None] = lambda outlook: None,
    planned: Callable[[str, int, int], None] = lambda name, done, total: None,
) -> list[dict]:
    """Outlooks of all clips: the config's own, then those cut from its flights.

    `bake` is called with each clip in the process that plans it; `planned` with the id of each clip or flight of the
    config, and the number of planned ones.
    """

    def plan_entry(entry: dict) -> list[dict]:
        outlooks = _outlooks_of(world, entry)
        for outlook in outlooks:
            bake(outlook)
        return [_described(outlook) for outlook in outlooks]

    entries = [*world.config["clips"], *world.config["flights"]]
    clips = []
    for k, found in enumerate(cores.map(plan_entry, entries)):
        clips += found
        planned(entries[k]["id"], k + 1, len(entries))
    _check_ids([clip["id"] for clip in clips])
    return clips


def _outlooks_of(world: World, entry: dict) -> list[Outlook]:
    """Outlooks of a clip, or of the clips cut from a flight."""
    flight = world.flight(entry)
    seen = sightings(world.camera(entry), flight, world.actors)
    if "keep" not in entry:  # a clip
        return [Outlook(entry, flight, seen)]
    stretches = cut(entry, seen, world.config["seed"])
    if not stretches:
        place = world.config["flights"].index(entry)
        raise ConfigError(
            f'flights[{place}].keep = "{entry["keep"]}": no actor comes into the picture; expected one, or "all"'
        )
    parts = [slice(first, first + frames) for first, frames in stretches]
    clips = clips_of(entry, stretches)
    return [Outlook(clip, world.flight(clip), seen[part]) for clip, part in zip(clips, parts)]


def _check_ids(ids: list[str]) -> None:
    """Check that the ids of the config's own clips, which come first, differ from those cut from flights."""
    last = {name: k for k, name in enumerate(ids)}
    for k, name in enumerate(ids):
        if last[name] != k:
            raise ConfigError(f'clips[{k}].id = "{name}"; expected an id that no clip of a flight has')


def _described(outlook: Outlook) -> dict:
    clip, flight = outlook.clip, outlook.flight
    return {
        "id": clip["id"],
        "of_flight": clip.get("of_flight", ""),
        "start_s": clip["start_s"],
        "frames": clip["frames"],
        "frame_rate_hz": clip["frame_rate_hz"],
        "duration_s": round(clip["frames"] / clip["frame_rate_hz"], 3),
        "frames_with_actors": int(outlook.seen.sum()),
        "min_agl_m": round(float(flight.agl_m.min()), 3),
        "max_agl_m": round(float(flight.agl_m.max()), 3),
        "mean_agl_m": round(float(flight.agl_m.mean()), 3),
        "mean_look_angle_deg": round(float(flight.look_angle_deg.mean()), 3),
    }
