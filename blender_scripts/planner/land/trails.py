"""Game trails to water and foot paths to where people live, over gentle ground; they join. Lengths in m."""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.rotations import any_heading
from ..geometry.splines import Line
from ..noise import fractal_noise, lattice_uniform, stream
from .strands import Strand
from .terrain import Terrain

_NODE_M = 11.0  # distance between nodes
_MOST_LINES = 180  # of nodes along a side
_JITTER = 0.36  # of the distance between nodes
_THICKET_M, _THICK = 70.0, 0.8  # size of ground that trails avoid, and by how much; estimates
_STEEP = 40.0  # a grade of 16 % doubles the cost of a way; estimate
_FROM_M = 190.0  # between random starts of trails, some of which have none
_FROM_SHARE = 0.6
_WINDING_M = 24.0
_BEGINS = (0.15, 0.45, 0.8)  # of the usual share: trails begin faint, because animals come from all sides
_BORDER_M = 8.0
_NEIGHBOURS = [(dx, dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if dx or dy]
# By strand: least traffic for it, and how far it strays; trails of many animals are braided.
_BRAIDS = ((1.0, 2.2), (3.0, 3.6), (7.0, 5.0))
_ON_FOOT = ((1.0, 0.7),)
_NEIGHBOURS_M = 600.0  # how far foot paths lead; this and the next two are estimates
_ERRANDS, _ERRANDS_M = 5, (1.2, 4.0)  # ways out into the land, in radii of a place


@dataclass(frozen=True)
class Place:
    """Where people live: foot paths lead there."""

    name: str
    middle_m: np.ndarray
    radius_m: float


@dataclass(frozen=True)
class _Ways:
    """Steps between nodes (lines x lines) at positions (n, 2): their costs by neighbour, (n,) each."""

    lines: int
    points_m: np.ndarray
    costs: list[list[float]]


def plan_trails(
    terrain: Terrain, sources_m: Sequence[np.ndarray], places: Sequence[Place], seed: int
) -> list[Strand]:
    """Trails from points (n, 2), and from random ones, to the nearest water by easy ways, and foot paths to places from
    those after them, the road, the water, and random points nearby.
    """
    if not terrain.waters and not places:
        return []
    ways, strands = _plan_ways(terrain, seed), []
    if terrain.waters:
        shore_m = terrain.shore_m(*ways.points_m.T)
        wet = np.flatnonzero(shore_m <= max(shore_m.min(), 0.0))  # the pan may lie between nodes
        begins_m = [*sources_m, *_random_places(terrain, seed)]
        strands += _joined(ways, terrain.size_m, wet, begins_m, "trails", _BRAIDS)
    for k, place in enumerate(places):
        near_m = list(_near(terrain, place, places[k + 1 :], seed))
        sink = _nodes_at(ways, terrain.size_m, [place.middle_m])
        strands += _joined(ways, terrain.size_m, sink, near_m, f"paths/{place.name}", _ON_FOOT)
    return strands


def _near(terrain: Terrain, place: Place, others: Sequence[Place], seed: int) -> Iterator[np.ndarray]:
    """Points (2,) from which paths lead to a place."""
    found = [other.middle_m for other in others]
    found += [np.array(water.basin.centre_m) for water in terrain.waters]
    for points_m in () if terrain.road is None else terrain.road.points_m:
        found.append(points_m[((points_m - place.middle_m) ** 2).sum(axis=1).argmin()])
    yield from (at_m for at_m in found if ((at_m - place.middle_m) ** 2).sum() < _NEIGHBOURS_M**2)
    rng = stream(seed, f"paths/{place.name}")
    for _ in range(_ERRANDS):
        yield place.middle_m + place.radius_m * rng.uniform(*_ERRANDS_M) * any_heading(rng)


def _joined(
    ways: _Ways, size_m: float, sinks: Sequence[int], begins_m: Sequence[np.ndarray], name: str, braids
) -> list[Strand]:
    """Strands from points (n, 2) to the nearest of some nodes."""
    following, begins = _nearest_sinks(ways, list(sinks)), _nodes_at(ways, size_m, begins_m)
    traffic = _traffic(following, begins)
    points_m = _smoothed(ways.points_m, following, traffic)
    return [
        strand
        for course in _courses(following, begins)
        if len(course) > 2
        for strand in _strands(points_m[course], traffic[course], name, braids)
    ]


def _plan_ways(terrain: Terrain, seed: int) -> _Ways:
    """Steps over a jittered grid, dear on slopes and in thickets."""
    lines = min(_MOST_LINES, max(4, round((terrain.size_m - 2.0 * _BORDER_M) / _NODE_M)))
    points_m = _nodes_m(lines, terrain.size_m, seed)
    x_m, y_m = points_m.T
    height_m = terrain.height_m(x_m, y_m)
    dear = 1.0 + _THICK * np.clip(fractal_noise(seed, "trails/thick", x_m, y_m, _THICKET_M, 3), -1.0, 1.0)
    costs = [_step_costs(points_m, height_m, dear, lines, dx + dy * lines).tolist() for dx, dy in _NEIGHBOURS]
    return _Ways(lines, points_m, costs)


def _nodes_m(lines: int, size_m: float, seed: int) -> np.ndarray:
    iy, ix = (index.ravel() for index in np.indices((lines, lines)))
    shift = [_JITTER * (2.0 * lattice_uniform(seed, f"trails/{axis}", ix, iy) - 1.0) for axis in "xy"]
    step_m = (size_m - 2.0 * _BORDER_M) / (lines - 1)
    return (np.column_stack([ix + shift[0], iy + shift[1]]) - 0.5 * (lines - 1)) * step_m


def _step_costs(points_m: np.ndarray, height_m: np.ndarray, dear: np.ndarray, lines: int, to: int):
    """The cost (n,) of the step from each node to the one `to` indices later; invalid where it leaves the grid."""
    other = np.clip(np.arange(lines * lines) + to, 0, lines * lines - 1)
    way_m = points_m[other] - points_m
    length_m = np.sqrt(way_m[:, 0] * way_m[:, 0] + way_m[:, 1] * way_m[:, 1])
    grade = (height_m[other] - height_m) / np.maximum(length_m, 1e-9)
    return length_m * (dear + dear[other]) * (1.0 + _STEEP * grade * grade)


def _nearest_sinks(ways: _Ways, sinks: list[int]) -> np.ndarray:
    """The next node (n,) on the cheapest way from each node to a sink, or the node itself (Dijkstra 1959)."""
    lines = ways.lines
    total, following = [np.inf] * (lines * lines), list(range(lines * lines))
    for node in sinks:
        total[node] = 0.0
    heap = [(0.0, node) for node in sinks]
    while heap:
        cost, node = heapq.heappop(heap)
        if cost > total[node]:
            continue
        y, x = divmod(node, lines)
        for (dx, dy), step in zip(_NEIGHBOURS, ways.costs):
            if 0 <= x + dx < lines and 0 <= y + dy < lines:
                other = node + dx + dy * lines
                if cost + step[node] < total[other]:
                    total[other], following[other] = cost + step[node], node
                    heapq.heappush(heap, (total[other], other))
    return np.array(following)


def _random_places(terrain: Terrain, seed: int) -> np.ndarray:
    """Points (n, 2) spread over the ground, at most one in each square of a lattice."""
    reach = int(np.ceil(0.5 * terrain.size_m / _FROM_M))
    iy, ix = (index.ravel() - reach for index in np.indices((2 * reach, 2 * reach)))
    drawn = [lattice_uniform(seed, f"trails/from/{axis}", ix, iy) for axis in ("x", "y", "is")]
    places_m = _FROM_M * np.column_stack([ix + drawn[0], iy + drawn[1]])
    fit = (drawn[2] < _FROM_SHARE) & (np.abs(places_m).max(axis=1) < 0.5 * terrain.size_m)
    return places_m[fit]


def _nodes_at(ways: _Ways, size_m: float, places_m: Sequence[np.ndarray]) -> list[int]:
    step_m = (size_m - 2.0 * _BORDER_M) / (ways.lines - 1)
    place = np.rint(np.asarray(places_m).reshape(-1, 2) / step_m + 0.5 * (ways.lines - 1)).astype(np.int64)
    column, row = np.clip(place, 0, ways.lines - 1).T
    return (row * ways.lines + column).tolist()


def _traffic(following: np.ndarray, begins: Sequence[int]) -> np.ndarray:
    """Number of trails through each node."""
    traffic = np.zeros(len(following))
    for node in begins:
        while following[node] != node:
            traffic[node] += 1.0
            node = following[node]
        traffic[node] += 1.0
    return traffic


def _smoothed(points_m: np.ndarray, following: np.ndarray, traffic: np.ndarray) -> np.ndarray:
    """Nodes moved towards the midpoint between the node before, by which most trails come, and the next."""
    nodes = np.flatnonzero(traffic > 0)
    before = np.arange(len(traffic))
    for node in nodes[np.argsort(traffic[nodes], kind="stable")]:
        if following[node] != node:
            before[following[node]] = node
    for _ in range(2):
        points_m = 0.5 * points_m + 0.25 * (points_m[before] + points_m[following])
    return points_m


def _courses(following: np.ndarray, begins: Sequence[int]) -> list[list[int]]:
    """Nodes of each trail, to its sink or to the second node of a trail that it joins."""
    done = np.zeros(len(following), bool)
    courses = []
    for node in begins:
        course = [node]
        while not done[node] and following[node] != node:
            done[node] = True
            node = int(following[node])
            course.append(node)
        if following[node] != node:
            course.append(int(following[node]))
        courses.append(course)
    return courses


def _strands(points_m: np.ndarray, traffic: np.ndarray, name: str, braids) -> list[Strand]:
    """One or more strands along a trail; bare and wide where many trails have joined."""
    curve = Line(points_m)
    worn = traffic / (traffic + 2.0)
    begins = np.append(_BEGINS, np.ones(len(traffic)))[: len(traffic)]
    return [
        Strand(
            curve,
            f"{name}/{k}",
            half_width_m=0.15 + 0.15 * worn,
            share=(0.5 + 0.5 * worn) * (traffic >= least) * begins,
            wander_m=wander_m,
            wavelength_m=_WINDING_M,
        )
        for k, (least, wander_m) in enumerate(braids)
        if traffic.max() >= least
    ]
