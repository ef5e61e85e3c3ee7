"""Visibility of actors in the picture over time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .camera import Intrinsics, project
from .flight.poses import Flight
from .frusta import Frusta, frusta_of
from .geometry.rotations import left_of
from .groups.actors import Actor, Company, Track

_PLACES_AT_ONCE = 4096  # of actors in frames


def sightings(intrinsics: Intrinsics, flight: Flight, actors: list[Actor]) -> np.ndarray:
    """Mask of frames (n,) in which the box of an actor overlaps the picture; occlusion is ignored."""
    frusta, company = frusta_of(intrinsics, flight.camera_to_world), Company(actors)
    radii_m = np.array([_radius_m(actor) for actor in actors])
    seen, first = np.zeros(len(flight.time_s), bool), 0
    while first < len(actors) and not seen.all():
        left = np.flatnonzero(~seen)
        some = np.arange(first, min(len(actors), first + max(1, _PLACES_AT_ONCE // len(left))))
        first = int(some[-1]) + 1
        of, frames = np.repeat(some, len(left)), np.tile(left, len(some))
        near, walk = _near(frusta.at(frames), flight.time_s[frames], company, of, radii_m[of])
        for k in np.unique(of[near]):
            its = of[near] == k
            at = frames[near][its]
            its_walk = Track(walk.position_m[its], walk.heading[its])
            seen[at] |= _is_in_frame(intrinsics, flight.camera_to_world[at], actors[k], its_walk)
    return seen


def may_be_in_frame(
    frusta: Frusta, actors: Sequence[Actor], position_m: np.ndarray, slack: float
) -> np.ndarray:
    """Mask (actors, n) of frames whose picture may show spheres around actors' positions (actors, n, 3).

    At slack 1 a sphere just contains an actor's box; its radius is proportional to slack.
    """
    radii_m = np.array([_radius_m(actor) for actor in actors])[:, None]
    x_m, y_m, z_m = np.moveaxis(position_m, -1, 0)
    return frusta.may_show(x_m, y_m, (z_m, z_m), slack * radii_m)


def _near(
    frusta: Frusta, time_s: np.ndarray, company: Company, of: np.ndarray, radius_m: np.ndarray
) -> tuple[np.ndarray, Track]:
    """The moments (n,) of actors whose picture may show a sphere around the actor's box, and the tracks in them.

    Most moments are excluded before the height of the ground is computed, the most expensive step.
    """
    terrain = company.actors[0].terrain
    point, heading = company.ground_path(of, time_s)
    moments = np.flatnonzero(frusta.may_show(*point.T, terrain.range_m, radius_m))
    height_m = terrain.height_m(*point[moments].T)
    near = frusta.at(moments).may_show(*point[moments].T, (height_m, height_m), radius_m[moments])
    moments = moments[near]
    return moments, Track(np.column_stack([point[moments], height_m[near]]), heading[moments])


def _radius_m(actor: Actor) -> float:
    return float(np.linalg.norm(np.abs(actor.bounds_m).max(axis=0)))


def _is_in_frame(
    intrinsics: Intrinsics, camera_to_world: np.ndarray, actor: Actor, walk: Track
) -> np.ndarray:
    """Mask of frames (n,) in which the actor's box overlaps the picture."""
    corners_px, depth_m = project(intrinsics, camera_to_world, box_corners_m(actor, walk))
    low, high = corners_px.min(axis=1), corners_px.max(axis=1)
    size_px = np.array([intrinsics.width_px, intrinsics.height_px])
    return ((low < size_px) & (high > 0)).all(axis=1) & (depth_m > 0).all(axis=1)


def box_corners_m(actor: Actor, walk: Track) -> np.ndarray:
    """World positions (n, 8, 3) of the corners of an actor's box along a track."""
    low, high = actor.bounds_m
    pick = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    corners = np.where(pick == 0, low, high)
    forward = walk.heading[:, None, :]
    level = corners[:, 0:1] * forward + corners[:, 1:2] * left_of(forward)
    height = np.broadcast_to(corners[:, 2:3], level.shape[:2] + (1,))
    return walk.position_m[:, None, :] + np.concatenate([level, height], axis=-1)
