"""An uncooled thermal camera: radiance in, frames out."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

import veldt._core as _core
from .band import Band
from .home import home
from .runs import json_of


_LONGEST_REST_S = 86_400


class Exposure(NamedTuple):
    """The camera's output for one frame."""

    ir8: NDArray[np.uint8]
    """Grey levels after gain control, (height, width)."""
    ir16: NDArray[np.uint16]
    """Apparent temperature in counts of `kelvin_per_count`, (height, width)."""
    shutter_closed: bool
    """The picture is the last one before the shutter closed."""


class Camera:
    """One camera through one clip: optics, thermal lag, noise, shutter, bad pixels and gain control continue from frame
    to frame. The same arguments and radiances give the same bits as `veldt generate` for a clip of that id.

    >>> camera = Camera("boson_640_14mm", seed=3)
    >>> frame = camera.expose(numpy.full((512, 640), 40, numpy.float32))
    """

    def __init__(
        self,
        preset: str = "boson_640_14mm",
        *,
        seed: int = 1,
        frame_rate_hz: float = 9,
        clip: str = "clip",
        air_k: float = 293,
        brightest_w_m2_sr: float = 1,
        settings: dict[str, Any] | None = None,
    ) -> None:
        """A preset of assets/sensors, and overrides by sections of a config, such as {"sensor": {"netd_mk": 30}}.

        clip, seed: determine the noise. air_k: temperature around the camera [K]. brightest_w_m2_sr: radiance of level
        255, which only the gain controls `scene_max` and `table_max` of the published model use. ConfigError for
        unknown presets and keys, with the nearest name.
        """
        sections = json.loads(json_of(settings or {}, "settings"))
        sections.setdefault("sensor", {}).setdefault("preset", preset)
        self._camera = _core.Camera(
            json_of(sections, "settings"), home(), clip, seed, frame_rate_hz, air_k, brightest_w_m2_sr
        )
        self._frame_rate_hz = frame_rate_hz
        self._next = 0

    def expose(self, radiance_w_m2_sr: ArrayLike, time_s: float | None = None) -> Exposure:
        """The picture of the next frame, from radiance [W m^-2 sr^-1] of shape (height_px, width_px), which is copied
        once, as single precision. NaN and negative radiance count as 0.

        time_s: of the frame, from the first one at 0. Frames in between are skipped: noise and shutter advance, lag and
        gain control do not. ConfigError unless it is the next frame's time or later, by a day at most, on the clock of
        the frame rate.
        """
        if time_s is not None:
            self._skip_to(time_s)
        exposure = Exposure(*self._camera.expose(radiance_w_m2_sr))
        self._next += 1
        return exposure

    def temperature_k(self, radiance_w_m2_sr: float) -> float:
        """Apparent temperature [K] of a radiance, as in ir16 before rounding."""
        return self._camera.temperature_k(radiance_w_m2_sr)

    @property
    def band(self) -> Band:
        """The camera's spectral response."""
        return Band(response=self._camera.response)

    @property
    def width_px(self) -> int:
        """Width of its pictures."""
        return self._camera.width_px

    @property
    def height_px(self) -> int:
        """Height of its pictures."""
        return self._camera.height_px

    @property
    def kelvin_per_count(self) -> float:
        """Step of ir16 [K]."""
        return self._camera.kelvin_per_count

    def _skip_to(self, time_s: float) -> None:
        time_s = _core.finite_number(time_s, "time_s")
        frame = round(time_s * self._frame_rate_hz)
        on_clock = abs(frame - time_s * self._frame_rate_hz) < 1e-3
        if not on_clock or not 0 <= frame - self._next <= _LONGEST_REST_S * self._frame_rate_hz:
            raise _core.ConfigError(
                f"time_s = {time_s:g} s; expected a multiple of 1/{self._frame_rate_hz:g} s from "
                f"{self._next / self._frame_rate_hz:g} s on, and within a day"
            )
        for _ in range(frame - self._next):
            self._camera.skip()
        self._next = frame
