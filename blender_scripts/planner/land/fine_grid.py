"""The fine grid on which shares of the ground's covers are kept, and the lattice from which smooth maps are refined."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..seen_ground import Seen, everywhere, sampled

FINE_M = 0.5  # largest side of a cell, unless there would be too many
MOST_CELLS = 4096  # along a side
_LATTICE_M = 2.0
_ROWS = 128  # at once, whose values stay in the cache


@dataclass(frozen=True)
class FineGrid:
    """A square of size_m in cells x cells squares, [row of y, column of x], from south and west.

    Its lattice is a coarser grid of lines x lines points, the first and the last on the border. Ground that is not seen
    needs no detail.
    """

    size_m: float
    seen: Seen = everywhere

    @property
    def cells(self) -> int:
        """Cells along a side."""
        return min(MOST_CELLS, int(np.ceil(self.size_m / FINE_M)))

    @property
    def cell_m(self) -> float:
        """Side of a cell."""
        return self.size_m / self.cells

    @cached_property
    def middles_m(self) -> np.ndarray:
        """Coordinates (cells,) of the cells' middles, along x as along y."""
        return ((np.arange(self.cells) + 0.5) / self.cells - 0.5) * self.size_m

    @cached_property
    def lattice_axis_m(self) -> np.ndarray:
        """Coordinates (lines,) of the lattice's points, along x as along y."""
        lines = int(np.ceil(self.size_m / _LATTICE_M)) + 1
        return (np.arange(lines) / (lines - 1) - 0.5) * self.size_m

    def sampled(self, value: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> np.ndarray:
        """Values (lines, lines) of a function of (x_m, y_m) at the lattice's points, exact where they are seen."""
        return sampled(value, self.lattice_axis_m, self.seen)

    @cached_property
    def seen_squares(self) -> np.ndarray:
        """Mask (lines - 1, lines - 1) of the lattice's squares whose middles are seen."""
        middles_m = 0.5 * (self.lattice_axis_m[:-1] + self.lattice_axis_m[1:])
        x_m, y_m = np.meshgrid(middles_m, middles_m)
        return self.seen(x_m.ravel(), y_m.ravel()).reshape(x_m.shape)

    def blocks(self) -> Iterator[slice]:
        """All rows, some at a time."""
        for begin in range(0, self.cells, _ROWS):
            yield slice(begin, min(begin + _ROWS, self.cells))

    def refined(self, values: np.ndarray, rows: slice) -> np.ndarray:
        """Values (lines, lines) of the lattice, interpolated bilinearly at the middles of some rows of cells."""
        low, share = self.below
        down, up = values[low[rows]], values[low[rows] + 1]
        between = down + share[rows, None] * (up - down)
        left = between[:, low]
        return left + share * (between[:, low + 1] - left)

    @cached_property
    def below(self) -> tuple[np.ndarray, np.ndarray]:
        """The lattice's line before each cell (cells,), and the cell's position on the way to the next one, 0..1."""
        lines = len(self.lattice_axis_m)
        place = (np.arange(self.cells) + 0.5) / self.cells * (lines - 1)
        low = np.minimum(place.astype(np.int64), lines - 2)
        return low, place - low


def blurred(values: np.ndarray) -> np.ndarray:
    """Values of a grid, averaged with their neighbours by weights 1, 2, 1 along both axes; borders are extended."""
    for _ in range(2):  # the second turn transposes back
        padded = np.pad(values, ((1, 1), (0, 0)), mode="edge")
        values = (0.25 * (padded[:-2] + padded[2:]) + 0.5 * padded[1:-1]).T
    return values
