"""Planes of a renderer in, frames and labels out, in memory."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

import veldt._core as _core
from .datasets import Label
from .home import home
from .runs import Source, document_of


class MadeFrame(NamedTuple):
    """A frame in memory."""

    ir8: NDArray[np.uint8]
    """Grey levels after gain control, (height, width)."""
    ir16: NDArray[np.uint16]
    """Apparent temperature in counts, (height, width)."""
    shutter_closed: bool
    """The picture is the last one before the shutter closed."""
    labels: list[Label]
    """The actors in it."""


class Converter:
    """Converts the planes of one clip in memory, with the results of `veldt convert` for files, bit for bit.

    >>> converter = Converter("passes/manifest.json", "night.json")
    >>> for number, plane in enumerate(index_planes):
    ...     frame = converter.convert(number, object_index=plane)
    """

    def __init__(
        self,
        manifest: Source,
        config: Source | None = None,
        settings: Iterable[str] = (),
    ) -> None:
        """`manifest`: a manifest or its file; its frames need no files. `config`: a config or its file; None: defaults,
        in winter. `settings`: "key=value", as of --set. Faults of the config are reported at the first frame.

        DataError for a manifest, ConfigError for a config that violates its schema; IoError if one cannot be read.
        """
        manifest_text, name = document_of(manifest, "manifest")
        config_text, config_name = (None, "") if config is None else document_of(config, "config")
        self._converter = _core.Converter(
            manifest_text, name, config_text, config_name, list(settings), home()
        )

    def __len__(self) -> int:
        """Number of frames of the manifest."""
        return self._converter.frames

    def convert(
        self,
        number: int,
        object_index: ArrayLike,
        *,
        material_index: ArrayLike | None = None,
        actor_index: ArrayLike | None = None,
        depth_m: ArrayLike | None = None,
        normal: ArrayLike | None = None,
    ) -> MadeFrame:
        """Convert frame `number` of the manifest. Numbers increase; gaps are skipped frames.

        All planes are (height, width) of the manifest's renderer, indices whole from 0 to 32767, of any numeric type;
        normal is (height, width, 3), in world axes; depth_m is along the camera's axis, 1e9 or more for sky. They are
        copied once. The first frame's planes decide which physical terms are kept: a plane that they need must not be
        missing later. DataError for planes of another size, missing planes, and indices that the manifest lacks; the
        camera has then not advanced, and the frame can be converted again. ConfigError for a number that does not
        increase.
        """
        given = {
            "object_index": object_index,
            "material_index": material_index,
            "actor_index": actor_index,
            "depth_m": depth_m,
        }
        planes = {name: plane for name, plane in given.items() if plane is not None}
        if normal is not None:
            axes = _core.numbers(normal, "normal")
            if axes.shape[2:] != (3,):
                raise _core.ConfigError(f"normal = shape {axes.shape}; expected (height, width, 3)")
            planes |= {f"normal_{axis}": axes[..., k] for k, axis in enumerate("xyz")}
        return made_frame(self._converter.convert(number, planes))


def made_frame(made: tuple[NDArray[np.uint8], NDArray[np.uint16], bool, str]) -> MadeFrame:
    """The library's result as a MadeFrame."""
    ir8, ir16, shutter_closed, labels = made
    return MadeFrame(
        ir8, ir16, shutter_closed, [Label.of(each, each.pop("category")) for each in json.loads(labels)]
    )
