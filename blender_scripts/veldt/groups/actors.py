"""Positions and poses of actors as pure functions of time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..anatomy.gait import stride_m
from ..anatomy.pose import Motion, Poses, Walker, pose
from ..geometry.components import facing
from ..geometry.rotations import left_of
from ..geometry.splines import Loop, Spot
from ..land.terrain import Terrain
from ..workers import Cores
from .behaviours import Draft

_PLACES = 64  # positions along an actor's path at which its bounding box is measured
_MOMENTS = 24  # steps of a stride, at each of the path's steepest places
_STEP_M = 1.0
_UNLIKE_S = 1.7  # between moments at which a body is measured; not a period of any motion
# Pace and head_down of walking, standing and feeding: a neck extends farthest when half lowered.
_WALKING, _STANDING, _FEEDING = (1.0, 0.0), (0.0, 0.0), ((0.0, 0.0), (0.0, 0.5), (0.0, 1.0))
_MARGIN = 0.015  # of the box's size, for motion between the measured moments


@dataclass(frozen=True)
class Actor(Draft):
    """One animal, person or vehicle: at time 0 it is start_m along its route and lateral_m to the left of it."""

    group: str
    index: int
    route: Loop | Spot
    start_m: float
    lateral_m: float
    terrain: Terrain = field(repr=False, compare=False)

    @property
    def walker(self) -> Walker:
        """Its body on its path."""
        stride = stride_m(self.walking_m_s, self.scale * self.body.leg_m)
        return Walker(self.body, self.scale, stride, self.phase, self.path, self.terrain)

    def path(self, walked_m) -> tuple[np.ndarray, np.ndarray]:
        """Points (n, 2) and headings (n, 2) after distances (n,)."""
        point, heading = self.route.at(walked_m)
        return point + self.lateral_m * left_of(heading), heading

    @cached_property
    def bounds_m(self) -> np.ndarray:
        """Box (2, 3) in actor axes, at its own size, that contains its body everywhere along its path."""
        walked_m, pace, head_down = _telling_moments(self)
        time_s = _UNLIKE_S * np.arange(len(walked_m))
        body = pose(self.walker, Motion(walked_m, time_s, pace, head_down, self.posture))
        point, heading = self.path(walked_m)
        origin = np.stack([*point.T, self.terrain.height_m(*point.T)])
        low, high = body.extent_m(self.body, origin, facing(heading.T))
        return np.stack([low - _MARGIN * (high - low), high + _MARGIN * (high - low)])


def measure(actors: Sequence[Actor], cores: Cores) -> None:
    """Find the boxes of all actors at once."""
    for actor, box in zip(actors, cores.map(lambda actor: actor.bounds_m, actors)):
        vars(actor)["bounds_m"] = box  # where cached_property keeps it


@dataclass(frozen=True)
class Track:
    """An actor at n moments: position_m (n, 3) on the ground, heading (n, 2) unit vectors."""

    position_m: np.ndarray
    heading: np.ndarray

    @property
    def heading_rad(self) -> np.ndarray:
        """Counter-clockwise from +x, within [-pi, pi]."""
        return np.arctan2(self.heading[:, 1], self.heading[:, 0])


def ground_path(actor: Actor, time_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The actor's points (n, 2) and headings (n, 2) at times (n,)."""
    return actor.path(actor.start_m + actor.schedule.at(time_s).walked_m)


def track(actor: Actor, time_s: np.ndarray) -> Track:
    """The actor's track on the ground at times (n,)."""
    point, heading = ground_path(actor, time_s)
    return Track(np.column_stack([point, actor.terrain.height_m(*point.T)]), heading)


def poses(actor: Actor, time_s: np.ndarray) -> Poses:
    """The actor's body in the world at each time (n,)."""
    doing = actor.schedule.at(time_s)
    motion = Motion(actor.start_m + doing.walked_m, time_s, doing.pace, doing.head_down, actor.posture)
    return pose(actor.walker, motion)


def _telling_moments(actor: Actor) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Distances walked, paces and head_down, each (n,), that sample everything a body does along its path.

    For walkers, points all along the path and strides around its steepest places; at each, every state of its schedule.
    """
    moves, lowers = actor.schedule.mean_m_s > 0, actor.schedule.lowers_head
    states = ([_WALKING] if moves else []) + ([*_FEEDING] if lowers else []) + ([] if moves else [_STANDING])
    walked_m = _telling_places(actor) if moves else np.full(_PLACES, actor.start_m)
    return (
        np.tile(walked_m, len(states)),
        np.repeat([pace for pace, _ in states], len(walked_m)),
        np.repeat([head for _, head in states], len(walked_m)),
    )


def _telling_places(actor: Actor) -> np.ndarray:
    """Distances (n,) along an actor's path: all along it, and strides around its steepest places."""
    along_m = np.arange(0.0, actor.route.length_m, _STEP_M)
    point, heading = actor.path(along_m)
    slopes = []
    for across in (heading, left_of(heading)):
        ends = [actor.terrain.height_m(*(point + reach * across).T) for reach in (-_STEP_M, _STEP_M)]
        slopes.append(ends[1] - ends[0])
    steepest = [along_m[pick(slope)] for slope in slopes for pick in (np.argmin, np.argmax)]
    around = np.add.outer(steepest, actor.walker.stride_m * np.linspace(-0.5, 0.5, _MOMENTS)).ravel()
    return np.concatenate([np.linspace(0.0, actor.route.length_m, _PLACES), around])
