"""A planned scene to fly in."""

from __future__ import annotations

from os import PathLike, fspath
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

import veldt._core as _core
from .converter import made_frame
from .datasets import Label
from .home import home


class Actor(NamedTuple):
    """Pose of an actor."""

    category: str
    position_m: tuple[float, float, float]
    """East, north and up, on the ground."""
    heading_rad: float
    """Counter-clockwise from east."""


class Capture(NamedTuple):
    """A captured frame."""

    ir8: NDArray[np.uint8]
    """Grey levels after gain control, (height, width)."""
    ir16: NDArray[np.uint16]
    """Apparent temperature in counts, (height, width)."""
    shutter_closed: bool
    """The picture is the last one before the shutter closed."""
    labels: list[Label]
    """The actors in it."""
    object_index: NDArray[np.uint16]
    """Object index of each pixel, as in passes."""
    depth_m: NDArray[np.float32]
    """Along the camera's axis, 1e10 for sky; (0, 0) if no physical term needs it."""
    actors: dict[int, Actor]
    """Poses of all actors at that time, by track id."""


class Intrinsics(NamedTuple):
    """A pinhole's picture; the middle of the top left pixel is at (0.5, 0.5)."""

    width_px: int
    height_px: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float


class World:
    """A clip's scene, with its actors as planned, and a camera with any pose. The camera's noise, lag, shutter and gain
    control continue from capture to capture.

    >>> veldt.plan("night.json", "plan", settings=["render.posed_actors=all"])
    >>> world = veldt.World("plan", "camp", roam=False)
    >>> for time_s, pose in zip(world.flight_s, world.flight_poses):
    ...     capture = world.capture(pose, time_s)           # the frames of `veldt generate`, bit for bit
    """

    def __init__(
        self,
        plan_folder: str | PathLike[str],
        clip: str,
        *,
        frame_rate_hz: float | None = None,
        roam: bool = True,
    ) -> None:
        """plan_folder: the folder of plan(), from a config with the engine `embree` and render.posed_actors "all".
        frame_rate_hz: of the camera; None: the clip's. roam: whether the camera may leave the planned flight. Without
        it, the ground beyond the flight's view is replicated from its border, and the frames of the flight are those of
        `veldt generate` bit for bit; with it, single pixels round to the next count (0.2 %), and scenes of more than
        180 m a side have coarser ground (25 cm, from 360 m on 50 cm).

        ConfigError for another plan and an unknown clip; DataError and IoError if the plan cannot be read.
        """
        self._world = _core.World(fspath(plan_folder), clip, home(), frame_rate_hz, roam)
        self.flight_s: NDArray[np.float64] = self._world.flight_s
        """Times of the planned flight [s]. Captures are possible from the first to the last."""
        self.flight_poses: NDArray[np.float64] = self._world.flight_poses
        """Its poses (n, 4, 4): from OpenCV's camera axes to east, north, up [m]."""
        self.frame_rate_hz: float = self._world.frame_rate_hz
        self.camera = Intrinsics(*self._world.camera)

    def capture(self, camera_to_world: ArrayLike, time_s: float) -> Capture:
        """The camera's frame from a pose (4, 4) at a time [s], after the previous capture: on the clock of its frame
        rate from flight_s[0] on. Frames in between are skipped. Actors are interpolated between the frames of the
        planned flight.

        ConfigError for another time and for a pose that is not a rotation and a position; nothing has changed then.
        """
        frame, object_index, depth_m, actors = self._world.capture(camera_to_world, time_s)
        return Capture(
            *made_frame(frame),
            object_index,
            depth_m,
            {track: Actor(one[0], tuple(one[1:4]), one[4]) for track, one in actors.items()},
        )

    def restart(self, seed: int | None = None) -> None:
        """Restart at flight_s[0], as if nothing had been captured; in a thirtieth of the time to open a world. seed: of
        a camera of the same kind with other noise; None: the same one.
        """
        self._world.restart(self._world.seed if seed is None else seed)
