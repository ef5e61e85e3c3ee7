"""Pictures of the ground from above: north on top, water where it is, with the positions of the pictures."""

import json
import subprocess
import sys

import numpy as np
import OpenImageIO as oiio
import pytest

from processes import PATIENCE_S
from scenes import tiny
from planner.config import ROOT
from planner.images import write_rgb
from planner.land.road_plan import plan_road
from planner.land.terrain import build_terrain
from planner.plants.density import plan_density
from planner.preview.ground_picture import Window, draw_ground, whole_place, window_round
from planner.blender_images import is_whole_png


def _rich(config: dict) -> None:
    config["scene"]["terrain"].update(size_m=240, pan_radius_m=8, craggy_fraction=0.15, relief_m=12)


def _read(file) -> np.ndarray:
    return np.asarray(oiio.ImageBuf(str(file)).get_pixels(oiio.UINT8))


def _run(tmp_path, config: dict, points=None):
    (tmp_path / "config.json").write_text(json.dumps(config), encoding="utf-8")
    command = [sys.executable, "-B", str(ROOT / "blender_scripts" / "draw_map.py")]
    command += ["--config", str(tmp_path / "config.json"), "--out", str(tmp_path)]
    if points is not None:
        (tmp_path / "points.json").write_text(json.dumps(points), encoding="utf-8")
        command += ["--points", str(tmp_path / "points.json")]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE_S)


@pytest.fixture(scope="module", name="place")
def _place():
    config = tiny(_rich)
    settings, seed = config["scene"]["terrain"], config["seed"]
    terrain = build_terrain(settings, seed)
    return terrain.with_road(plan_road(settings["road"], terrain, seed)), plan_density(
        terrain, settings, seed
    )


def _middles(window: Window, side_px: int):
    along_m = (np.arange(side_px) + 0.5) / side_px * window.side_m
    return np.meshgrid(window.west_m + along_m, window.south_m + along_m[::-1])


def test_a_png_is_what_others_read(tmp_path):
    colours = np.random.Generator(np.random.PCG64(3)).integers(0, 256, (5, 7, 3), np.uint8)
    file = tmp_path / "colours.png"
    write_rgb(file, colours)
    assert is_whole_png(file)
    assert np.array_equal(_read(file), colours)


def test_water_is_blue_where_the_terrain_has_it(place):
    terrain, areas = place
    for window in (whole_place(terrain), Window(-30.0, -12.0, 37.0)):
        picture = draw_ground(terrain, areas, window, 96).astype(int)
        wet = terrain.shore_m(*_middles(window, 96)) < 0
        assert wet.any() and not np.array_equal(wet, wet[::-1])
        assert (picture[wet] == picture[wet][0]).all()
        blue = picture[..., 2] > picture[..., 0]
        assert np.array_equal(blue, wet)


def test_dense_ground_is_greener_than_open_ground(place):
    terrain, areas = place
    window = whole_place(terrain)
    picture = draw_ground(terrain, areas, window, 96).astype(float)
    x_m, y_m = (grid.ravel() for grid in _middles(window, 96))
    shares = areas.shares(x_m, y_m).reshape(96, 96, 3)
    dry = (terrain.shore_m(x_m, y_m) > 0) & (terrain.crag.share(x_m, y_m) == 0)
    redness = (picture[..., 0] / picture[..., 1])[dry.reshape(96, 96)]
    shares = shares[dry.reshape(96, 96)]
    assert redness[shares[:, 2] > 0.9].max() < 1 < redness[shares[:, 0] > 0.9].min()


def test_slopes_to_the_north_west_are_lit():
    def hill(config: dict) -> None:
        config["scene"]["terrain"].update(
            relief_m=20, water_radius_m=0, hill_wavelength_m=100, area_wavelength_m=5000
        )

    config = tiny(hill)
    terrain = build_terrain(config["scene"]["terrain"], config["seed"])
    areas = plan_density(terrain, config["scene"]["terrain"], config["seed"])
    picture = draw_ground(terrain, areas, whole_place(terrain), 60).sum(axis=-1).astype(float)
    x_m, y_m = (grid.ravel() for grid in _middles(whole_place(terrain), 60))
    to_light = terrain.height_m(x_m + 2, y_m - 2) - terrain.height_m(x_m - 2, y_m + 2)
    assert np.corrcoef(to_light, picture.ravel())[0, 1] > 0.7


def test_a_window_holds_its_points_and_some_ground():
    points_m = np.array([[10.0, -5.0], [30.0, 5.0], [12.0, 95.0]])
    window = window_round(points_m)
    margin_m = np.min([points_m - [window.west_m, window.south_m]])
    assert margin_m == pytest.approx(15.0)  # at least 15 m, more than 12 % of 50 m
    assert (points_m < np.array([window.west_m, window.south_m]) + window.side_m).all()
    assert window_round(np.array([[1.0, 2.0]])) == Window(-14.0, -13.0, 30.0)


def test_the_program_prints_the_positions_of_its_pictures(tmp_path, place):
    terrain, _ = place
    points = [
        [0.0, 40.0, float(terrain.surface_m(np.array([0.0]), np.array([40.0]))[0]) + 0.25],
        [20.0, 60.0, None],
    ]
    done = _run(tmp_path, tiny(_rich), points)
    assert (done.returncode, done.stderr) == (0, "")
    answer = json.loads(done.stdout)
    assert answer["place"] == {"west_m": -120.0, "south_m": -120.0, "side_m": 240}
    assert answer["window"] == {"west_m": -15.0, "south_m": 25.0, "side_m": 50.0}
    assert answer["off_m"] == pytest.approx(0.25)
    assert _read(tmp_path / "place.png").shape == (320, 320, 3)
    assert _read(tmp_path / "window.png").shape == (640, 640, 3)


def test_the_same_config_gives_the_same_bytes(tmp_path):
    pictures = []
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        assert _run(tmp_path / name, tiny(_rich)).returncode == 0
        pictures.append((tmp_path / name / "place.png").read_bytes())
        assert not (tmp_path / name / "window.png").exists()
    assert pictures[0] == pictures[1]


def test_a_missing_map_is_named(tmp_path):
    def lose(config: dict) -> None:
        config["scene"]["terrain"]["heightmap"] = {"file": "missing.png", "height_m": [0, 5]}

    done = _run(tmp_path, tiny(lose))
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1 and "missing.png" in done.stderr
