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


def _meshes(name):
    meshes = build_variants(name, assets.standing(name), 1)
    assert len(meshes) == assets.standing(name).get("variants", 1)
    return meshes


def _reach_m(mesh):
    return np.linalg.norm(mesh.points_m[:, :2], axis=1).max()


@pytest.mark.parametrize("name", NAMES)
def test_each_stands_on_the_ground_within_its_foot(name):
    # Segments of fences meet their neighbours, and eaves and arms reach over what stands below.
    reaches = any(part in name for part in ("fence", "bank", "pole", "lamp"))
    for mesh in _meshes(name):
        low_m, high_m = mesh.points_m[:, 2].min(), mesh.points_m[:, 2].max()
        assert -1.3 <= low_m <= 0.061 and high_m > 0.1
        assert reaches or _reach_m(mesh) < 1.4 * assets.standing(name)["foot_m"]
        assert len(mesh.triangles) < 2000


@pytest.mark.parametrize("name", NAMES)
def test_each_part_is_drawn_and_has_a_material(name):
    data = assets.standing(name)
    assert set(np.concatenate([mesh.slot for mesh in _meshes(name)])) == set(range(len(slots_of(data))))
    for material, part in slots_of(data):
        assert not part or part in assets.load("materials", material)["parts"]


@pytest.mark.parametrize("name, height_m", HEIGHTS_M.items())
def test_heights_are_those_of_their_sources(name, height_m):
    unevenness = assets.standing(name).get("proportions", 0.0)
    for mesh in _meshes(name):
        assert mesh.points_m[:, 2].max() == pytest.approx(height_m, abs=0.03 + 1.01 * unevenness * height_m)


@pytest.mark.parametrize("name", ["hut_round", "hut_square", "house_metal"])
def test_roofs_differ_in_proportions_and_size(name):
    sizes_m = np.array([np.ptp(mesh.points_m[:, :2], axis=0) for mesh in _meshes(name)])
    assert np.ptp(sizes_m[:, 0] / sizes_m[:, 1]) > 0.15
    assert np.ptp(sizes_m.prod(axis=1)) > 0.2 * sizes_m.prod(axis=1).mean()


def test_eaves_of_thatch_are_no_circles_and_walls_stand_below_them():
    data = assets.standing("hut_round")
    for mesh in build_variants("hut_round", {**data, "proportions": 0.0}, 1):
        by_part = [mesh.points_m[np.unique(mesh.triangles[mesh.slot == slot])] for slot in (0, 1)]
        roof, wall = (np.hypot(*points_m[:, :2].T) for points_m in by_part)
        eaves = roof[roof > 0.8 * roof.max()]
        assert 0.02 < eaves.std() / eaves.mean() < 0.12
        assert wall.max() < 2.2 and roof.max() > 2.4


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
    data, up_m2 = assets.standing(name), []
    for mesh in _meshes(name):
        a, b, c = (mesh.points_m[corner] for corner in mesh.triangles.T)
        up_m2.append(0.5 * np.cross(b - a, c - a)[:, 2].clip(min=0).sum())
    assert data["cover_m2"] < 1.25 * np.mean(up_m2) + 0.15


def test_a_shape_of_a_part_without_a_material_is_a_fault():
    data = {"materials": {"wall": "mud_wall"}, "shapes": [{"part": "roof"}]}
    with pytest.raises(ConfigError) as error:
        check("hut.json", "structures", data)
    assert str(error.value) == 'hut.json: shapes[0].part = "roof"; expected a key of materials: wall'
