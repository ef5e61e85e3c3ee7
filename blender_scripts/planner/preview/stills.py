"""Camera poses for colour stills of a scene: an overview, and close-ups of some of its actors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import assets
from ..camera import look
from ..groups.actors import Actor, track
from ..world import World
from .views import INTRINSICS

_CLOSE_VIEWS = 4
_OVERVIEW_M = 122.0
_EYE_M = 1.7
_NEAREST_M, _FARTHEST_M = 5.0, 15.0
_ROOM = 2.0  # picture size relative to the body's size
_AZIMUTHS_DEG = (90, -90, 70, -70, 110, -110, 45, -45, 135, -135, 20, -20, 160, -160)
_SIGHT_STEPS = 12
_BODY_M = 2.5  # distance from the line of sight within which an actor blocks the view


@dataclass(frozen=True)
class Still:
    """A picture's name and the pose (4, 4) of the camera that takes it."""

    name: str
    camera_to_world: np.ndarray


def plan_stills(world: World, time_s: float) -> list[Still]:
    """An overview at 45 deg from 122 m, and a side view of the first actor of each of the first four categories."""
    firsts: dict[str, Actor] = {}
    for actor in world.actors:
        firsts.setdefault(assets.load("species", actor.species)["category"], actor)
    chosen = list(firsts.values())[:_CLOSE_VIEWS]
    return [
        Still("overview", _overview(world, time_s)),
        *(Still(f"close_{actor.group}", _close(world, actor, time_s)) for actor in chosen),
    ]


def _overview(world: World, time_s: float) -> np.ndarray:
    """A view of the largest group of actors, towards the centre of the scene, or of the centre, to the north."""
    at_m = _busiest(world, time_s)
    distance_m = np.linalg.norm(at_m)
    bearing = -at_m / distance_m if distance_m > 1.0 else np.array([0.0, 1.0])
    point = at_m - _OVERVIEW_M * bearing
    height_m = world.terrain.surface_m(*at_m) + _OVERVIEW_M
    return _pose(np.array([*point, height_m]), np.array([*at_m, height_m - _OVERVIEW_M]))


def _busiest(world: World, time_s: float) -> np.ndarray:
    """The position (x, y) of the actor with most neighbours."""
    if not world.actors:
        return np.zeros(2)
    places_m = np.array([_place(actor, time_s)[0][:2] for actor in world.actors])
    apart_m = np.linalg.norm(places_m[:, None] - places_m, axis=-1)
    return places_m[(apart_m < 0.5 * _OVERVIEW_M).sum(axis=1).argmax()]


def _place(actor: Actor, time_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Position (3,) and heading (2,)."""
    walk = track(actor, np.array([time_s]))
    return walk.position_m[0], walk.heading[0]


def _close(world: World, actor: Actor, time_s: float) -> np.ndarray:
    """At eye height beside an actor, on the side with the fewest obstacles."""
    foot_m, heading = _place(actor, time_s)
    size_m = np.diff(actor.bounds_m, axis=0)[0]
    target_m = foot_m + [0.0, 0.0, actor.bounds_m[:, 2].mean()]
    target_m[2] = max(
        target_m[2], world.terrain.surface_m(*target_m[:2])
    )  # of floating bodies, the visible part
    fits_m = (
        _ROOM
        * INTRINSICS.focal_px[0]
        * max(size_m[0] / INTRINSICS.width_px, size_m[2] / INTRINSICS.height_px)
    )
    distance_m = np.clip(fits_m, _NEAREST_M, _FARTHEST_M)
    eyes = [_eye(world, target_m, heading, azimuth, distance_m) for azimuth in _AZIMUTHS_DEG]
    others = [other for other in world.actors if other is not actor]
    others_m = np.array([_place(other, time_s)[0][:2] for other in others]).reshape(-1, 2)
    return _pose(min(eyes, key=lambda eye: _hindrances(world, eye, target_m, others_m)), target_m)


def _eye(
    world: World, target_m: np.ndarray, heading: np.ndarray, azimuth_deg: float, distance_m: float
) -> np.ndarray:
    cos, sin = np.cos(np.radians(azimuth_deg)), np.sin(np.radians(azimuth_deg))
    side = np.array([cos * heading[0] - sin * heading[1], sin * heading[0] + cos * heading[1]])
    point = target_m[:2] + distance_m * side
    return np.array([*point, float(world.terrain.surface_m(*point)) + _EYE_M])


def _hindrances(world: World, eye_m: np.ndarray, target_m: np.ndarray, others_m: np.ndarray) -> float:
    """Number of obstacles between eye and target: plants, other actors, ground; positions outside are worst."""
    half_m = 0.5 * world.terrain.size_m
    line = eye_m + np.linspace(0.0, 0.9, _SIGHT_STEPS)[:, None] * (target_m - eye_m)
    under_m = world.terrain.surface_m(line[:, 0], line[:, 1])
    outside = np.abs(eye_m[:2]).max() > half_m - 1.0
    covered = 100.0 * (under_m > line[:, 2]).any() + 10.0 * (_apart_m(others_m, line) < _BODY_M).sum()
    return 1000.0 * outside + covered + _plants_near(world, line)


def _plants_near(world: World, line_m: np.ndarray) -> int:
    """Number of plants that intersect a line of sight (n, 3)."""
    count = 0
    for name, planting in world.plantings.items():
        reach_m = 0.5 * assets.standing(name).get("crown_diameter_m", 1.0) * planting.scale
        count += int((_apart_m(planting.points_m[:, :2], line_m) < reach_m + 0.3).sum())
    return count


def _apart_m(points_m: np.ndarray, line_m: np.ndarray) -> np.ndarray:
    """Distances (n,) of points (n, 2) from a straight line of sight (k, 3), as seen from above."""
    start, way = line_m[0, :2], line_m[-1, :2] - line_m[0, :2]
    off = points_m - start
    along = np.clip(off @ way / max(way @ way, 1e-9), 0.0, 1.0)
    return np.linalg.norm(off - along[:, None] * way, axis=1)


def _pose(eye_m: np.ndarray, target_m: np.ndarray) -> np.ndarray:
    """The pose of a camera at one point that looks at another."""
    way = target_m - eye_m
    level_m = np.linalg.norm(way[:2])
    depression_rad = np.arctan2([-way[2]], [level_m])
    return look(eye_m[None], way[None, :2] / level_m, depression_rad)[0]
