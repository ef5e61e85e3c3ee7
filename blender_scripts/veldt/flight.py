"""Where the camera is and looks, frame by frame: pure functions of time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .camera import look
from .groups.actors import Actor, track
from .land.terrain import Terrain

_SMOOTHING_S = np.linspace(-2.0, 2.0, 9)  # a pilot follows where a target is going, not each of its turns


@dataclass(frozen=True)
class Flight:
    """Frames: time_s (n,), camera_to_world (n, 4, 4), agl_m (n,) over ground or water, look_angle_deg (n,)."""

    time_s: np.ndarray
    camera_to_world: np.ndarray
    agl_m: np.ndarray
    look_angle_deg: np.ndarray


def fly(clip: dict, terrain: Terrain, actors: Sequence[Actor]) -> Flight:
    """The flight of a clip; `actors` are those a `follow` flight looks at."""
    time_s = clip["start_s"] + np.arange(clip["frames"]) / clip["frame_rate_hz"]
    plan = clip["flight"]
    if plan["pattern"] == "zigzag":
        position, bearing, depression = _fly_zigzag(plan, terrain, time_s)
    else:
        position, bearing, depression = _fly_behind(plan, terrain, actors, time_s)
    agl_m = position[:, 2] - terrain.surface_m(position[:, 0], position[:, 1])
    return Flight(time_s, look(position, bearing, depression), agl_m, np.degrees(depression))


def zigzag(plan: dict, time_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) and unit directions (n, 2) of a boustrophedon over area_m.

    Lanes along heading_deg, joined by half circles lane_spacing_m wide outside the area, at constant speed. It starts
    at the first lane's beginning; after the last lane it works its way back to the first, and so on for ever.
    """
    half_u, half_v = _half_extents(plan)
    spacing = plan["lane_spacing_m"]
    # A turn needs a lane to turn into; and a width that is whole lanes but for rounding gets no lane more.
    lanes = max(2, int(np.ceil(2.0 * half_v / spacing - 1e-9)))
    lane_m, turn_m = 2.0 * half_u, 0.5 * np.pi * spacing
    number, along_m = np.divmod(plan["speed_m_s"] * np.asarray(time_s, float), lane_m + turn_m)
    forth = np.where(number % 2 == 0, 1.0, -1.0)
    here, there = _folded(number, lanes), _folded(number + 1, lanes)
    angle = np.clip((along_m - lane_m) / turn_m, 0.0, 1.0) * np.pi
    sideways = (there - here) * spacing
    u = forth * (np.minimum(along_m, lane_m) - half_u + 0.5 * spacing * np.sin(angle))
    v = (here - 0.5 * (lanes - 1)) * spacing + 0.5 * sideways * (1.0 - np.cos(angle))
    du, dv = forth * np.cos(angle), np.sign(sideways) * np.sin(angle)
    return _from_lanes(plan, u, v) + _middle(plan), _from_lanes(plan, du, dv)


def _fly_zigzag(plan: dict, terrain: Terrain, time_s: np.ndarray):
    point, direction = zigzag(plan, time_s)
    position = np.column_stack([point, _camera_height(plan, terrain, point)])
    return position, direction, np.full(len(time_s), np.radians(plan["look_angle_deg"]))


def _fly_behind(plan: dict, terrain: Terrain, actors: Sequence[Actor], time_s: np.ndarray):
    """At azimuth_deg from the target, as far as look_angle_deg asks for, looking straight at it.

    Above ground, the distance is the one for level ground, so that the camera does not rock with every bump: where the
    ground is not level, the true look angle differs from the planned one.
    """
    target, heading = _smoothed_target(actors, time_s)
    rise_m = plan["altitude_m"] - (target[:, 2] if plan["altitude_reference"] == "datum" else 0.0)
    back_m = np.abs(rise_m) / np.tan(np.radians(plan["look_angle_deg"])) + np.zeros(len(time_s))
    outward = _turned(heading, np.radians(plan["azimuth_deg"]))
    point = target[:, :2] + back_m[:, None] * outward
    position = np.column_stack([point, _camera_height(plan, terrain, point)])
    depression = np.arctan2(position[:, 2] - target[:, 2], back_m)
    return position, -outward, depression


def _smoothed_target(actors: Sequence[Actor], time_s: np.ndarray):
    """Middle of the actors' bodies (n, 3) and their common heading (n, 2), averaged over a few seconds."""
    tracks = [track(actor, time_s + shift) for actor in actors for shift in _SMOOTHING_S]
    middle = np.mean([t.position_m for t in tracks], axis=0)
    middle[:, 2] += np.mean([actor.bounds_m[:, 2].mean() for actor in actors])
    heading = np.sum([t.heading for t in tracks], axis=0)
    length = np.linalg.norm(heading, axis=1, keepdims=True)
    # Members that walk in all directions have no common heading; then +x is as good as any.
    return middle, np.where(length > 1e-9, heading / np.maximum(length, 1e-9), [1.0, 0.0])


def _camera_height(plan: dict, terrain: Terrain, point: np.ndarray) -> np.ndarray:
    if plan["altitude_reference"] == "datum":
        return np.full(len(point), plan["altitude_m"])
    return terrain.smooth_surface_m(point[:, 0], point[:, 1]) + plan["altitude_m"]


def _half_extents(plan: dict) -> tuple[float, float]:
    """Half lengths along and across the lanes of the smallest rectangle so turned that holds area_m."""
    x0, y0, x1, y1 = plan["area_m"]
    cos, sin = np.abs(_turned(np.array([1.0, 0.0]), np.radians(plan["heading_deg"])))
    return 0.5 * ((x1 - x0) * cos + (y1 - y0) * sin), 0.5 * ((x1 - x0) * sin + (y1 - y0) * cos)


def _middle(plan: dict) -> np.ndarray:
    x0, y0, x1, y1 = plan["area_m"]
    return np.array([0.5 * (x0 + x1), 0.5 * (y0 + y1)])


def _folded(number: np.ndarray, lanes: int) -> np.ndarray:
    """0, 1, … lanes-1, lanes-2, … 1, 0, 1 …"""
    place = np.mod(number, 2 * (lanes - 1))
    return np.minimum(place, 2 * (lanes - 1) - place)


def _from_lanes(plan: dict, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return _turned(np.stack([u, v], axis=-1), np.radians(plan["heading_deg"]))


def _turned(vectors: np.ndarray, angle_rad: float) -> np.ndarray:
    """Vectors (..., 2) turned counter-clockwise."""
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)
    return vectors @ np.array([[cos, sin], [-sin, cos]])
