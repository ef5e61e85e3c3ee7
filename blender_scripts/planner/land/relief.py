"""Dry relief: hills, hollows and crags, as functions of position."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.easing import smooth
from ..noise import fractal_noise, lattice_uniform

_HILL_OCTAVES = 5
_HOLLOW_LATTICE_M = 150.0
_HOLLOW_RADII_M = (12.0, 32.0)
_CRAG_WAVELENGTH_M = 1100.0
_CRAG_BORDER = 0.1  # of the noise, over which plain turns into crag: about 50 m
_RAGGED = 0.8  # of the clear distance: irregularity of the crag's foot
_RIDGE_WAVELENGTH_M = 95.0
_STAIRS = 3  # ledges between the foot of a crag and its crest


def hills_m(settings: dict, seed: int, x_m, y_m) -> np.ndarray:
    """Fractal hills whose lowest and highest points are relief_m apart, with mean height 0."""
    raw = fractal_noise(seed, "hills", x_m, y_m, settings["hill_wavelength_m"], _HILL_OCTAVES, gain=0.42)
    span = raw.max() - raw.min()
    return (raw - raw.mean()) * (settings["relief_m"] / span if span > 0 else 0.0)


def hollows_m(depth_m: float, seed: int, x_m, y_m) -> np.ndarray:
    """Dry hollows up to depth_m deep, at most one per lattice cell: shallow depressions and wallows."""
    ix, iy = np.floor(x_m / _HOLLOW_LATTICE_M), np.floor(y_m / _HOLLOW_LATTICE_M)

    def draw(what: str, low: float, high: float) -> np.ndarray:
        return low + (high - low) * lattice_uniform(seed, f"hollow/{what}", ix, iy)

    # A hollow stays inside its cell: its centre is at least the largest radius from the border.
    margin = _HOLLOW_RADII_M[1] / _HOLLOW_LATTICE_M
    dx_m = x_m - _HOLLOW_LATTICE_M * (ix + draw("x", margin, 1.0 - margin))
    dy_m = y_m - _HOLLOW_LATTICE_M * (iy + draw("y", margin, 1.0 - margin))
    inside = np.clip(1.0 - (dx_m**2 + dy_m**2) / draw("radius", *_HOLLOW_RADII_M) ** 2, 0.0, 1.0)
    return -depth_m * draw("depth", 0.0, 1.0) * inside**2


@dataclass(frozen=True)
class Crag:
    """The craggy part of a scene: where a noise is above `threshold`."""

    seed: int
    relief_m: float
    clear_m: float
    threshold: float

    def share(self, x_m, y_m) -> np.ndarray:
        """Share of crag at a position: 0 on the plain, 1 well inside."""
        return smooth(0.5 + (_cragginess(self.seed, self.clear_m, x_m, y_m) - self.threshold) / _CRAG_BORDER)

    def height_m(self, x_m, y_m) -> np.ndarray:
        """Height above the hills: ridges that fall off in ledges."""
        share = self.share(x_m, y_m)
        inside = share > 0
        x_m, y_m = np.broadcast_to(x_m, share.shape)[inside], np.broadcast_to(y_m, share.shape)[inside]
        noise = fractal_noise(self.seed, "ridges", x_m, y_m, _RIDGE_WAVELENGTH_M, octaves=5)
        height = np.zeros(share.shape)
        height[inside] = self.relief_m * share[inside] * _ledges(1.0 - np.clip(2.2 * np.abs(noise), 0.0, 1.0))
        return height


def plan_crag(settings: dict, seed: int, x_m: np.ndarray, y_m: np.ndarray) -> Crag | None:
    """A crag on craggy_fraction of the points x_m, y_m, away from the water in the centre."""
    fraction, relief_m = settings["craggy_fraction"], settings["crag_relief_m"]
    if fraction <= 0:
        return None
    clear_m = 4.0 * settings["water_radius_m"]
    values = _cragginess(seed, clear_m, x_m, y_m)
    return Crag(seed, relief_m, clear_m, float(np.quantile(values, 1.0 - fraction)))


def _cragginess(seed: int, clear_m: float, x_m, y_m) -> np.ndarray:
    """Noise that falls towards the middle, and is far below any threshold near it."""
    x_m, y_m = np.asarray(x_m, float), np.asarray(y_m, float)
    noise = fractal_noise(seed, "crag", x_m, y_m, _CRAG_WAVELENGTH_M, octaves=3)
    if clear_m <= 0:
        return noise
    away = np.sqrt(x_m**2 + y_m**2) / clear_m + _RAGGED * fractal_noise(
        seed, "crag/foot", x_m, y_m, 1.5 * clear_m, octaves=3
    )
    return noise - np.clip(2.5 - away, 0.0, 1.5)


def _ledges(height: np.ndarray) -> np.ndarray:
    """Heights 0..1 quantised smoothly to a few levels: flat treads and steep risers."""
    step = np.floor(height * _STAIRS)
    riser = smooth(2.5 * (height * _STAIRS - step) - 0.75)
    return (0.3 * height * _STAIRS + 0.7 * (step + riser)) / _STAIRS
