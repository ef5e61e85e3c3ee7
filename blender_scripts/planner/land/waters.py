"""Still water: its position, its irregular shore, and its basin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.easing import smooth
from ..noise import fractal_noise

REACH = 2.5  # radii of the water over which the surrounding land blends into its basin
_RAGGEDNESS = 0.45  # of the radius: amplitude of the shoreline's irregularity
_OCTAVES = 3
# In radii, of a circle that contains the water: the octaves of the noise add up to at most 2 - 0.5^(octaves - 1).
_OUTERMOST = 1.0 + _RAGGEDNESS * (2.0 - 0.5 ** (_OCTAVES - 1))
_BANK_M = 0.4  # height of the basin's rim above the water


@dataclass(frozen=True)
class Basin:
    """The basin of water of mean radius radius_m around centre_m (x, y); `name` keys the shape of its shoreline."""

    seed: int
    name: str
    centre_m: tuple[float, float]
    radius_m: float

    @property
    def disc_radius_m(self) -> float:
        """Radius of a disc that contains all of the water and no other ground that low."""
        return (1.0 + 1.2 * _RAGGEDNESS) * self.radius_m

    def shore_m(self, x_m, y_m) -> np.ndarray:
        """Approximate distance to the shoreline, negative in the water."""
        x_m, y_m = np.asarray(x_m, float) - self.centre_m[0], np.asarray(y_m, float) - self.centre_m[1]
        wander = fractal_noise(self.seed, self.name, x_m, y_m, 1.3 * self.radius_m, _OCTAVES)
        return np.sqrt(x_m**2 + y_m**2) + _RAGGEDNESS * self.radius_m * wander - self.radius_m

    def is_wet(self, x_m, y_m) -> np.ndarray:
        """shore_m < 0, skipping the shoreline's noise far from the water."""
        return self.near_shore_m(x_m, y_m, 0.0) < 0

    def near_shore_m(self, x_m, y_m, within_m: float) -> np.ndarray:
        """shore_m where it may be less than within_m; infinite elsewhere, skipping the shoreline's noise."""
        x_m, y_m = np.broadcast_arrays(np.asarray(x_m, float), np.asarray(y_m, float))
        off_m = np.hypot(x_m - self.centre_m[0], y_m - self.centre_m[1])
        near = off_m < _OUTERMOST * self.radius_m + within_m
        shore_m = np.full(x_m.shape, np.inf)
        if near.any():
            shore_m[near] = self.shore_m(x_m[near], y_m[near])
        return shore_m


@dataclass(frozen=True)
class Water:
    """Still water: its basin and the height of its surface."""

    basin: Basin
    level_m: float


def lay_water(basin: Basin, land_m: np.ndarray, x_m, y_m) -> tuple[Water, np.ndarray]:
    """Water in a basin, and the land (with the shape of x_m and y_m) blended into a bowl within REACH radii.

    The bowl crosses the water level at the shoreline. The level is below all land that the bowl blends into, so that no
    ground beyond the shoreline lies below it.
    """
    shore_m = basin.shore_m(x_m, y_m)
    radius_m = basin.radius_m
    # On a coarse grid the basin may contain no vertex; then the nearest ones represent it.
    around = shore_m <= max((REACH - 1) * radius_m, shore_m.min())
    water = Water(basin, float(land_m[around].min()) - _BANK_M)
    out = shore_m / radius_m
    depth_m = min(4.0, 0.1 * radius_m)
    bowl_m = water.level_m + depth_m * np.clip(out, -1.0, 1.0) * (1.0 + 0.5 * np.clip(out, 0.0, 1.0))
    return water, bowl_m + smooth(out / (REACH - 1)) * (land_m - bowl_m)


def surface_m(ground_m, waters: tuple[Water, ...], x_m, y_m) -> np.ndarray:
    """Height of ground or water, whichever is higher; water lies only inside its own basin."""
    for water in waters:
        wet = water.basin.is_wet(x_m, y_m)
        ground_m = np.where(wet, np.maximum(ground_m, water.level_m), ground_m)
    return ground_m


def nearest_shore_m(waters: tuple[Water, ...], x_m, y_m, within_m: float = np.inf) -> np.ndarray:
    """Approximate distance to the nearest shoreline, negative in the water; infinite if there is none within_m."""
    nearest = np.full(np.broadcast(np.asarray(x_m), np.asarray(y_m)).shape, np.inf)
    for water in waters:
        nearest = np.minimum(nearest, water.basin.near_shore_m(x_m, y_m, within_m))
    return nearest
