"""Trodden ground: trails to the water, wheel tracks, trampled halos; and ash about hearths."""

import numpy as np
import pytest

from lands import SEED, SIZE_M, WILD, small_land
from planner.geometry.splines import Line
from planner.land.fine_covers import lay_kinds
from planner.land.fine_grid import FineGrid
from planner.land.strands import Halo, Strand, lay_strands
from planner.land.trails import Place
from planner.land.trodden import Treads, lay_fine_covers, lay_pans, lay_trodden, wheel_tracks

NO_TREADS = Treads([], [], [])
PLAIN = {"burnt_fraction": 0.0, "pan_fraction": 0.0}


def test_both_wheels_leave_a_track_on_the_road():
    terrain, _, _ = small_land(**WILD)
    tracks = wheel_tracks(terrain.road)
    assert {round(track.aside_m, 2) for track in tracks} == {-0.75, 0.75}
    trodden = lay_trodden(FineGrid(terrain.size_m), terrain, NO_TREADS, SEED)
    at_m, heading = terrain.road.loop.at(np.linspace(0, terrain.road.loop.length_m, 500))
    left = np.stack([-heading[:, 1], heading[:, 0]], axis=1)

    def shares(off_m):
        return _at(trodden, at_m + off_m * left) / 255

    assert min(shares(0.75).mean(), shares(-0.75).mean()) > 0.4
    assert max(shares(0.0).mean(), shares(1.7).mean(), shares(-1.7).mean()) < 0.15


def test_a_strand_covers_cells_by_its_width():
    grid = FineGrid(60)
    trodden = np.zeros((grid.cells, grid.cells), np.uint8)
    line = Line([[-20.0, 3.25], [20.0, 3.25]])  # through the middles of cells
    lay_strands(trodden, grid, [Strand(line, "a", [0.2, 0.2], [1.0, 1.0], frays=0.0)], SEED)
    row = int((3.25 + 30) / grid.cell_m)
    assert (trodden[row, 22:98] == round(0.8 * 255)).all() and np.count_nonzero(trodden) < 90
    slanted = np.zeros_like(trodden)
    line = Line([[-20.0, -10.0], [20.0, 10.0]])
    lay_strands(slanted, grid, [Strand(line, "a", [0.2, 0.2], [1.0, 1.0], frays=0.0)], SEED)
    # The cells' shares add up to the strip's area, within what a slanted cell's corners are worth.
    assert slanted.sum() / 255 * grid.cell_m**2 == pytest.approx(0.4 * line.length_m, rel=0.15)


def _at(shares, at_m):
    column, row = np.floor((at_m / SIZE_M + 0.5) * len(shares)).astype(int).T
    return shares[row, column]


def test_trampled_ground_surrounds_the_water_and_trails_lead_there():
    terrain, _, grid = small_land()
    x_m, y_m = np.meshgrid(grid.middles_m, grid.middles_m)
    shore_m = terrain.shore_m(x_m, y_m)
    source_m = np.array([100.0, 80.0])
    trodden = lay_trodden(grid, terrain, Treads([], [], [source_m]), SEED) / 255
    assert trodden[(shore_m > 0) & (shore_m < 2)].mean() > 0.5
    assert trodden[(shore_m > 6) & (shore_m < 8)].mean() < 0.5 * trodden[(shore_m > 0) & (shore_m < 2)].mean()
    from_m = np.hypot(x_m, y_m)
    rings = [trodden[(from_m > r) & (from_m < r + 2)].max() for r in range(20, 110, 2)]
    assert min(rings) > 0.15  # at least one trail crosses each


def test_foot_paths_lead_to_places_from_each_other_and_out_into_the_land():
    terrain, _, grid = small_land(water_radius_m=0)
    places = [Place("a", np.array([-70.0, -60.0]), 10.0), Place("b", np.array([70.0, 50.0]), 10.0)]
    trodden = lay_trodden(grid, terrain, Treads([], [], [], places), SEED) / 255
    x_m, y_m = np.meshgrid(grid.middles_m, grid.middles_m)
    for place in places:
        off_m = np.hypot(x_m - place.middle_m[0], y_m - place.middle_m[1])
        assert all(trodden[np.abs(off_m - r) < 1].max() > 0.15 for r in range(4, 160, 4))
    assert trodden[np.hypot(x_m + 70, y_m + 60) < 40].mean() < 0.06  # narrow
    again = lay_trodden(grid, terrain, Treads([], [], [], places[:1]), SEED) / 255
    assert 0 < np.count_nonzero(again) < np.count_nonzero(trodden)


def test_nothing_leads_to_water_that_is_not_there():
    terrain, _, grid = small_land(water_radius_m=0)
    assert not lay_trodden(grid, terrain, Treads([], [], [np.array([50.0, 40.0])]), SEED).any()


def test_places_of_groups_are_trampled_unevenly():
    terrain, layers, grid = small_land(water_radius_m=0)
    halo = Halo((30.0, -20.0), 2.0, 12.0, 0.8)
    fine = lay_fine_covers(
        terrain, layers, Treads([], [halo], []), PLAIN, [Halo((0.0, 0.0), 0.3, 0.8, 1.0)], SEED
    )
    x_m, y_m = np.meshgrid(grid.middles_m, grid.middles_m)
    off_m = np.hypot(x_m - 30, y_m + 20)
    assert fine.trodden[off_m < 1].min() > 150 and not fine.trodden[off_m > 20].any()
    assert 20 < np.ptp(fine.trodden[(off_m > 6) & (off_m < 7)])  # no circle
    assert 200 < fine.ash.max() and np.hypot(x_m, y_m)[fine.ash > 0].max() < 1.5


@pytest.mark.parametrize("fraction", [0.0, 0.05, 0.3])
def test_pans_are_bare_ground_of_several_sizes_off_other_covers(fraction):
    terrain, layers, grid = small_land(**WILD)
    kind, _ = lay_kinds(grid, layers)
    pans = lay_pans(grid, terrain, fraction, kind, SEED) / 255
    assert not pans[kind != 0].any()
    assert (pans[kind == 0] > 0.47).mean() == pytest.approx(fraction, abs=0.03)
    if fraction > 0:
        assert pans.max() > 0.9 and 0.02 < ((pans > 0.1) & (pans < 0.8)).mean() < fraction  # soft borders
        trodden = lay_fine_covers(
            terrain, layers, NO_TREADS, PLAIN | {"pan_fraction": fraction}, [], SEED
        ).trodden
        assert (trodden >= np.rint(255 * pans)).all()


def test_other_seeds_have_other_maps():
    terrain, layers, _ = small_land()
    one, other = (
        lay_fine_covers(terrain, layers, NO_TREADS, PLAIN | {"burnt_fraction": 0.1}, [], seed)
        for seed in (1, 2)
    )
    assert not np.array_equal(one.trodden, other.trodden) and not np.array_equal(one.ash, other.ash)
