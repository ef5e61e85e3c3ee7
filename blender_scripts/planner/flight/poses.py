"""Position and attitude of a camera over time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..camera import look
from ..geometry.rotations import by_vector, heading_of
from ..land.terrain import Terrain
from .logs import Log

STEP_S = 0.02  # linear interpolation between moments: an error of half a millimetre at 10 m/s^2


@dataclass(frozen=True)
class Flight:
    """Frames: time_s (n,), camera_to_world (n, 4, 4), agl_m (n,) over ground or water, look_angle_deg (n,)."""

    time_s: np.ndarray
    camera_to_world: np.ndarray
    agl_m: np.ndarray
    look_angle_deg: np.ndarray


@dataclass(frozen=True)
class Poses:
    """A camera at n moments: position_m (n, 3), its axis' bearing_rad (n,) from +x and depression_rad (n,).

    lean_rad (n, 3): rotation vectors in world axes of its deviation from these angles.
    """

    position_m: np.ndarray
    bearing_rad: np.ndarray
    depression_rad: np.ndarray
    lean_rad: np.ndarray


class Trajectory(Protocol):
    """Poses as a pure function of time."""

    def at(self, time_s: np.ndarray) -> Poses:
        """The poses at times (n,) from 0 on."""


@dataclass(frozen=True)
class SteppedTrajectory:
    """Poses STEP_S apart, from time 0; linear in between."""

    poses: Poses

    def at(self, time_s: np.ndarray) -> Poses:
        """The poses at times (n,), from 0 to the last moment."""
        place = np.asarray(time_s, float) / STEP_S
        before = np.minimum(place.astype(np.int64), len(self.poses.bearing_rad) - 2)
        share = place - before
        return Poses(*(_between(values, before, share) for values in vars(self.poses).values()))


@dataclass(frozen=True)
class LoggedTrajectory:
    """The poses of a log over a terrain."""

    log: Log
    terrain: Terrain

    def at(self, time_s: np.ndarray) -> Poses:
        """The poses at times (n,), from 0 to the log's duration; roll is a rotation about the camera's axis."""
        position_m, bearing_rad, depression_rad, roll_rad = self.log.at(time_s, self.terrain.surface_m)
        forward = look(position_m, heading_of(bearing_rad), depression_rad)[:, :3, 2]
        return Poses(position_m, bearing_rad, depression_rad, roll_rad[:, None] * forward)


def flight_of(trajectory: Trajectory, time_s: np.ndarray, terrain: Terrain) -> Flight:
    """The frames of a trajectory at times (n,)."""
    poses = trajectory.at(time_s)
    camera_to_world = look(poses.position_m, heading_of(poses.bearing_rad), poses.depression_rad)
    camera_to_world[:, :3, :3] = by_vector(poses.lean_rad) @ camera_to_world[:, :3, :3]
    x_m, y_m, z_m = poses.position_m.T
    down = np.clip(-camera_to_world[:, 2, 2], -1.0, 1.0)
    return Flight(time_s, camera_to_world, z_m - terrain.surface_m(x_m, y_m), np.degrees(np.arcsin(down)))


def _between(values: np.ndarray, before: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Values (n, …) interpolated between moments."""
    share = share.reshape(share.shape + (1,) * (values.ndim - 1))
    return values[before] + share * (values[before + 1] - values[before])
