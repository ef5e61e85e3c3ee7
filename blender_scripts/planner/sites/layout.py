"""Positions of a settlement's objects: scattered, in rows, around loops, and beside each other. Lengths in m."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from .. import assets
from ..geometry.rotations import any_heading, heading_of
from ..land.corridors import Corridors
from ..land.terrain import Terrain
from ..noise import stream
from ..plants.placement import Planting
from .settlement import Settlement

_TRIES = 60  # positions tried for each object
_EVERYWHERE = (0.0, 1.0)
_SHORE_M = 1.0
_OFF_ROW = 0.03  # of the step: how far things stand off their row; estimates
_OFF_GRID_RAD, _OFF_FENCE_RAD = 0.1, 0.06
_LOBES, _UNEVEN = 0.12, 0.06  # of a fence's radius


@dataclass(frozen=True, eq=False)
class Standing:
    """A built object: its name among plants and structures, its position (2,), rotation, and scale."""

    name: str
    point_m: np.ndarray
    yaw_rad: float
    scale: float = 1.0

    @property
    def foot_m(self) -> float:
        """Radius of the ground that it needs."""
        return self.scale * assets.standing(self.name)["foot_m"]


@dataclass
class Layout:
    """Objects placed so far in a settlement, and ground that is taken: corridors, water, the road."""

    site: Settlement
    terrain: Terrain
    corridors: Corridors
    things: list[Standing] = field(default_factory=list)

    def is_free(self, thing: Standing) -> bool:
        """Whether an object can stand at its position."""
        apart = all(_apart_m(thing, other) >= thing.foot_m + other.foot_m for other in self.things)
        return apart and self.is_open(thing)

    def is_open(self, thing: Standing) -> bool:
        """Whether the ground of an object is within the scene, dry, off the road and clear of corridors."""
        at_m, foot_m = thing.point_m[None], thing.foot_m
        x_m, y_m = at_m.T
        if np.abs(at_m).max() > 0.5 * self.terrain.size_m - foot_m:
            return False
        if float(self.terrain.shore_m(x_m, y_m)[0]) < _SHORE_M + foot_m:
            return False
        if float(self.terrain.road_m(x_m, y_m)[0]) < foot_m:
            return False
        clear_m = assets.standing(thing.name)["clearance_m"] + foot_m
        return self.corridors.is_clear(at_m, clear_m)

    def add_first_free(self, tries: Iterator[Standing]) -> None:
        """Add the first of some objects that can stand at its position, if any."""
        found = next((thing for thing in tries if self.is_free(thing)), None)
        if found is not None:
            self.things.append(found)


def lay_out(site: Settlement, terrain: Terrain, corridors: Corridors) -> list[Standing]:
    """All objects of a settlement, rule by rule in the order of its file."""
    layout = Layout(site, terrain, corridors)
    for number, rule in enumerate(site.rules["objects"]):
        kind = next((kind for kind in _RULES if kind in rule), "scatter")
        _RULES.get(kind, _scatter)(layout, rule, number)
    return layout.things


def plantings_of(things: Sequence[Standing], terrain: Terrain, seed: int) -> dict[str, Planting]:
    """The objects by name, as plantings; variants are drawn for each."""
    return {
        name: _planting(name, [thing for thing in things if thing.name == name], terrain, seed)
        for name in sorted({thing.name for thing in things})
    }


def _planting(name: str, things: Sequence[Standing], terrain: Terrain, seed: int) -> Planting:
    data, rng = assets.standing(name), stream(seed, f"site/look/{name}")
    points_m = np.array([thing.point_m for thing in things])
    return Planting(
        points_m=np.column_stack([points_m, terrain.height_m(*points_m.T)]),
        yaw_rad=np.array([thing.yaw_rad for thing in things]),
        scale=np.array([thing.scale for thing in things]),
        variant=rng.integers(0, data.get("variants", 1), len(things)),
    )


def _scatter(layout: Layout, rule: dict, number: int) -> None:
    """Single objects anywhere in a ring."""
    site = layout.site
    for k in range(site.count(site.stream("count", number), rule)):
        rng = site.stream("thing", number, k)
        name = _pick(rng, rule["object"])
        layout.add_first_free(
            _facing(site, rng, rule, name, site.draw_place(rng, rule.get("ring", _EVERYWHERE)))
            for _ in range(_TRIES)
        )


def _beside(layout: Layout, rule: dict, number: int) -> None:
    """An object beside a share of those placed by another rule."""
    least_m, most_m = rule.get("gap_m", [0.3, 1.5])
    hosts = [thing for thing in layout.things if thing.name in rule["beside"]]
    for k, host in enumerate(hosts):
        rng = layout.site.stream("thing", number, k)
        if rng.uniform() >= rule.get("share", 1.0):
            continue
        name = _pick(rng, rule["object"])
        most_foot_m = assets.standing(name)["foot_m"] * _scale_range(name)[1]

        def near(rng=rng, host=host, name=name, foot_m=most_foot_m) -> Standing:
            away_m = host.foot_m + foot_m + rng.uniform(least_m, most_m)
            return _facing(layout.site, rng, rule, name, host.point_m + away_m * any_heading(rng))

        layout.add_first_free(near() for _ in range(_TRIES))


def _row(layout: Layout, rule: dict, number: int) -> None:
    """Objects side by side on a straight line, all or those that find space."""
    site, rng = layout.site, layout.site.stream("thing", number)
    step_m, count = rule["row"]["step_m"], site.count(rng, rule)
    best: list[Standing] = []
    for _ in range(_TRIES):
        middle_m = site.draw_place(rng, rule.get("ring", _EVERYWHERE))
        yaw_rad = _grid_yaw(site, rng)
        along = heading_of(yaw_rad)
        turned_rad = yaw_rad + np.radians(rule["row"].get("turn_deg", 0.0))
        off_m = _OFF_ROW * step_m * rng.uniform(-1.0, 1.0, (count, 2))
        points_m = middle_m + (np.arange(count) - 0.5 * (count - 1))[:, None] * step_m * along + off_m
        line = [_standing(rng, _pick(rng, rule["object"]), point_m, turned_rad) for point_m in points_m]
        free = [thing for thing in line if layout.is_free(thing)]
        best = max(best, free, key=len)
        if len(best) == count:
            break
    layout.things += best


def _loop(layout: Layout, rule: dict, number: int) -> None:
    """Segments of a fence around round or rectangular grounds, with a gate and gaps; none in walkers' way."""
    site, loop = layout.site, rule["loop"]
    for k in range(site.count(site.stream("count", number), rule)):
        rng = site.stream("thing", number, k)
        for _ in range(_TRIES):
            middle_m = site.draw_place(rng, rule.get("ring", (0.0, 0.0)))
            radius_m = rng.uniform(*loop["radius_m"])
            inside = [t for t in layout.things if np.linalg.norm(t.point_m - middle_m) < radius_m + t.foot_m]
            if loop.get("around", False) or not inside:
                break
        else:
            continue
        corners_m = middle_m + radius_m * _outline(site, rng, loop)
        segments = list(_segments(rng, corners_m, _pick(rng, rule["object"]), loop["step_m"]))
        gate = int(rng.integers(len(segments)))
        open_count = round(loop.get("gate_m", 0.0) / loop["step_m"])
        broken = rng.uniform(size=len(segments)) < 0.5 * loop.get("gaps", 0.0)
        broken |= np.roll(broken, 1)  # gaps are two segments wide or more
        closed = (np.arange(len(segments)) - gate) % len(segments) >= open_count
        layout.things += [s for s, keep in zip(segments, closed & ~broken) if keep and layout.is_open(s)]


