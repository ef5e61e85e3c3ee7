"""A Gymnasium environment to fly in a scene; needs Gymnasium."""

from __future__ import annotations

from os import PathLike
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from .poses import pose_looking
from .world import Capture, World

_STEEPEST_RAD = np.pi / 2
_SPEEDS = 3  # of an action: forward, right and up; the others are rates of turning left and down


class FlightEnv(gymnasium.Env[NDArray[np.uint8], NDArray[np.float32]]):
    """Fly a camera over a planned clip, and keep actors in view.

    Action: five numbers from -1 to 1: speeds forward, to the right and up, as shares of max_speed_m_s, and rates of
    turning left and of looking further down, as shares of max_turn_rad_s. Observation: the 8-bit frame (height, width).
    Reward: the share of the followed actors that are labelled in the frame, 0 to 1. An episode begins with the planned
    flight's first pose, and is truncated when the plan's time is over. It never terminates before.

    `gymnasium.make("Veldt/Flight-v0", plan_folder=…, clip=…)` works once this module is imported. `info` has `capture`:
    the whole Capture, and `camera_to_world`.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 9}

    def __init__(
        self,
        plan_folder: str | PathLike[str],
        clip: str,
        *,
        follow: str = "human",
        max_speed_m_s: float = 15,
        max_turn_rad_s: float = 1,
        least_height_m: float = 20,
        frame_rate_hz: float | None = None,
        render_mode: str | None = None,
    ) -> None:
        """plan_folder, clip, frame_rate_hz: as World's. follow: the category to keep in view. least_height_m: lower
        limit of the camera's height above the lowest actor.
        """
        self._world = World(plan_folder, clip, frame_rate_hz=frame_rate_hz)
        self._follow = follow
        self._rates = np.array([max_speed_m_s] * _SPEEDS + [max_turn_rad_s] * 2)
        self._least_height_m = least_height_m
        self.metadata = self.metadata | {"render_fps": self._world.frame_rate_hz}
        self.render_mode = render_mode
        self.action_space = gymnasium.spaces.Box(-1, 1, (len(self._rates),), np.float32)
        shape = (self._world.camera.height_px, self._world.camera.width_px)
        self.observation_space = gymnasium.spaces.Box(0, 255, shape, np.uint8)
        self._frame = 0
        self._place_m = np.zeros(3)
        self._heading_rad = self._down_rad = 0.0
        self._capture: Capture | None = None

    @property
    def world(self) -> World:
        """The world that it flies in."""
        return self._world

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.uint8], dict[str, Any]]:
        """Start at the planned flight's first pose. The seed is the camera's."""
        super().reset(seed=seed, options=options)
        self._world.restart(seed)
        pose = self._world.flight_poses[0]
        forward = pose[:3, 2]
        self._frame = 0
        self._place_m = pose[:3, 3].copy()
        self._down_rad = float(np.arcsin(np.clip(-forward[2], -1, 1)))
        # Looking straight down, the top of the picture is the heading.
        ahead = forward if np.hypot(*forward[:2]) > 1e-6 else -pose[:3, 1]
        self._heading_rad = float(np.arctan2(ahead[1], ahead[0]))
        return self._take()

    def step(
        self, action: NDArray[np.float32]
    ) -> tuple[NDArray[np.uint8], float, bool, bool, dict[str, Any]]:
        """Move for one frame, and capture the next."""
        moved = np.clip(action, -1, 1) * self._rates / self._world.frame_rate_hz
        cos, sin = np.cos(self._heading_rad), np.sin(self._heading_rad)
        self._place_m += [moved[0] * cos + moved[1] * sin, moved[0] * sin - moved[1] * cos, moved[2]]
        self._heading_rad = float(np.remainder(self._heading_rad + moved[3], 2 * np.pi))
        self._down_rad = float(np.clip(self._down_rad + moved[4], -_STEEPEST_RAD, _STEEPEST_RAD))
        if self._capture is not None and self._capture.actors:
            lowest_m = min(actor.position_m[2] for actor in self._capture.actors.values())
            self._place_m[2] = max(self._place_m[2], lowest_m + self._least_height_m)
        self._frame += 1
        observation, info = self._take()
        return observation, self._reward(), False, self._is_over(), info

    def render(self) -> NDArray[np.uint8] | None:
        """The last frame as grey RGB (height, width, 3)."""
        if self.render_mode is None or self._capture is None:
            return None
        return np.repeat(self._capture.ir8[:, :, None], 3, axis=2)

    def _take(self) -> tuple[NDArray[np.uint8], dict[str, Any]]:
        pose = pose_looking(self._place_m, self._heading_rad, self._down_rad)
        self._capture = self._world.capture(pose, self._time_s(self._frame))
        return self._capture.ir8, {"capture": self._capture, "camera_to_world": pose}

    def _time_s(self, frame: int) -> float:
        return float(self._world.flight_s[0] + frame / self._world.frame_rate_hz)

    def _is_over(self) -> bool:
        return bool(self._time_s(self._frame + 1) > self._world.flight_s[-1] + 1e-9)

    def _reward(self) -> float:
        followed = [actor for actor in self._capture.actors.values() if actor.category == self._follow]
        seen = {label.track_id for label in self._capture.labels if label.category == self._follow}
        return len(seen) / len(followed) if followed else 0.0


gymnasium.register("Veldt/Flight-v0", entry_point=FlightEnv)
