"""The column beside a map with its legend, scale bar and north arrow."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from .. import assets
from ..geometry.shapes import Mesh, joined
from ..plants.plant_shapes import slots_of
from ..world import World
from .colours import INK, mixed, surface_colour
from .flat_shapes import box, polygon
from .labels import Label

AREA_TINTS = {"open": "#ffe9a0", "dense": "#0b4a20"}  # mid areas have no tint
AREA_OPACITY = 0.22
LEGEND_WIDTH, MARGIN = 0.3, 0.02  # shares of the scene's side, like all below
_PAPER = "#f4f1ea"
_SURFACES = ("soil", "grass", "wet_soil", "rock", "road", "water")
_LEFT, _ROW, _LETTERS = 0.03, 0.026, 0.0145
_FOOT = 0.12  # for the scale bar and the arrow


@dataclass(frozen=True)
class FlatLayer:
    """Flat shapes of one colour, #rrggbb, and its opacity."""

    name: str
    colour: str
    mesh: Mesh
    opacity: float = 1.0


@dataclass(frozen=True)
class Legend:
    """The legend's shapes and labels."""

    layers: list[FlatLayer]
    labels: list[Label]


@dataclass(frozen=True)
class _Row:
    """A line of the legend: a text after a colour swatch; without a colour, a heading."""

    text: str
    colour: str | None = None


def plan_legend(world: World, actor_colours: dict[str, str], time_s: float) -> Legend:
    """The legend of a world's map, to the right of the map."""
    side = world.terrain.size_m
    rows = _rows(world, actor_colours, time_s)
    pitch = side * min(_ROW, (1.0 - _FOOT) / len(rows))
    left, top = (0.5 + MARGIN + _LEFT) * side, 0.5 * side
    letters = min(_LETTERS * side, 0.7 * pitch)
    shapes, labels = [], []
    for k, row in enumerate(rows):
        middle = top - (k + 0.5) * pitch
        if row.colour:
            shapes.append(FlatLayer("swatch", row.colour, _swatch(left, middle, letters)))
        indent = 2.2 * letters if row.colour else 0.0
        labels.append(Label(row.text, left + indent, middle, letters))
    foot, words = _foot(side, left, letters)
    paper = FlatLayer("legend", _PAPER, _frame(side))
    return Legend([paper, *shapes, foot], [*labels, *words])


def _rows(world: World, actor_colours: dict[str, str], time_s: float) -> list[_Row]:
    size_m, config = world.terrain.size_m, world.config
    known = {material for material, _ in world.material_indices}
    plants = {name: len(planting.scale) for name, planting in world.plantings.items()}
    actors = Counter(actor.species for actor in world.actors)
    return [
        _Row(config["name"]),
        _Row(f"{size_m:g} x {size_m:g} m"),
        _Row(f'seed {config["seed"]}, at {time_s:g} s'),
        *_section("Ground", [(_words(name), surface_colour(name)) for name in _SURFACES if name in known]),
        *_section("Areas of plants", _areas()),
        *_section(
            "Plants", [(f"{_words(name)}: {count}", _plant_colour(name)) for name, count in plants.items()]
        ),
        *_section(
            "Actors", [(f"{_words(name)}: {actors[name]}", colour) for name, colour in actor_colours.items()]
        ),
    ]


def _section(title: str, entries: list[tuple[str, str]]) -> list[_Row]:
    return [_Row(""), _Row(title), *(_Row(*entry) for entry in entries)] if entries else []


def _areas() -> list[tuple[str, str]]:
    """The areas in approximately the colours of their tints over soil and grass."""
    bare = mixed(surface_colour("soil"), surface_colour("grass"), 0.5)
    tinted = {name: mixed(bare, tint, AREA_OPACITY) for name, tint in AREA_TINTS.items()}
    return [("open", tinted["open"]), ("mid", bare), ("dense", tinted["dense"])]


def _plant_colour(name: str) -> str:
    return surface_colour(slots_of(assets.standing(name))[0][0])


def _words(name: str) -> str:
    return name.replace("_", " ")


def _swatch(left: float, middle: float, letters: float) -> Mesh:
    return box(left, middle - 0.5 * letters, left + 1.5 * letters, middle + 0.5 * letters)


def _frame(side: float) -> Mesh:
    """A frame that hides everything outside the scene."""
    half, edge = 0.5 * side, (0.5 + MARGIN) * side
    right = edge + LEGEND_WIDTH * side
    return joined(
        [
            box(-edge, -edge, -half, edge),
            box(half, -edge, right, edge),
            box(-half, half, half, edge),
            box(-half, -edge, half, -half),
        ]
    )


def _foot(side: float, left: float, letters: float) -> tuple[FlatLayer, list[Label]]:
    """A scale bar of a round length, and a north arrow."""
    length = round_length_m(0.15 * side)
    low = (-0.5 + 0.02) * side
    bar = box(left, low, left + length, low + 0.004 * side)
    ends = [box(x, low - 0.004 * side, x + 0.002 * side, low + 0.008 * side) for x in (left, left + length)]
    x, y = left + (LEGEND_WIDTH - 2.5 * _LEFT) * side, low
    arrow = polygon(np.array([[x - 0.012 * side, y], [x, y + 0.01 * side], [x, y + 0.045 * side]]))
    other = polygon(np.array([[x, y + 0.01 * side], [x + 0.012 * side, y], [x, y + 0.045 * side]]))
    words = [
        Label(f"{length:g} m", left, low + 0.022 * side, letters),
        Label("N", x - 0.35 * letters, y + 0.06 * side, letters),
    ]
    return FlatLayer("scale and north", INK, joined([bar, *ends, arrow, other])), words


def round_length_m(most_m: float) -> float:
    """The largest of 1, 2, 5, 10, 20 … and their tenths that is at most the given length."""
    power = 10.0 ** np.floor(np.log10(most_m))
    return float(max(factor * power for factor in (1, 2, 5) if factor * power <= most_m * (1 + 1e-9)))
