"""What a config will show, told without rendering it."""

from __future__ import annotations

import numpy as np

from .camera import project
from .flight import Flight
from .geometry.rotations import left_of
from .groups.actors import Actor, track
from .world import World


def plan_dataset(world: World) -> dict:
    """Frames and heights of each clip, and how many actors and plants the scene holds."""
    return {
        "clips": [_plan_clip(world, clip) for clip in world.config["clips"]],
        "objects": len(world.actors),
        "plants": sum(len(planting.scale) for planting in world.plantings.values()),
    }


def _plan_clip(world: World, clip: dict) -> dict:
    flight = world.flight(clip)
    seen = np.zeros(len(flight.time_s), bool)
    for actor in world.actors:
        seen |= is_in_frame(world, flight, actor)
    return {
        "id": clip["id"],
        "frames": clip["frames"],
        "duration_s": round(clip["frames"] / clip["frame_rate_hz"], 3),
        "frames_with_actors": int(seen.sum()),
        "min_agl_m": round(float(flight.agl_m.min()), 3),
        "max_agl_m": round(float(flight.agl_m.max()), 3),
    }


def is_in_frame(world: World, flight: Flight, actor: Actor) -> np.ndarray:
    """In which frames (n,) the actor's box overlaps the picture; what may hide it is not considered."""
    corners_px, depth_m = project(world.intrinsics, flight.camera_to_world, box_corners_m(flight, actor))
    low, high = corners_px.min(axis=1), corners_px.max(axis=1)
    size_px = np.array([world.intrinsics.width_px, world.intrinsics.height_px])
    return ((low < size_px) & (high > 0)).all(axis=1) & (depth_m > 0).all(axis=1)


def box_corners_m(flight: Flight, actor: Actor) -> np.ndarray:
    """World positions (n, 8, 3) of the corners of the actor's box in every frame."""
    walk = track(actor, flight.time_s)
    low, high = actor.bounds_m
    pick = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    corners = np.where(pick == 0, low, high)
    forward = walk.heading[:, None, :]
    level = corners[:, 0:1] * forward + corners[:, 1:2] * left_of(forward)
    height = np.broadcast_to(corners[:, 2:3], level.shape[:2] + (1,))
    return walk.position_m[:, None, :] + np.concatenate([level, height], axis=-1)
