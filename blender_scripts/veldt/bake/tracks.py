"""Write the track of a clip: the camera, the place of every actor, and the bones of those that may be seen."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..flight.poses import Flight
from ..frusta import frusta_of
from ..groups.actors import Actor, poses, track
from ..sightings import may_be_in_frame
from ..world import World
from .arrays import write
from .forms import TRACK, VERSION

_AT_ONCE = 64  # frames posed together: single frames are slow in NumPy, whole clips take gigabytes
_SLACK = 1.2  # of the size of bodies: allowance beyond their boxes, which are sampled in time


def bake_track(world: World, clip: str, flight: Flight, path: Path, everyone: bool = False) -> None:
    """Write `path`.json and `path`.bin.

    posed (actors, frames): whether an actor may be in the picture, or `everyone`. bones (k, 3, 4): scaled rotations and
    positions of its bones with a mesh in these frames, actor by actor, frame by frame, bone by bone.
    """
    posed = _posed(world, flight) | everyone
    walks = [track(actor, flight.time_s) for actor in world.actors]
    positions = np.zeros((len(walks), len(flight.time_s), 3))
    headings = np.zeros(positions.shape[:2])
    for k, walk in enumerate(walks):
        positions[k], headings[k] = walk.position_m, walk.heading_rad
    bones = [_bones(actor, flight.time_s[seen]) for actor, seen in zip(world.actors, posed)]
    arrays = {
        "time_s": flight.time_s,
        "camera_to_world": flight.camera_to_world,
        "agl_m": flight.agl_m,
        "look_angle_deg": flight.look_angle_deg,
        "actor_position_m": positions,
        "actor_heading_rad": headings,
        "posed": posed.astype("|u1"),
        "bones": np.concatenate([np.zeros((0, 3, 4), "<f4"), *bones]),
    }
    header = {"format": TRACK, "version": VERSION, "clip": clip, "frames": len(flight.time_s)}
    write(path, header, arrays)


def _posed(world: World, flight: Flight) -> np.ndarray:
    """Mask (actors, n) of the frames of a flight in which each actor may be in the picture."""
    frusta = frusta_of(world.passes_intrinsics, flight.camera_to_world)
    seen = [may_be_in_frame(frusta, flight.time_s, actor, _SLACK) for actor in world.actors]
    return np.array(seen, bool).reshape(len(world.actors), len(flight.time_s))


def _bones(actor: Actor, time_s: np.ndarray) -> np.ndarray:
    """Transforms (n * bones with a mesh, 3, 4) of an actor's bones."""
    starts = range(0, len(time_s), _AT_ONCE)
    parts = [_matrices(actor, time_s[start : start + _AT_ONCE]) for start in starts]
    return np.concatenate([np.zeros((0, 3, 4), "<f4"), *parts])


def _matrices(actor: Actor, time_s: np.ndarray) -> np.ndarray:
    bones = [k for k, bone in enumerate(actor.body.bones) if len(bone.mesh.triangles) > 0]
    posed = poses(actor, time_s)
    matrices = np.zeros((len(time_s), len(bones), 3, 4), "<f4")
    matrices[..., :3] = posed.scale[:, None, None, None] * posed.rotation[:, bones]
    matrices[..., 3] = posed.position_m[:, bones]
    return np.reshape(matrices, (-1, 3, 4))
