"""Ground that people have changed: packed yards, concrete, fields and foot paths of settlements. Lengths in m."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..geometry.rotations import heading_of
from ..land.covers import FAR_M, Layer, Value
from ..noise import fractal_noise
from .settlement import Settlement

_TRACK_STEP_M = 8.0
_WANDER_RAD = 0.25  # largest turn of a path at each step


def plan_grounds(sites: Sequence[Settlement]) -> list[Layer]:
    """One layer for each material of all sites' grounds, in the order in which their files name them."""
    patches: dict[str, list[Value]] = {}
    for site in sites:
        for number, ground in enumerate(site.rules.get("ground", [])):
            found = patches.setdefault(ground["material"], [])
            found += [_ragged(site, ground, patch) for patch in _patches(site, ground, number)]
    return [Layer(material, _union(values)) for material, values in patches.items()]


def _union(values: Sequence[Value]) -> Value:
    def value(x_m, y_m) -> np.ndarray:
        return np.maximum.reduce([np.full(np.shape(x_m), FAR_M), *(each(x_m, y_m) for each in values)])

    return value


def _patches(site: Settlement, ground: dict, number: int) -> list[Value]:
    rng = site.stream("ground", number)
    if "disc" in ground:
        return [_disc(site.middle_m, ground["disc"] * site.radius_m)]
    if "tracks" in ground:
        return [_track(site, rng, ground["tracks"]) for _ in range(site.count(rng, ground))]
    return [_rectangle(site, rng, ground) for _ in range(site.count(rng, ground))]


def _ragged(site: Settlement, ground: dict, inside_m: Value) -> Value:
    """A patch whose border is uneven by ragged_m; far from it, nothing is computed."""
    ragged_m = ground.get("ragged_m", 0.0)
    if ragged_m == 0.0:
        return inside_m

    def value(x_m, y_m) -> np.ndarray:
        in_m = inside_m(x_m, y_m)
        near = np.abs(in_m) < 2.0 * ragged_m
        noise = fractal_noise(site.seed, f"site/{site.name}", x_m[near], y_m[near], 4.0 * ragged_m, octaves=4)
        in_m[near] += ragged_m * noise
        return in_m

    return value


def _disc(middle_m: np.ndarray, radius_m: float) -> Value:
    return lambda x_m, y_m: np.maximum(radius_m - np.hypot(x_m - middle_m[0], y_m - middle_m[1]), FAR_M)


def _rectangle(site: Settlement, rng: np.random.Generator, ground: dict) -> Value:
    middle_m = site.draw_place(rng, ground.get("ring", (0.0, 0.0)))
    half_m = 0.5 * np.array([rng.uniform(*side) for side in ground["size_m"]])
    cos, sin = np.cos(site.heading_rad), np.sin(site.heading_rad)

    def value(x_m, y_m) -> np.ndarray:
        dx_m, dy_m = x_m - middle_m[0], y_m - middle_m[1]
        along_m, across_m = np.abs(cos * dx_m + sin * dy_m), np.abs(cos * dy_m - sin * dx_m)
        return np.maximum(np.minimum(half_m[0] - along_m, half_m[1] - across_m), FAR_M)

    return value


def _track(site: Settlement, rng: np.random.Generator, tracks: dict) -> Value:
    """A winding strip that leads outward from the middle."""
    half_m = 0.5 * rng.uniform(*tracks["width_m"])
    steps = round(rng.uniform(*tracks["length_m"]) / _TRACK_STEP_M)
    turns = rng.uniform(0.0, 2.0 * np.pi) + np.cumsum(rng.uniform(-_WANDER_RAD, _WANDER_RAD, steps))
    points_m = site.middle_m + _TRACK_STEP_M * np.cumsum(heading_of(turns), axis=0)
    return _strip(np.concatenate([site.middle_m[None], points_m]), half_m)


def _strip(points_m: np.ndarray, half_m: float) -> Callable:
    low_m, high_m = points_m.min(axis=0) + FAR_M, points_m.max(axis=0) - FAR_M

    def value(x_m, y_m) -> np.ndarray:
        off_m = np.full(np.shape(x_m), -FAR_M)
        near = (x_m > low_m[0]) & (x_m < high_m[0]) & (y_m > low_m[1]) & (y_m < high_m[1])
        at_m = np.stack([x_m[near], y_m[near]], axis=-1)
        for start_m, end_m in zip(points_m[:-1], points_m[1:]):
            way_m = end_m - start_m
            share = np.clip((at_m - start_m) @ way_m / (way_m @ way_m), 0.0, 1.0)
            off_m[near] = np.minimum(
                off_m[near], np.linalg.norm(at_m - start_m - share[:, None] * way_m, axis=-1)
            )
        return np.maximum(half_m - off_m, FAR_M)

    return value
