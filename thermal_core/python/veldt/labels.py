"""Labels of index planes."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

import veldt._core as _core


class Instance:
    """One actor in one frame: the exact pixels that carry its index."""

    def __init__(self, found: _core.Instance, shape: tuple[int, int]) -> None:
        """Made by instances()."""
        self._found = found
        self._shape = shape

    @property
    def index(self) -> int:
        """Its number in the index plane."""
        return self._found.index

    @property
    def box_px(self) -> tuple[int, int, int, int]:
        """Its bounding box: x, y, width and height in whole pixels, 0-based from the top left."""
        return self._found.box_px

    @property
    def area_px(self) -> int:
        """Number of its pixels."""
        return self._found.area_px

    @property
    def truncated(self) -> bool:
        """Whether it touches the border of the frame."""
        return self._found.truncated

    @property
    def rle(self) -> str:
        """Its mask as COCO's compressed run lengths."""
        return self._found.rle

    def mask(self) -> NDArray[np.bool_]:
        """Its pixels, (height, width)."""
        height_px, width_px = self._shape
        return _core.mask_of(self.rle, width_px, height_px)


def instances(index_plane: ArrayLike, actors: Iterable[int]) -> list[Instance]:
    """The actors of an index plane (height, width) with their boxes and masks, in ascending order of index.

    index_plane: numbers of any type. actors: indices to label. DataError for the first number that is not whole, from 0
    to 32767, Blender's limit.
    """
    listed = list(actors)
    found = _core.instances(index_plane, [listed] if listed else None)
    return [Instance(each, np.shape(index_plane)) for each in found]