def _outline(site: Settlement, rng: np.random.Generator, loop: dict) -> np.ndarray:
    """Corners (n, 2) of a loop of radius about 1: an uneven ring, or nearly a rectangle along the site's heading."""
    if loop.get("is_rectangle", False):
        high = rng.uniform(0.6, 1.0)
        corners = np.array([[-1.0, -high], [1.0, -high], [1.0, high], [-1.0, high]])
        return (corners + _UNEVEN * rng.uniform(-1.0, 1.0, (4, 2))) @ _turn(site.heading_rad).T
    angle = 2.0 * np.pi * np.arange(18) / 18
    phase_rad = rng.uniform(0.0, 2.0 * np.pi, 2)
    lobes = _LOBES * (np.cos(2 * angle + phase_rad[0]) + np.cos(3 * angle + phase_rad[1]))
    return (1.0 + lobes + _UNEVEN * rng.uniform(-1.0, 1.0, len(angle)))[:, None] * heading_of(angle)


def _segments(
    rng: np.random.Generator, corners_m: np.ndarray, name: str, step_m: float
) -> Iterator[Standing]:
    """Segments of length step_m one after the other, nearly along a closed line."""
    ends_m = np.roll(corners_m, -1, axis=0)
    for start_m, end_m in zip(corners_m, ends_m):
        way_m = end_m - start_m
        count = max(1, round(float(np.linalg.norm(way_m)) / step_m))
        yaws_rad = np.arctan2(way_m[1], way_m[0]) + _OFF_FENCE_RAD * rng.uniform(-1.0, 1.0, count)
        for k, yaw_rad in enumerate(yaws_rad):
            yield _standing(rng, name, start_m + (k + 0.5) / count * way_m, yaw_rad)


def _standing(rng: np.random.Generator, name: str, point_m: np.ndarray, yaw_rad: float) -> Standing:
    """An object with a size drawn from those of its file."""
    return Standing(name, point_m, float(yaw_rad), float(rng.uniform(*_scale_range(name))))


def _scale_range(name: str) -> Sequence[float]:
    return assets.standing(name).get("scale_range", (1.0, 1.0))


def _facing(
    site: Settlement, rng: np.random.Generator, rule: dict, name: str, point_m: np.ndarray
) -> Standing:
    """An object at a position, rotated by its rule: to the centre, along the site's grid, or at random."""
    faces = rule.get("faces", "any")
    if faces == "middle":
        inward = site.middle_m - point_m
        return _standing(rng, name, point_m, np.arctan2(inward[1], inward[0]) + rng.uniform(-0.3, 0.3))
    if faces == "grid":
        return _standing(rng, name, point_m, _grid_yaw(site, rng) + _OFF_GRID_RAD * rng.uniform(-1.0, 1.0))
    return _standing(rng, name, point_m, 2.0 * np.pi * rng.uniform())


def _grid_yaw(site: Settlement, rng: np.random.Generator) -> float:
    return site.heading_rad + 0.5 * np.pi * int(rng.integers(4))


def _pick(rng: np.random.Generator, name: str | Sequence[str]) -> str:
    """A name, or one of several."""
    return name if isinstance(name, str) else name[int(rng.integers(len(name)))]


def _apart_m(one: Standing, other: Standing) -> float:
    return float(np.linalg.norm(one.point_m - other.point_m))


def _turn(angle_rad: float) -> np.ndarray:
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)
    return np.array([[cos, -sin], [sin, cos]])


_RULES = {"beside": _beside, "row": _row, "loop": _loop}
