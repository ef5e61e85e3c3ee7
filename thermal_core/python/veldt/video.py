"""Effects of cameras and video links on pictures after the detector, drawn for each picture of a training set."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import veldt._core as _core
from .home import home
from .runs import json_of


class VideoChain:
    """Noise of a detector, a noise filter, an unsharp mask and an analogue link for 8-bit pictures, with the code and
    the keys of a config's `sensor.processing` and `output.link`. All values may be distributions.

    >>> chain = VideoChain({
    ...     "noise_levels": {"uniform": [0, 20]},
    ...     "processing": {"noise_filter_sigma_px": {"uniform": [0, 0.9]}, "unsharp_amount": {"uniform": [0, 1.5]}},
    ...     "link": {"choice": [None, {"standard": "pal", "noise_levels": {"uniform": [0, 8]}}]},
    ...     "field_motion_px": {"choice": [0, {"uniform": [-3, 3]}]},
    ... })
    >>> picture = chain(numpy.full((512, 640), 128, numpy.uint8))
    """

    def __init__(self, settings: Mapping[str, Any], *, seed: int = 1) -> None:
        """settings: any of `noise_levels` (0 to 100), the deviation of white noise that is added first, in levels;
        `processing`; `link`; and `field_motion_px` (-100 to 100), the motion to the right from even rows to odd ones.
        ConfigError for unknown keys, values out of range, and invalid distributions.
        """
        self._chain = _core.VideoChain(json_of(dict(settings), "settings"), home(), seed)
        self._next = 0

    def __call__(self, picture: ArrayLike, number: int | None = None) -> NDArray[np.uint8]:
        """A copy of a picture (height, width) of numpy.uint8, through a chain drawn for it.

        number: 0 to 2^32 - 1, determines the draw and all noise, together with the seed; set it if several processes
        load one set. None: one more than in the call before. ConfigError for pictures of another type or shape.
        """
        if number is None:
            number = self._next
        self._next = number + 1
        return self._chain.pass_through(picture, number)
