"""The layers of a map above the ground: areas, paths, groups, names and a legend. Flat shapes, in metres."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.shapes import Mesh, joined
from ..groups.actors import Actor, track
from ..groups.routes import plan_loops
from ..plants.density import plan_density
from ..world import World
from .colours import INK, signal_colours
from .flat_shapes import band, box, disc, filled
from .labels import Anchor, Label, place_labels
from .legend import AREA_OPACITY, AREA_TINTS, LEGEND_WIDTH, MARGIN, FlatLayer, plan_legend

PAPER, PATH_PAPER, UNUSED = "#ffffff", "#fff3c4", "#5a5a5a"
_TINT_CELLS = 800
# Shares of the place's side:
_PATH_WIDTH, _CASING, _BORDER = 0.0022, 0.0042, 0.0014
_FIRST, _MEMBER, _RIM = 0.0055, 0.003, 0.0013
_LETTERS = 0.0145
_PATH_STEP = 0.002


@dataclass(frozen=True)
class MapSheet:
    """A picture of width_m x height_m around centre_m (x, y): layers from bottom to top, with labels on top."""

    width_m: float
    height_m: float
    centre_m: tuple[float, float]
    layers: list[FlatLayer]
    labels: list[Label]


def plan_map(world: World, time_s: float) -> MapSheet:
    """The map of a world, with its actors at a given time."""
    side = world.terrain.size_m
    groups = _groups(world.actors)
    colours = signal_colours([actor.species for actor in world.actors])
    places = {name: _places(members, time_s) for name, members in groups.items()}
    courses = _courses(world, groups)
    dots = [_dots(places[name], colours[members[0].species], side) for name, members in groups.items()]
    labels, paper = _words(places, courses, side)
    legend = plan_legend(world, colours, time_s)
    return MapSheet(
        width_m=(1.0 + 2.0 * MARGIN + LEGEND_WIDTH) * side,
        height_m=(1.0 + 2.0 * MARGIN) * side,
        centre_m=(0.5 * LEGEND_WIDTH * side, 0.0),
        layers=[
            *_tints(world),
            *_path_layers(courses, colours, side),
            *(layer for pair in dots for layer in pair),
            *paper,
            *legend.layers,
        ],
        labels=[*labels, *legend.labels],
    )


def _groups(actors: list[Actor]) -> dict[str, list[Actor]]:
    """Members by group, in the config's order."""
    groups: dict[str, list[Actor]] = {}
    for actor in actors:
        groups.setdefault(actor.group, []).append(actor)
    return groups


def _places(members: list[Actor], time_s: float) -> np.ndarray:
    """Positions (n, 2) of the members of a group."""
    now = np.array([time_s])
    return np.array([track(actor, now).position_m[0, :2] for actor in members])


def _courses(world: World, groups: dict[str, list[Actor]]) -> dict[str, tuple[np.ndarray, str | None]]:
    """Paths by name: points (n, 2), and the species of the first group on it, if any."""
    scene = world.config["scene"]
    loops = plan_loops(scene["paths"], world.terrain, world.config["seed"])
    walkers: dict[str, str] = {}
    for entry in scene["groups"]:
        if "path" in entry:
            first = groups[entry["name"]][0]
            loops.setdefault(entry["path"], first.route)  # the road's loop is not in the config
            walkers.setdefault(entry["path"], first.species)
    return {
        name: (loop.points_m(_PATH_STEP * world.terrain.size_m), walkers.get(name))
        for name, loop in loops.items()
    }


def _tints(world: World) -> list[FlatLayer]:
    """Open and dense areas."""
    terrain = world.terrain
    areas = plan_density(terrain, world.config["scene"]["terrain"], world.config["seed"])
    cell_m = terrain.size_m / _TINT_CELLS
    along_m = cell_m * (np.arange(_TINT_CELLS) + 0.5 - 0.5 * _TINT_CELLS)
    kind = areas.shares(*(axis.ravel() for axis in np.meshgrid(along_m, along_m))).argmax(axis=-1)
    kind = kind.reshape(_TINT_CELLS, _TINT_CELLS)
    return [
        FlatLayer(f"{name} area", colour, filled(kind == k, -0.5 * terrain.size_m, cell_m), AREA_OPACITY)
        for (name, colour), k in zip(AREA_TINTS.items(), (0, 2))
    ]


def _path_layers(courses: dict, colours: dict[str, str], side: float) -> list[FlatLayer]:
    """Paths in the colour of their walkers, on a pale casing, and the scene's border."""
    half = 0.5 * side
    corners = np.array([[-half, -half], [half, -half], [half, half], [-half, half], [-half, -half]])
    casing = [band(points_m, _CASING * side) for points_m, _ in courses.values()]
    return [
        FlatLayer("border", INK, band(corners, _BORDER * side)),
        FlatLayer("path casing", PAPER, joined(casing), 0.6),
        *(
            FlatLayer(f"path {name}", colours.get(species, UNUSED), band(points_m, _PATH_WIDTH * side))
            for name, (points_m, species) in courses.items()
        ),
    ]


def _dots(places_m: np.ndarray, colour: str, side: float) -> tuple[FlatLayer, FlatLayer]:
    """A dot for each member, larger for the first one, with a dark rim."""
    radii_m = [side * (_FIRST if k == 0 else _MEMBER) for k in range(len(places_m))]
    rims = [disc(place, radius_m + _RIM * side) for place, radius_m in zip(places_m, radii_m)]
    dots = [disc(place, radius_m) for place, radius_m in zip(places_m, radii_m)]
    return FlatLayer("rims", PAPER, joined(rims)), FlatLayer("members", colour, joined(dots))


def _words(places: dict, courses: dict, side: float) -> tuple[list[Label], list[FlatLayer]]:
    """Names of groups and paths, with the plates and leader lines below them."""
    clear_m = (_FIRST + _RIM) * side
    dots = [(*(place - clear_m), *(place + clear_m)) for members in places.values() for place in members]
    groups = [Anchor(name, tuple(members[0]), clear_m) for name, members in places.items()]
    paths = [Anchor(name, tuple(_far_from(points_m, places)), 0.0) for name, (points_m, _) in courses.items()]
    labels = place_labels(
        [*groups, *paths], dots, (-0.5 * side, -0.5 * side, 0.5 * side, 0.5 * side), _LETTERS * side
    )
    leaders = [_leader(anchor, label, side) for anchor, label in zip([*groups, *paths], labels)]
    plates = [box(*label.plate_m) for label in labels]
    return labels, [
        FlatLayer("leaders", INK, joined(leaders)),
        FlatLayer("group plates", PAPER, joined(plates[: len(groups)])),
        FlatLayer("path plates", PATH_PAPER, joined(plates[len(groups) :])),
    ]


def _far_from(points_m: np.ndarray, places: dict) -> np.ndarray:
    """The point of a path that is farthest from all groups; its first point if there are none."""
    taken = np.concatenate([np.full((1, 2), np.inf), *places.values()])
    return points_m[np.linalg.norm(points_m[:, None] - taken, axis=-1).min(axis=1).argmax()]


def _leader(anchor: Anchor, label: Label, side: float) -> Mesh:
    """A line from the rim of the named object to the nearest point of its plate."""
    x0, y0, x1, y1 = label.plate_m
    point = np.array(anchor.point_m)
    end = np.clip(point, [x0, y0], [x1, y1])
    apart_m = max(float(np.linalg.norm(end - point)), 1e-9)
    start = point + min(anchor.clear_m / apart_m, 1.0) * (end - point)
    return band(np.array([start, end]), 0.5 * _PATH_WIDTH * side)
