"""Fine maps of what lies on the ground, of grass and of ash."""

import numpy as np
import pytest

from lands import SEED, WILD, small_land
from planner.land.covers import Layer
from planner.land.fine_covers import BORDER_CELLS, lay_ash, lay_grass, lay_kinds
from planner.land.fine_grid import MOST_CELLS, FineGrid


@pytest.fixture(scope="module", name="wild")
def _wild():
    return small_land(**WILD)


def _topmost(layers, x_m, y_m):
    """The number of the topmost layer at each place, from the values of all layers."""
    top = np.zeros(x_m.shape, int)
    for number, layer in reversed(list(enumerate(layers, start=1))):
        top[layer.value(x_m, y_m) > 0] = number
    return top


def test_cells_are_half_a_metre_or_less_and_not_too_many():
    assert FineGrid(241).cells == 482 and FineGrid(240.2).cells == 481
    assert FineGrid(240.2).cell_m <= 0.5
    assert FineGrid(5000).cells == MOST_CELLS


def test_kinds_are_the_topmost_covers_of_all_layers(wild):
    _, layers, grid = wild
    kind, _ = lay_kinds(grid, layers)
    top = _topmost(layers, *np.meshgrid(grid.middles_m, grid.middles_m))
    names = ["soil", *(layer.material for layer in layers)]
    top[top == names.index("grass")] = 0
    assert set(np.unique(kind)) == {0, 1, 2, 3}  # road, wet soil and rock
    assert np.array_equal(kind, top)


def test_a_path_narrower_than_the_lattice_is_found():
    _, _, grid = small_land(water_radius_m=0)
    path = Layer("yard", lambda x_m, y_m: np.maximum(0.3 - np.abs(x_m - 0.37 * y_m - 1.1), -100.0))
    kind, _ = lay_kinds(grid, [path])
    x_m, y_m = np.meshgrid(grid.middles_m, grid.middles_m)
    assert np.array_equal(kind == 1, path.value(x_m, y_m) > 0)
    assert kind.any(axis=1).all()


def test_distances_to_borders_are_those_of_lines_and_never_of_what_is_covered():
    _, _, grid = small_land(water_radius_m=0)
    x_m, y_m = np.meshgrid(grid.middles_m, grid.middles_m)
    out_of_line_m = 0.8 * x_m + 0.6 * y_m - 3.2
    steep = Layer("rock", lambda x_m, y_m: 5.0 * (0.8 * x_m + 0.6 * y_m - 3.2))  # five times the distance
    kind, border = lay_kinds(grid, [steep])
    assert np.array_equal(kind == 1, out_of_line_m > 0)
    off = np.minimum(np.abs(out_of_line_m) / grid.cell_m, BORDER_CELLS)
    assert np.abs(border / 255 * BORDER_CELLS - off).max() < 0.01
    # A road across its border: within the road, only the road's own borders count.
    road = Layer("road", lambda x_m, y_m: np.maximum(4.0 - np.abs(x_m), -100.0))
    kind, border = lay_kinds(grid, [road, steep])
    inside = np.abs(x_m) < 4.0 - BORDER_CELLS * grid.cell_m
    assert (kind[inside] == 1).all() and (border[inside] == 255).all()
    assert border[(np.abs(np.abs(x_m) - 4.0) < 0.3)].max() < 255 * 0.3 / (BORDER_CELLS * grid.cell_m) + 2


def test_grass_is_half_at_its_borders_and_even_far_from_them(wild):
    _, layers, grid = wild
    kind, _ = lay_kinds(grid, layers)
    share = lay_grass(grid, layers, kind) / 255
    assert not share[kind != 0].any()
    value = layers[-1].value(*np.meshgrid(grid.middles_m, grid.middles_m))
    bare = kind == 0
    assert share[bare & (np.abs(value + 0.3) < 0.02)].mean() == pytest.approx(0.05, abs=0.03)
    assert share[bare & (np.abs(value - 0.3) < 0.02)].mean() == pytest.approx(0.95, abs=0.03)
    assert share[bare & (value < -0.6)].max() < 0.02 and share[bare & (value > 0.6)].min() > 0.97
    assert share[bare & (np.abs(value) < 0.02)].mean() == pytest.approx(0.5, abs=0.05)
    step = np.abs(np.diff(share, axis=1))[bare[:, 1:] & bare[:, :-1]]
    assert step.max() < 0.25  # over half a metre


def test_no_grass_without_its_layer():
    _, layers, grid = small_land(grass_fraction=0)
    assert not lay_grass(grid, layers, lay_kinds(grid, layers)[0]).any()


@pytest.mark.parametrize("fraction", [0.0, 0.05, 0.4, 1.0])
def test_ash_covers_its_share_of_the_dry_ground(wild, fraction):
    terrain, layers, grid = wild
    kind, _ = lay_kinds(grid, layers)
    ash = lay_ash(grid, terrain, layers, fraction, kind, SEED)
    assert not ash[kind != 0].any()
    dry = terrain.shore_m(*np.meshgrid(grid.middles_m, grid.middles_m)) > 0
    wanted = min(fraction, np.mean(kind[dry] == 0))  # nothing else can burn
    # The threshold is set on the lattice, one cell in sixteen; the rest differs by the standard error of its patches.
    assert ash[dry].mean() / 255 == pytest.approx(wanted, rel=0.03)
