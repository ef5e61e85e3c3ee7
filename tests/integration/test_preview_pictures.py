"""`render --preview` with a real Blender: a map that matches the plan, and stills."""

import re
import shutil

import numpy as np
import pytest

from configs import tiny
from pictures import read_planes
from program import Veldt
from resolved import resolve
from planner.preview.colours import surface_colour
from planner.preview.map_layers import MapSheet, plan_map
from planner.world import World, plan_world

PICTURES = ["close_herd.png", "close_people.png", "close_zebras.png", "map.png", "overview.png"]


def _open_plain(config: dict) -> None:
    """Few plants, so that most of the ground is visible."""
    config["scene"]["plants"] = {"acacia": {"per_ha": 20}}


@pytest.fixture(scope="module", name="made")
def _made(tmp_path_factory, blender) -> Veldt:
    veldt = Veldt(tmp_path_factory.mktemp("made"))
    veldt.write("config.json", tiny(_open_plain))
    veldt.write("empty.json", tiny(_empty))
    (veldt.folder / "out" / "preview").mkdir(parents=True)
    for name in ("close_old.png", "part_map.png", "notes.txt"):
        veldt.write(f"out/preview/{name}", "of another time")
    done = veldt(
        "render", "config.json", "--out", "out", "--preview", "--blender", blender, "--progress", "none"
    )
    assert (done.code, done.err) == (0, "")
    assert done.out == "out/preview: 5 pictures; map.png shows the place from above\n"
    return veldt


def _empty(config: dict) -> None:
    config["scene"].update(plants={}, groups=[])
    config["scene"]["terrain"]["water_radius_m"] = 0
    config["clips"] = config["clips"][:1]


@pytest.fixture(scope="module", name="world")
def _world() -> World:
    return plan_world(resolve(tiny(_open_plain)))


@pytest.fixture(scope="module", name="sheet")
def _sheet(world) -> MapSheet:
    return plan_map(world, 0.0)


def _picture(made: Veldt, name: str) -> np.ndarray:
    """Red, green and blue (height, width, 3), 0 to 255."""
    planes = read_planes(made.folder / "out" / "preview" / name)
    return np.stack([planes[channel] for channel in "RGB"], axis=-1).astype(int)


def _bytes(colour: str) -> np.ndarray:
    return np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])


def _pixels(sheet: MapSheet, picture: np.ndarray, points_m) -> tuple[np.ndarray, np.ndarray]:
    """Rows and columns of places (n, 2) on the map."""
    points_m = np.asarray(points_m, float)
    per_m = picture.shape[1] / sheet.width_m
    column = (points_m[:, 0] - sheet.centre_m[0]) * per_m + 0.5 * picture.shape[1]
    row = (sheet.centre_m[1] - points_m[:, 1]) * per_m + 0.5 * picture.shape[0]
    return np.round(row - 0.5).astype(int), np.round(column - 0.5).astype(int)


def test_only_pictures_of_earlier_previews_are_removed(made):
    there = sorted(file.name for file in (made.folder / "out" / "preview").iterdir())
    assert there == sorted([*PICTURES, "blender.log", "config.json", "notes.txt", "plan"])


def test_map_has_the_sheets_shape(made, sheet):
    height, width, _ = _picture(made, "map.png").shape
    assert 1400 <= height <= 2000 and width == 1920
    assert width / height == pytest.approx(sheet.width_m / sheet.height_m, abs=1.0 / height)


def test_each_flat_colour_is_on_the_map_as_planned(made, sheet):
    """Opaque layers have exactly their colour: conversion to linear and back to sRGB is within one count."""
    picture = _picture(made, "map.png")
    for layer in sheet.layers:
        if layer.opacity == 1.0 and len(layer.mesh.triangles):
            apart = np.abs(picture - _bytes(layer.colour)).max(axis=-1)
            assert (apart <= 1).any(), layer.name


