"""Positions and poses of actors as pure functions of time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..anatomy.gait import Path, stride_m
from ..anatomy.pose import Motion, Poses, Walker, pose
from ..geometry.components import facing
from ..geometry.rotations import left_of
from ..geometry.splines import Loop, Spot
from ..land.terrain import Terrain
from ..workers import Cores
from .behaviours import Draft
from .schedules import Doing, together

_PLACES = 64  # positions along an actor's path at which its bounding box is measured
_MOMENTS = 24  # steps of a stride, at each of the path's steepest sections
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
        return _beside(self.route, self.lateral_m, walked_m)

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
        vars(actor)["bounds_m"] = box  # where cached_property stores it


@dataclass(frozen=True)
class Track:
    """An actor at n moments: position_m (n, 3) on the ground, heading (n, 2) unit vectors."""

    position_m: np.ndarray
    heading: np.ndarray

    @property
    def heading_rad(self) -> np.ndarray:
        """Counter-clockwise from +x, within [-pi, pi]."""
        return np.arctan2(self.heading[:, 1], self.heading[:, 0])


class Company:
    """Some actors of a scene at n moments at once.

    A moment is an actor and a time: `of` (n,), the actor's index in the company, ascending, and time_s (n,). Moments
    are independent of each other.
    """

    def __init__(self, actors: Sequence[Actor]):
        self.actors = actors
        self._start_m, self._lateral_m = (
            np.array([getattr(actor, name) for actor in actors]) for name in ("start_m", "lateral_m")
        )
        self._group = _numbered([actor.group for actor in actors])
        self._route = _numbered([id(actor.route) for actor in actors])

    def path(self, of: np.ndarray) -> Path:
        """The path of the actor of each moment."""

        def path(walked_m):
            point, heading = np.moveaxis(np.empty((2, 2) + np.shape(walked_m)), 1, -1)
            for part in _runs(self._route[of]):
                route, lateral_m = self.actors[of[part.start]].route, self._lateral_m[of[part]]
                point[..., part, :], heading[..., part, :] = _beside(route, lateral_m, walked_m[..., part])
            return point, heading

        return path

    def ground_path(self, of: np.ndarray, time_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points (n, 2) and headings (n, 2)."""
        return self.path(of)(self._start_m[of] + self._doing(of, time_s).walked_m)

    def track(self, of: np.ndarray, time_s: np.ndarray) -> Track:
        """Tracks on the ground, concatenated."""
        point, heading = self.ground_path(of, time_s)
        return Track(np.column_stack([point, self.actors[0].terrain.height_m(*point.T)]), heading)

    def poses(self, of: np.ndarray, time_s: np.ndarray) -> Poses:
        """Bodies in the world, of actors that have the same body and the same posture."""
        first, doing = self.actors[of[0]], self._doing(of, time_s)
        scale, stride, phase = self._gaits[:, of]
        walker = Walker(first.body, scale, stride, phase, self.path(of), first.terrain)
        walked_m = self._start_m[of] + doing.walked_m
        return pose(walker, Motion(walked_m, time_s, doing.pace, doing.head_down, first.posture))

    @cached_property
    def _gaits(self) -> np.ndarray:
        """The scale, the stride_m and the phase of each actor: (3, actors)."""
        walkers = [actor.walker for actor in self.actors]
        return np.array([(walker.scale, walker.stride_m, walker.phase) for walker in walkers]).T

    def _doing(self, of: np.ndarray, time_s: np.ndarray) -> Doing:
        found = np.empty((3, len(of)))
        for part in _runs(self._group[of]):
            first, last = of[part][[0, -1]]
            schedules = [actor.schedule for actor in self.actors[first : last + 1]]
            doing = together(schedules, of[part] - first).at(time_s[part])
            found[:, part] = doing.walked_m, doing.pace, doing.head_down
        return Doing(*found)


def _numbered(keys: Sequence) -> np.ndarray:
    """For each key, the number of changes of keys before it."""
    return np.cumsum([k > 0 and key != keys[k - 1] for k, key in enumerate(keys)])


def _runs(numbers: np.ndarray) -> list[slice]:
    """Slices of an array (n,) with equal numbers."""
    starts = [0, *(np.flatnonzero(np.diff(numbers)) + 1)] if len(numbers) else []
    return [slice(start, stop) for start, stop in zip(starts, [*starts[1:], len(numbers)])]


def _beside(route: Loop | Spot, lateral_m, walked_m) -> tuple[np.ndarray, np.ndarray]:
    """Points (..., n, 2) to the left of a route by a number or numbers (n,), after distances (..., n), and headings."""
    point, heading = route.at(walked_m)
    return point + np.asarray(lateral_m)[..., None] * left_of(heading), heading


def _alone(actor: Actor, time_s: np.ndarray) -> tuple[Company, tuple[np.ndarray, np.ndarray]]:
    """A company of one, and its moments at times (n,)."""
    return Company([actor]), (np.zeros(len(time_s), np.int64), np.asarray(time_s, float))


def track(actor: Actor, time_s: np.ndarray) -> Track:
    """The actor's track on the ground at times (n,)."""
    company, moments = _alone(actor, time_s)
    return company.track(*moments)


def poses(actor: Actor, time_s: np.ndarray) -> Poses:
    """The actor's body in the world at each time (n,)."""
    company, moments = _alone(actor, time_s)
    return company.poses(*moments)


def _telling_moments(actor: Actor) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Distances walked, paces and head_down, each (n,), that sample all poses of a body along its path.

    For walkers, points all along the path and strides around its steepest sections; at each, every state of its
    schedule.
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
    """Distances (n,) along an actor's path: all along it, and strides around its steepest sections."""
    along_m = np.arange(0.0, actor.route.length_m, _STEP_M)
    point, heading = actor.path(along_m)
    slopes = []
    for across in (heading, left_of(heading)):
        ends = [actor.terrain.height_m(*(point + reach * across).T) for reach in (-_STEP_M, _STEP_M)]
        slopes.append(ends[1] - ends[0])
    steepest = [along_m[pick(slope)] for slope in slopes for pick in (np.argmin, np.argmax)]
    around = np.add.outer(steepest, actor.walker.stride_m * np.linspace(-0.5, 0.5, _MOMENTS)).ravel()
    return np.concatenate([np.linspace(0.0, actor.route.length_m, _PLACES), around])
