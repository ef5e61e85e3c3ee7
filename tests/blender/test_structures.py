"""Structures and small objects made of listed solids: sizes, materials, and number of triangles."""

import numpy as np
import pytest

from planner import assets
from planner.asset_checks import check
from planner.faults import ConfigError
from planner.plants.plant_shapes import build_variants, slots_of

SOLID = [name for name in assets.names("plants") if "shapes" in assets.load("plants", name)]
NAMES = (*assets.names("structures"), *SOLID)
HEIGHTS_M = {
    "hut_round": 3.9,
    "house_metal": 3.44,
    "tent_dome": 1.25,
    "container": 2.59,
    "lamp_mast": 9.1,
    "lamp_high_mast": 16.2,
    "hare": 0.225,
}


def _mesh(name):
    (mesh,) = build_variants(name, assets.standing(name), 1)
    return mesh


@pytest.mark.parametrize("name", NAMES)
def test_each_stands_on_the_ground_within_its_foot(name):
    mesh, data = _mesh(name), assets.standing(name)
    low_m, high_m = mesh.points_m[:, 2].min(), mesh.points_m[:, 2].max()
    assert -1.3 <= low_m <= 0.061 and high_m > 0.1
    # Segments of fences meet their neighbours, and eaves and arms reach over what stands below.
    reach_m = np.linalg.norm(mesh.points_m[:, :2], axis=1).max()
    assert (
        "fence" in name
        or "bank" in name
        or "pole" in name
        or "lamp" in name
        or reach_m < 1.4 * data["foot_m"]
    )
    assert len(mesh.triangles) < 2000


@pytest.mark.parametrize("name", NAMES)
def test_each_part_is_drawn_and_has_a_material(name):
    data = assets.standing(name)
    assert set(_mesh(name).slot) == set(range(len(slots_of(data))))
    for material, part in slots_of(data):
        assert not part or part in assets.load("materials", material)["parts"]


@pytest.mark.parametrize("name, height_m", HEIGHTS_M.items())
def test_heights_are_those_of_their_sources(name, height_m):
    assert _mesh(name).points_m[:, 2].max() == pytest.approx(height_m, abs=0.03)


@pytest.mark.parametrize("name", [name for name in assets.names("structures") if "lamp" in name])
def test_lamps_look_round(name):
    """Sides of their tubes are within 1 cm of the circle: a fifth of a pixel from 61 m with 14 mm."""
    for shape in assets.standing(name)["shapes"]:
        if "tube_m" in shape:
            radius_m = np.max(np.array(shape["tube_m"])[:, 3:])
            assert radius_m * (1 - np.cos(np.pi / shape["sides"])) < 0.01


@pytest.mark.parametrize("name", assets.names("structures"))
def test_covers_are_those_of_their_shapes(name):
    """The area hidden from above, by the triangles that face up: an upper bound, as they may hide each other."""
    mesh, data = _mesh(name), assets.standing(name)
    a, b, c = (mesh.points_m[corner] for corner in mesh.triangles.T)
    up_m2 = 0.5 * np.cross(b - a, c - a)[:, 2].clip(min=0).sum()
    assert data["cover_m2"] < 1.25 * up_m2 + 0.15


def test_a_shape_of_a_part_without_a_material_is_a_fault():
    data = {"materials": {"wall": "mud_wall"}, "shapes": [{"part": "roof"}]}
    with pytest.raises(ConfigError) as error:
        check("hut.json", "structures", data)
    assert str(error.value) == 'hut.json: shapes[0].part = "roof"; expected a key of materials: wall'
