"""Camp fires: their place, their shape, and what the baked scene says of them."""

import numpy as np
import pytest

from planner import assets, ids
from planner.faults import ConfigError
from planner.fires import PARTS, fire_mesh, flame_height_m, plan_fires


class _Flat:
    """Level ground at 7 m with water east of x = 20 m."""

    size_m = 100.0
    waters = ("one",)

    def height_m(self, x_m, y_m):
        return np.full(len(x_m), 7.0) + 0.0 * y_m

    def shore_m(self, x_m, y_m):
        return 20.0 - x_m + 0.0 * y_m


def _entry(place=(0, 0), diameter_m=0.6, state="burning", since_s=3600):
    return {"place": list(place), "diameter_m": diameter_m, "state": state, "since_s": since_s}


def test_fires_stand_on_the_ground_and_say_what_they_do():
    (fire,) = plan_fires([_entry((3, -4), 1.0, "embers", 60)], _Flat())
    assert fire.name == "fire_1"
    assert fire.position_m.tolist() == [3, -4, 7]
    assert fire.state() == {"place_m": [3, -4], "diameter_m": 1.0, "state": "embers", "since_s": 60}
    assert fire.clearing.half_width_m == 1.5


@pytest.mark.parametrize("diameter_m", (0.3, 0.6, 3.0))
def test_a_bed_has_its_size_and_flames_their_height(diameter_m):
    (fire,) = plan_fires([_entry(diameter_m=diameter_m)], _Flat())
    mesh = fire_mesh(fire, 1)
    bed = mesh.points_m[mesh.triangles[mesh.slot != PARTS.index("flames")]]
    assert 0.9 < np.ptp(bed[..., 0]) / diameter_m <= 1.0
    assert bed[..., 2].min() < 0 < bed[..., 2].max() < 0.25 * diameter_m
    tall_m = mesh.points_m[:, 2].max()
    assert 0.7 * flame_height_m(diameter_m) < tall_m < 1.2 * flame_height_m(diameter_m)
    # 0.35 of 112 triangles glow: five standard deviations.
    glowing = (mesh.slot == PARTS.index("embers")).sum() / (mesh.slot != PARTS.index("flames")).sum()
    assert glowing == pytest.approx(0.35, abs=5 * (0.35 * 0.65 / 112) ** 0.5)
    assert np.array_equal(fire_mesh(fire, 1).points_m, mesh.points_m)


def test_embers_have_no_flames_and_all_parts_a_temperature():
    (fire,) = plan_fires([_entry(state="embers")], _Flat())
    assert PARTS.index("flames") not in fire_mesh(fire, 1).slot
    assert set(PARTS) == set(assets.load("materials", "fire")["parts"])


def test_a_fire_is_on_dry_ground_of_the_place():
    with pytest.raises(ConfigError) as error:
        plan_fires([_entry(), _entry((30, 0))], _Flat())
    assert str(error.value) == "scene.fires[1].place = [30, 0] m; expected dry ground, not water"
    with pytest.raises(ConfigError) as error:
        plan_fires([_entry((0, -50))], _Flat())
    expected = "scene.fires[0].place = [0, -50] m; expected within 49.4 m of the middle in x and y"
    assert str(error.value) == expected


def test_fires_have_indices_between_plants_and_actors():
    assert ids.plan_fire_indices(8, 2) == [ids.FIRST_PLANT + 8, ids.FIRST_PLANT + 9]
    with pytest.raises(ConfigError) as error:
        ids.plan_fire_indices(60, 50)
    assert str(error.value) == (
        "scene.fires = 50 fires; expected at most 38 beside 60 species of plants, one object index each"
    )
