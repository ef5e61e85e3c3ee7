"""The example that follows a group: a detector and a pilot that see frames alone."""

import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest

from veldt import plan
from veldt.gym import FlightEnv
from veldt.poses import pose_looking

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(name="example", scope="module")
def _example():
    spec = importlib.util.spec_from_file_location("follow", ROOT / "tests/examples/follow.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_group_of_the_config_stays_in_view(example, tmp_path):
    config = json.loads((ROOT / "configs/follow.json").read_text(encoding="utf-8"))
    config["scene"]["terrain"]["size_m"] = 760  # plans more quickly
    config["clips"][0]["frames"] = 31
    plan(config, tmp_path / "plan")
    steps, _, shown = example.fly(FlightEnv(tmp_path / "plan", "night"), "human")
    assert len(steps) == 31
    assert all(step.seen == step.count == 4 for step in steps)
    assert max(np.linalg.norm(step.thought_m - step.true_m) for step in steps) < 5
    assert np.linalg.norm(steps[-1].true_m - steps[0].true_m) > 3  # a pilot that stays is not enough
    assert len(shown[0][1]) >= 3


def test_spots_are_found_where_they_are_the_clearest_first(example):
    grey = np.full((120, 160), 90, np.uint8)
    grey[::2, ::3] += 1
    grey[40:48, 100:108] += 60
    grey[80:88, 20:28] += 30
    grey[100:, :] += 40  # an edge is no spot
    spots = example.warm_spots(grey, 8)
    assert [(round(spot.column_px), round(spot.row_px)) for spot in spots[:2]] == [(104, 44), (24, 84)]
    assert spots[0].contrast > spots[1].contrast


def test_a_spot_is_where_its_ray_meets_the_ground(example):
    camera = example.Intrinsics(640, 512, 800, 800, 320, 256)
    pose = pose_looking(np.array([10.0, 20.0, 61.0]), np.pi / 2, np.pi / 4)  # to the north, 45 degrees down
    middle = example.place_on_ground(example.Spot(320, 256, 0), pose, camera, 0)
    assert np.allclose(middle, [10, 81])
    assert example.place_on_ground(example.Spot(320, 256 - 900, 0), pose, camera, 0) is None
    right = example.place_on_ground(example.Spot(400, 256, 0), pose, camera, 0)
    assert np.allclose(right, [10 + 61 * np.sqrt(2) / 10, 81])


def test_what_stays_is_not_followed(example):
    camera = example.Intrinsics(640, 512, 800, 800, 320, 256)
    pose = pose_looking(np.array([0.0, 0.0, 61.0]), np.pi / 2, np.pi / 4)
    pilot = example.Pilot(pose, camera, 10)
    for frame in range(50):
        grey = np.full((512, 640), 90, np.uint8)
        grey[::2, ::3] += 1
        grey[268:276, 308:316] += 80  # a warm stone, 1.9 m away
        grey[256:264, 320 + frame : 328 + frame] += 80  # somebody who walks 1.1 m/s to the east
        spots = pilot.look(grey, pose)
    assert [spot.column_px for spot in spots] == pytest.approx([373], abs=1.5)
    assert 0.5 < pilot.velocity_m_s[0] < 1.5
