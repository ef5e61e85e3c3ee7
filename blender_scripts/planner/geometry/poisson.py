"""Random points with a minimum distance and a given local density, independent of the order of computation.

Each cell of a lattice has at most one candidate, at a hashed position with a hashed rank. A candidate is kept if no
candidate of higher rank is closer than the spacing (Matérn's second hard-core process). A point therefore depends only
on the seed and on its neighbourhood. The probability that a cell has a candidate follows from the wanted density.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..noise import lattice_uniform
from .neighbours import pairs_within

_FULLEST = 0.6  # fraction of the plane in discs of the spacing; near 1, any number of candidates is too small


def poisson_points(
    seed: int,
    name: str,
    size_m: float,
    spacing_m: float,
    most_per_m2: float,
    per_m2: Callable[[np.ndarray, np.ndarray], np.ndarray],
) -> tuple[np.ndarray, np.ndarray]:
    """Lattice cells (n, 2) and the points (n, 2) in them, within size_m / 2 of the origin in x and y.

    per_m2(x_m, y_m) is the wanted density, clipped to most_per_m2 > 0. Points are at least spacing_m apart, or less if
    most_per_m2 requires it.
    """
    spacing_m *= min(1.0, np.sqrt(fullest_per_m2(spacing_m) / most_per_m2))
    cells, points_m, mark = _candidates(seed, name, size_m, spacing_m, _chance(most_per_m2, spacing_m))
    alive = mark < _chance(per_m2(*points_m.T), spacing_m)
    cells, points_m = cells[alive], points_m[alive]
    rank = lattice_uniform(seed, f"{name}/rank", *cells.T)
    one, other = pairs_within(points_m, points_m, spacing_m)
    stays = (np.abs(points_m) < 0.5 * size_m).all(axis=1)
    stays[one[rank[other] > rank[one]]] = False
    return cells[stays], points_m[stays]


def fullest_per_m2(spacing_m: float) -> float:
    """The largest density at which points can keep a distance."""
    return _FULLEST / (np.pi * spacing_m**2)


def _candidates(seed: int, name: str, size_m: float, cell_m: float, most: float):
    """Cells (n, 2), points (n, 2) and marks (n,), uniform in [0, most), of cells whose mark is below `most`."""
    reach = (
        int(0.5 * size_m / cell_m) + 2
    )  # one cell beyond the square: candidates outside compete with those at its border
    lines = np.arange(-reach, reach)
    ix, iy = (grid.ravel() for grid in np.meshgrid(lines, lines))
    mark = lattice_uniform(seed, f"{name}/mark", ix, iy)
    low = mark < most
    ix, iy, mark = ix[low], iy[low], mark[low]
    x_m = cell_m * (ix + lattice_uniform(seed, f"{name}/x", ix, iy))
    y_m = cell_m * (iy + lattice_uniform(seed, f"{name}/y", ix, iy))
    return np.column_stack([ix, iy]), np.column_stack([x_m, y_m]), mark


def _chance(per_m2, spacing_m: float):
    """Probability p that a cell, of side spacing_m, has a candidate, such that per_m2 points remain.

    A candidate of rank t survives with probability (1 - p (1 - t))^(m - 1), where m = pi is the disc's area in cells,
    one of which is the candidate's own. The mean over t is (1 - (1 - p)^m) / (m p); times p, it is the expected number
    of points per cell. Cells that the disc covers partly cause an error of about 2 % (measured).
    """
    filled = np.minimum(np.pi * per_m2 * spacing_m**2, 0.999)
    return 1.0 - (1.0 - filled) ** (1.0 / np.pi)
