"""Write the track of a clip: the camera, the position of every actor, and the bones of those that may be visible."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..camera import intrinsics_of, widened
from ..flight.poses import Flight
from ..frusta import frusta_of
from ..groups.actors import Actor, Company
from ..sightings import may_be_in_frame
from ..world import World
from .arrays import write
from .forms import TRACK, VERSION

# Large enough that calls of NumPy cost little, small enough that arrays take a few megabytes for any clip.
_PLACES_AT_ONCE = 16384  # moments of actors whose positions are computed together
_POSES_AT_ONCE = 2048  # moments of actors of one body that are posed together
_SLACK = 1.2  # of the size of bodies: allowance beyond their boxes, which are sampled in time


def bake_track(
    world: World, clip: str, flight: Flight, path: Path, everyone: bool = False, camera: dict | None = None
) -> None:
    """Write `path`.json and `path`.bin. camera: the clip's own, if it has one.

    posed (actors, frames): whether the picture may show an actor, or `everyone`. bones (k, 3, 4): scaled rotations and
    positions of its bones with a mesh in these frames, actor by actor, frame by frame, bone by bone.
    """
    company = Company(world.actors)
    positions, headings, posed = _places(world, company, flight, camera)
    posed |= everyone
    arrays = {
        "time_s": flight.time_s,
        "camera_to_world": flight.camera_to_world,
        "agl_m": flight.agl_m,
        "look_angle_deg": flight.look_angle_deg,
        "actor_position_m": positions,
        "actor_heading_rad": headings,
        "posed": posed.astype("|u1"),
        "bones": _bones(company, flight.time_s, posed),
    }
    header = {"format": TRACK, "version": VERSION, "clip": clip, "frames": len(flight.time_s)}
    if camera:
        header["camera"] = camera
    write(path, header, arrays)


def _places(
    world: World, company: Company, flight: Flight, camera: dict | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions (actors, n, 3) and headings (actors, n), and the mask (actors, n) of the frames of a flight that may
    show each actor.
    """
    actors, time_s = world.actors, flight.time_s
    positions = np.zeros((len(actors), len(time_s), 3))
    headings, posed = np.zeros(positions.shape[:2]), np.zeros(positions.shape[:2], bool)
    view = widened(intrinsics_of(camera), world.view_margin_px) if camera else world.view_intrinsics
    frusta = frusta_of(view, flight.camera_to_world)
    for part in _parts(len(time_s) if actors else 0, _PLACES_AT_ONCE // max(1, len(actors))):
        at_s = time_s[part]
        walk = company.track(np.repeat(np.arange(len(actors)), len(at_s)), np.tile(at_s, len(actors)))
        positions[:, part] = walk.position_m.reshape(len(actors), -1, 3)
        headings[:, part] = walk.heading_rad.reshape(len(actors), -1)
        posed[:, part] = may_be_in_frame(frusta.at(part), actors, positions[:, part], _SLACK)
    return positions, headings, posed


def _bones(company: Company, time_s: np.ndarray, posed: np.ndarray) -> np.ndarray:
    """Transforms (k, 3, 4) of the bones of actors in the frames in which they are posed (actors, n)."""
    shown = [_with_mesh(actor) for actor in company.actors]
    count = posed * np.array([len(bones) for bones in shown], np.int64)[:, None]
    first = (np.cumsum(count) - count.ravel()).reshape(count.shape)
    found = np.zeros((count.sum(), 3, 4), "<f4")
    for alike in _alike(company.actors):
        of, frame = np.nonzero(posed[alike])
        of = alike[of]
        for part in _parts(len(of), _POSES_AT_ONCE):
            rows = first[of[part], frame[part]][:, None] + np.arange(len(shown[alike[0]]))
            found[rows] = _matrices(company, of[part], time_s[frame[part]], shown[alike[0]])
    return found


def _matrices(company: Company, of: np.ndarray, time_s: np.ndarray, bones: list[int]) -> np.ndarray:
    """Transforms (n, bones, 3, 4) of bones of actors of one body at n moments."""
    posed = company.poses(of, time_s)
    matrices = np.zeros((len(of), len(bones), 3, 4), "<f4")
    matrices[..., :3] = posed.scale[:, None, None, None] * posed.rotation[:, bones]
    matrices[..., 3] = posed.position_m[:, bones]
    return matrices


def _with_mesh(actor: Actor) -> list[int]:
    """Bones that have a mesh."""
    return [k for k, bone in enumerate(actor.body.bones) if len(bone.mesh.triangles) > 0]


def _alike(actors: Sequence[Actor]) -> list[np.ndarray]:
    """Indices of the actors that share a body and a posture, for each body and posture."""
    found: dict[tuple, list[int]] = {}
    for k, actor in enumerate(actors):
        found.setdefault((actor.species, actor.variant, actor.posture), []).append(k)
    return [np.array(places) for places in found.values()]


def _parts(count: int, at_once: int) -> list[slice]:
    """Successive parts of a range, each of at most at_once items, or 1."""
    step = max(1, at_once)
    return [slice(start, min(start + step, count)) for start in range(0, count, step)]
