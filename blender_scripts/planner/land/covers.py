"""Ground covers: dry soil with grass, wet margins, rock and the road on it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..noise import fractal_noise
from .roads import TRACK_M
from .terrain import Terrain

SOIL, GRASS = "soil", "grass"

_GRASS_OCTAVES = 5
_STRETCH, _STRETCHES = 16.0, 1.8  # size, in patches, of stretches with little but grass or soil; their weight
_WORN_M, _WORN_ALONG_M = 1.0, 40.0  # how far, and over what length, a road's borders wander; estimates
_STRIP_M, _STRIP_MORE_M, _STRIP_ALONG_M = 0.2, 0.8, 60.0  # half of what grows between the wheels; estimates
_BETWEEN_M = TRACK_M - 0.25  # beside it, the wheels keep the ground bare
_END_M = 30.0  # over which a road that ends narrows; estimate
_BARE_MARGIN_M = 5.0  # bare margin around the water
_WET_MARGIN_M = 2.5  # wet part of it; both are estimates
_WET_RAGGED_M = 1.5
_OUTCROP_M = 14.0  # size of outcrops
_OUTCROPS = 0.85  # higher values leave less rock on the crag

FAR_M = -100.0  # instead of infinity off the road, so that borders can be interpolated between two points
_NEAR_M = 10.0  # from a shore: beyond its wet margin

Value = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Layer:
    """A material that lies where `value` (x_m, y_m), which is continuous, is positive."""

    material: str
    value: Value


def plan_covers(terrain: Terrain, settings: dict, seed: int, grounds: Sequence[Layer] = ()) -> list[Layer]:
    """The layers on the dry soil of a terrain; where they overlap, the first one wins. No grass grows on `grounds`."""
    layers = []
    if terrain.road is not None:
        layers.append(Layer("road", lambda x_m, y_m: _worn_road(terrain, seed, x_m, y_m)))
    if terrain.waters:
        layers.append(Layer("wet_soil", lambda x_m, y_m: _wetness(terrain, seed, x_m, y_m)))
    if terrain.crag is not None:
        layers.append(Layer("rock", lambda x_m, y_m: _rockiness(terrain, seed, x_m, y_m)))
    layers += grounds
    grass = _plan_grass(terrain, settings, seed)
    return layers if grass is None else [*layers, Layer(GRASS, grass)]


def _worn_road(terrain: Terrain, seed: int, x_m, y_m) -> np.ndarray:
    """The bare ground of a road: without ragged verges, and without what grows between the wheels in places."""
    road, value = terrain.road, np.full(np.shape(x_m), FAR_M)
    off_m = terrain.road_m(x_m, y_m)
    near = np.isfinite(off_m)
    x_m, y_m, off_m = x_m[near], y_m[near], off_m[near]
    worn_m = _WORN_M * fractal_noise(seed, "road/worn", x_m, y_m, _WORN_ALONG_M, octaves=6, gain=0.6)
    if road.spur is not None:
        end_x_m, end_y_m = road.points_m[-1][-1]
        before_m = np.sqrt((x_m - end_x_m) ** 2 + (y_m - end_y_m) ** 2)
        worn_m -= (0.5 * road.width_m + _WORN_M) * np.clip(1.0 - before_m / _END_M, 0.0, 1.0)
    strip_m = _STRIP_M + _STRIP_MORE_M * fractal_noise(
        seed, "road/strip", x_m, y_m, _STRIP_ALONG_M, octaves=5
    )
    value[near] = np.minimum(worn_m - off_m, off_m + 0.5 * road.width_m - np.minimum(strip_m, _BETWEEN_M))
    return value


def _wetness(terrain: Terrain, seed: int, x_m, y_m) -> np.ndarray:
    shore_m = terrain.shore_m(x_m, y_m, _NEAR_M + 2.0 * terrain.cell_m)  # to the far corners of triangles
    ragged_m = _WET_RAGGED_M * fractal_noise(seed, "wet", x_m, y_m, 4.0 * _WET_RAGGED_M, octaves=2)
    return np.maximum(_WET_MARGIN_M + ragged_m - shore_m, FAR_M)


def _rockiness(terrain: Terrain, seed: int, x_m, y_m) -> np.ndarray:
    outcrops = fractal_noise(seed, "outcrops", x_m, y_m, 2.0 * _OUTCROP_M, octaves=4)
    return terrain.crag.share(x_m, y_m) + outcrops - _OUTCROPS


def _plan_grass(terrain: Terrain, settings: dict, seed: int) -> Value | None:
    """Patches that cover grass_fraction of the dry ground, except where the margin of the water is bare."""
    x_m, y_m = terrain.samples()
    patch_m = settings["grass_patch_m"]
    shore_m = terrain.shore_m(x_m, y_m, 2.0 * _BARE_MARGIN_M)
    can_grow = shore_m > _BARE_MARGIN_M
    if settings["grass_fraction"] <= 0 or not can_grow.any():
        return None
    share = settings["grass_fraction"] * np.count_nonzero(shore_m > 0) / np.count_nonzero(can_grow)
    values = _patches(seed, patch_m, x_m[can_grow], y_m[can_grow])
    threshold = float(np.quantile(values, 1.0 - share)) if share < 1.0 else -np.inf

    near_m = _BARE_MARGIN_M + 6.0 * patch_m  # farther away, the margin cannot be less than the patches' value

    def value(x_m, y_m) -> np.ndarray:
        margin = (terrain.shore_m(x_m, y_m, near_m) - _BARE_MARGIN_M) / patch_m
        return np.minimum(np.minimum(_patches(seed, patch_m, x_m, y_m) - threshold, margin), 1e3)

    return value


def _patches(seed: int, patch_m: float, x_m, y_m) -> np.ndarray:
    stretches = fractal_noise(seed, "cover/stretch", x_m, y_m, _STRETCH * patch_m, octaves=2)
    patches = fractal_noise(seed, "cover", x_m, y_m, 2.0 * patch_m, _GRASS_OCTAVES, gain=0.5)
    return _STRETCHES * stretches + patches
