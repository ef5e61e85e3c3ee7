"""The planner is handed resolved configs."""

from pathlib import Path

import pytest

from resolved import resolve
from scenes import tiny
from planner.config import input_files, load
from planner.faults import ConfigError


def test_unreadable_configs_are_faults(tmp_path: Path):
    with pytest.raises(ConfigError, match=r"config = .*none\.json; expected a readable file \(No such file"):
        load(tmp_path / "none.json")
    (tmp_path / "bad.json").write_text('{"name": }')
    with pytest.raises(ConfigError, match=r"expected JSON \(Expecting value: line 1 column 10"):
        load(tmp_path / "bad.json")


def test_only_what_a_plan_depends_on_is_handed_over():
    assert tiny().keys() == {"name", "seed", "scene", "camera", "render", "clips", "flights"}
    assert all("season" not in clip for clip in tiny()["clips"])
    intrinsics = {"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px"}
    assert tiny()["camera"].keys() == intrinsics


def test_a_config_that_the_program_refuses_is_not_handed_over():
    with pytest.raises(ValueError, match="clips and flights are empty"):
        resolve({"name": "x", "clips": []})


def test_the_files_of_a_config_are_those_it_names(tmp_path):
    def change(config: dict) -> None:
        config["scene"]["terrain"]["heightmap"] = {"file": str(tmp_path / "hill.png"), "height_m": [0, 9]}

    assert input_files(tiny()) == []
    assert input_files(tiny(change)) == [tmp_path / "hill.png"]
