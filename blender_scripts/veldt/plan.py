"""Predict what a config will show without rendering it, and cut its long flights into clips."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from .camera import Intrinsics, edge_tangents, project
from .cuts import clips_of, cut
from .faults import ConfigError
from .flight.poses import Flight
from .geometry.rotations import left_of
from .groups.actors import Actor, Track, track
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
    seen = _sightings(world, flight)
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


def _sightings(world: World, flight: Flight) -> np.ndarray:
    """Mask of frames (n,) in which the box of an actor overlaps the picture; occlusion is ignored."""
    seen = np.zeros(len(flight.time_s), bool)
    for actor in world.actors:
        seen |= is_in_frame(world.intrinsics, flight, actor)
    return seen


def is_in_frame(intrinsics: Intrinsics, flight: Flight, actor: Actor) -> np.ndarray:
    """Mask of frames (n,) in which the actor's box overlaps the picture."""
    walk = track(actor, flight.time_s)
    inside = _may_be_in_frame(intrinsics, flight, actor, walk)
    near = np.flatnonzero(inside)
    corners_m = box_corners_m(actor, Track(walk.position_m[near], walk.heading[near]))
    corners_px, depth_m = project(intrinsics, flight.camera_to_world[near], corners_m)
    low, high = corners_px.min(axis=1), corners_px.max(axis=1)
    size_px = np.array([intrinsics.width_px, intrinsics.height_px])
    inside[near] = ((low < size_px) & (high > 0)).all(axis=1) & (depth_m > 0).all(axis=1)
    return inside


def _may_be_in_frame(intrinsics: Intrinsics, flight: Flight, actor: Actor, walk: Track) -> np.ndarray:
    """Mask of frames (n,) in which a sphere around the actor's origin that contains its box is not outside the picture.

    Cheap and conservative: never false where the box is in the picture.
    """
    radius_m = np.linalg.norm(np.abs(actor.bounds_m).max(axis=0))
    pose = flight.camera_to_world
    local = ((walk.position_m - pose[:, :3, 3])[:, None, :] @ pose[:, :3, :3])[:, 0]
    near = local[:, 2] > -radius_m
    for side, tangents in zip((-1.0, 1.0), np.array(edge_tangents(intrinsics))):
        outside_m = (side * local[:, :2] - tangents * local[:, 2:]) / np.sqrt(1.0 + tangents * tangents)
        near &= (outside_m < radius_m).all(axis=1)
    return near


def box_corners_m(actor: Actor, walk: Track) -> np.ndarray:
    """World positions (n, 8, 3) of the corners of an actor's box along a track."""
    low, high = actor.bounds_m
    pick = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    corners = np.where(pick == 0, low, high)
    forward = walk.heading[:, None, :]
    level = corners[:, 0:1] * forward + corners[:, 1:2] * left_of(forward)
    height = np.broadcast_to(corners[:, 2:3], level.shape[:2] + (1,))
    return walk.position_m[:, None, :] + np.concatenate([level, height], axis=-1)
