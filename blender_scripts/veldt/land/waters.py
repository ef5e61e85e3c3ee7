"""Still water: where it lies, how its shore wanders, and the basin it lies in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.easing import smooth
from ..noise import fractal_noise

REACH = 2.5  # radii of the water over which the land round it gives way to its basin
_RAGGEDNESS = 0.45  # of the radius: how far the shoreline wanders
_BANK_M = 0.4  # the basin's rim stands this much above the water


@dataclass(frozen=True)
class Basin:
    """Where water of about radius_m lies round centre_m (x, y); `name` tells its shoreline from others'."""

    seed: int
    name: str
    centre_m: tuple[float, float]
    radius_m: float

    @property
    def disc_radius_m(self) -> float:
        """Of a disc that holds all of the water and no other ground as low."""
        return (1.0 + 1.2 * _RAGGEDNESS) * self.radius_m

    def shore_m(self, x_m, y_m) -> np.ndarray:
        """About the distance to the shoreline, negative in the water."""
        x_m, y_m = np.asarray(x_m, float) - self.centre_m[0], np.asarray(y_m, float) - self.centre_m[1]
        wander = fractal_noise(self.seed, self.name, x_m, y_m, 1.3 * self.radius_m, octaves=3)
        return np.sqrt(x_m**2 + y_m**2) + _RAGGEDNESS * self.radius_m * wander - self.radius_m


@dataclass(frozen=True)
class Water:
    """A still sheet: its basin and the height of its surface."""

    basin: Basin
    level_m: float


def lay_water(basin: Basin, land_m: np.ndarray, x_m, y_m) -> tuple[Water, np.ndarray]:
    """Water in a basin, and the land (the shape of x_m and y_m) blended within REACH radii into a bowl.

    The bowl crosses the water's level at the shoreline. The level lies under all the land that the bowl blends into,
    so that beyond the shoreline no ground lies below it.
    """
    shore_m = basin.shore_m(x_m, y_m)
    radius_m = basin.radius_m
    # On a coarse grid the basin may lie between all vertices; then the nearest ones stand for it.
    around = shore_m <= max((REACH - 1) * radius_m, shore_m.min())
    water = Water(basin, float(land_m[around].min()) - _BANK_M)
    out = shore_m / radius_m
    depth_m = min(4.0, 0.1 * radius_m)
    bowl_m = water.level_m + depth_m * np.clip(out, -1.0, 1.0) * (1.0 + 0.5 * np.clip(out, 0.0, 1.0))
    return water, bowl_m + smooth(out / (REACH - 1)) * (land_m - bowl_m)


def surface_m(ground_m, waters: tuple[Water, ...], x_m, y_m) -> np.ndarray:
    """Water covers ground lower than its level, but only inside its own basin."""
    for water in waters:
        wet = water.basin.shore_m(x_m, y_m) < 0
        ground_m = np.where(wet, np.maximum(ground_m, water.level_m), ground_m)
    return ground_m


def nearest_shore_m(waters: tuple[Water, ...], x_m, y_m) -> np.ndarray:
    """About the distance to the nearest shoreline, negative in the water; infinite where there is none."""
    nearest = np.full(np.broadcast(np.asarray(x_m), np.asarray(y_m)).shape, np.inf)
    for water in waters:
        nearest = np.minimum(nearest, water.basin.shore_m(x_m, y_m))
    return nearest