def test_groups_are_marked_where_they_are(made, world, sheet):
    """The first member's marker is the largest, and covers only markers of its own group."""
    picture = _picture(made, "map.png")
    firsts = [actor for actor in world.actors if actor.name.endswith("_1")]
    members = [layer for layer in sheet.layers if layer.name == "members"]
    assert len(members) == len(firsts) == 3
    last = firsts[-1]  # drawn over all others
    place = last.path(np.array([last.start_m]))[0]
    row, column = _pixels(sheet, picture, place)
    assert np.abs(picture[row[0], column[0]] - _bytes(members[-1].colour)).max() <= 1


def test_every_label_is_written_where_it_was_planned(made, sheet):
    """In the box of each label there is ink on paper, as much as thin letters have: 2 % to a half of the box."""
    picture = _picture(made, "map.png")
    assert {"people", "herd", "zebras", "loop", "tiny", "N"} <= {label.text for label in sheet.labels}
    for label in sheet.labels:
        if not label.text:
            continue
        x0, y0, x1, y1 = label.plate_m
        rows, columns = _pixels(sheet, picture, [[x0, y1], [x1, y0]])
        box = picture[rows[0] : rows[1], columns[0] : columns[1]]
        ink = (box.max(axis=-1) < 90).mean()
        assert 0.02 < ink < 0.5, label.text


def test_ground_and_water_have_their_colours(made, world, sheet):
    """Light changes how bright a surface is and hardly its hue."""
    picture = _picture(made, "map.png")
    shore_m = world.terrain.shore_m(0.0, 0.0)
    assert shore_m < 0
    row, column = _pixels(sheet, picture, [[0.0, 0.0]])
    water = picture[row[0], column[0]]
    assert water.argmax() == 2 == _bytes(surface_colour("water")).argmax()
    corner, edge = _pixels(sheet, picture, [[-58.0, -58.0]])
    assert picture[corner[0], edge[0]].argmin() == 2  # soil, grass and leaves have least blue


@pytest.mark.parametrize("name", [name for name in PICTURES if name != "map.png"])
def test_stills_show_something_by_daylight(made, name):
    picture = _picture(made, name)
    assert picture.shape == (540, 960, 3)
    assert 40 < picture.mean() < 220
    assert picture.std(axis=(0, 1)).min() > 10
    assert (picture.max(axis=-1) < 8).mean() < 0.05  # hardly anything is black


def test_a_close_view_shows_its_animal_in_the_middle(made):
    """An elephant is grey; ground, plants and sky are not."""
    middle = _picture(made, "close_herd.png")[200:340, 380:580]
    grey = (middle.max(axis=-1) - middle.min(axis=-1)) < 25
    assert grey.mean() > 0.3


def test_a_place_with_an_empty_path_has_a_map_and_an_overview(made, blender):
    done = made("render", "empty.json", "--out", "empty", "--preview", "--blender", blender, "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    assert sorted(file.name for file in (made.folder / "empty" / "preview").glob("*.png")) == [
        "map.png",
        "overview.png",
    ]


def test_a_disk_that_fills_up_leaves_no_broken_picture(made, blender):
    """Files are cut at 64 KiB (128 blocks), as on a full disk; a picture is more. The plan is there already."""
    shutil.copytree(made.folder / "out" / "preview" / "plan", made.folder / "cut" / "preview" / "plan")
    cut = ["sh", "-c", 'trap "" XFSZ; ulimit -f 128; exec "$@"', "sh"]
    done = made(
        "render", "config.json", "--out", "cut", "--preview", "--blender", blender, "--quiet", under=cut
    )
    assert done.code == 1
    why = r"(.*\(File too large\).*|Blender could not write all of it; is the disk full\?)"  # 3.4, or later ones
    place = r"blender_scripts/veldt_bl/preview\.py:\d+"
    doing = "while rendering clip preview"
    assert re.fullmatch(
        rf"veldt: Blender failed {doing}: \w+: cut/preview/overview\.png: {why} \({place}\);"
        r" log: cut/preview/blender\.log\n",
        done.err,
    ), done.err
    assert not list((made.folder / "cut" / "preview").glob("[!p]*.png"))
