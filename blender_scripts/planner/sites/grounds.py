"""Ground that people have changed: packed yards, concrete, fields and tracks of settlements. Lengths in m."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..geometry.rotations import heading_of, left_of
from ..geometry.splines import Line
from ..land.covers import FAR_M, Layer, Value
from ..land.strands import Strand
from ..land.terrain import Terrain
from ..noise import fractal_noise
from .settlement import Settlement

_TRACK_STEP_M = 8.0
_WANDER_RAD = 0.25  # largest turn of a path at each step
_SKEW, _SKEW_RAD = 0.14, 0.2  # of the half sides, and of the heading: how uneven fields are; estimates
_CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
_FURROW_POINTS, _OFF_ROAD_M = 16, 1.0
_RIDGE_M = 0.35  # half width of what is packed between furrows; estimate
_FURROWED, _LEFT = (0.9, 0.5), (0.6, 0.9)  # its share, how it frays: on fields, on fallow land; estimates


def plan_grounds(sites: Sequence[Settlement]) -> list[Layer]:
    """One layer for each material of all sites' grounds, in the order in which their files name them."""
    patches: dict[str, list[Value]] = {}
    for site in sites:
        for number, ground in enumerate(site.rules.get("ground", [])):
            found = patches.setdefault(ground["material"], [])
            found += [_ragged(site, ground, patch) for patch in _patches(site, ground, number)]
    return [Layer(material, _union(values)) for material, values in patches.items()]


def plan_furrows(sites: Sequence[Settlement], terrain: Terrain) -> list[Strand]:
    """The furrows of all fields, which wind together, from one end of the field to the other, off the road."""
    return [
        strand
        for site in sites
        for number, ground in enumerate(site.rules.get("ground", []))
        if ground.get("furrow_m", 0.0) > 0
        for k, (corners_m, is_fallow) in enumerate(_fields(site, ground, number))
        for strand in _furrows(
            terrain, f"furrows/{site.name}/{number}/{k}", corners_m, ground["furrow_m"], is_fallow
        )
    ]


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
    return [_quad(corners_m) for corners_m, is_fallow in _fields(site, ground, number) if not is_fallow]


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


def _fields(site: Settlement, ground: dict, number: int) -> list[tuple[np.ndarray, bool]]:
    """Corners (4, 2), counter-clockwise, of a ground's rectangles, which are uneven if they have furrows, and whether
    each is fallow.
    """
    rng = site.stream("ground", number)
    skew = 1.0 if ground.get("furrow_m", 0.0) > 0 else 0.0
    found = []
    for _ in range(site.count(rng, ground)):
        middle_m = site.draw_place(rng, ground.get("ring", (0.0, 0.0)))
        half_m = 0.5 * np.array([rng.uniform(*side) for side in ground["size_m"]])
        heading_rad = site.heading_rad + skew * _SKEW_RAD * rng.uniform(-1.0, 1.0)
        off_m = _CORNERS + skew * _SKEW * rng.uniform(-1.0, 1.0, (4, 2))
        along, across = heading_of(heading_rad), left_of(heading_of(heading_rad))
        corners_m = middle_m + (off_m * half_m) @ np.stack([along, across])
        found.append((corners_m, bool(rng.uniform() < ground.get("fallow", 0.0))))
    return found


def _quad(corners_m: np.ndarray) -> Value:
    """Distance to the nearest side of a convex polygon, positive inside."""
    ends_m = np.roll(corners_m, -1, axis=0)
    ways = (ends_m - corners_m) / np.linalg.norm(ends_m - corners_m, axis=1, keepdims=True)

    def value(x_m, y_m) -> np.ndarray:
        left_m = [(y_m - y) * east - (x_m - x) * north for (x, y), (east, north) in zip(corners_m, ways)]
        return np.maximum(np.minimum.reduce(left_m), FAR_M)

    return value


def _furrows(
    terrain: Terrain, name: str, corners_m: np.ndarray, step_m: float, is_fallow: bool
) -> list[Strand]:
    a, b, c, d = corners_m
    count = int(np.linalg.norm(d - a) / step_m)
    share, frays = _LEFT if is_fallow else _FURROWED
    lines = [Line([a + at * (d - a), b + at * (c - b)]) for at in (np.arange(count) + 0.5) / max(count, 1)]
    found = []
    for line in lines:
        points_m = line.at(np.linspace(0.0, line.length_m, _FURROW_POINTS))[0]
        shares = share * (terrain.road_m(*points_m.T) > _OFF_ROAD_M)
        found.append(Strand(line, name, [_RIDGE_M] * _FURROW_POINTS, shares, 0.6, 35.0, frays=frays))
    return found


def _track(site: Settlement, rng: np.random.Generator, tracks: dict) -> Value:
    """A winding strip that leads outward from the middle, and ends in a point."""
    half_m = 0.5 * rng.uniform(*tracks["width_m"])
    steps = max(1, round(rng.uniform(*tracks["length_m"]) / _TRACK_STEP_M))
    turns = rng.uniform(0.0, 2.0 * np.pi) + np.cumsum(rng.uniform(-_WANDER_RAD, _WANDER_RAD, steps))
    points_m = site.middle_m + _TRACK_STEP_M * np.cumsum(heading_of(turns), axis=0)
    widths = rng.uniform(0.7, 1.2, steps + 1) * np.minimum(1.0, 3.0 * (1.0 - np.arange(steps + 1) / steps))
    return _strip(np.concatenate([site.middle_m[None], points_m]), half_m * widths)


def _strip(points_m: np.ndarray, half_m: np.ndarray) -> Value:
    """Distance to the border of a strip through points (n, 2), of half widths (n,), positive inside."""
    low_m, high_m = points_m.min(axis=0) + FAR_M, points_m.max(axis=0) - FAR_M

    def value(x_m, y_m) -> np.ndarray:
        in_m = np.full(np.shape(x_m), FAR_M)
        near = (x_m > low_m[0]) & (x_m < high_m[0]) & (y_m > low_m[1]) & (y_m < high_m[1])
        at_m = np.stack([x_m[near], y_m[near]], axis=-1)
        for start_m, end_m, start_half_m, end_half_m in zip(
            points_m[:-1], points_m[1:], half_m[:-1], half_m[1:]
        ):
            way_m = end_m - start_m
            share = np.clip((at_m - start_m) @ way_m / (way_m @ way_m), 0.0, 1.0)
            off_m = np.linalg.norm(at_m - start_m - share[:, None] * way_m, axis=-1)
            in_m[near] = np.maximum(in_m[near], start_half_m + share * (end_half_m - start_half_m) - off_m)
        return in_m

    return value
