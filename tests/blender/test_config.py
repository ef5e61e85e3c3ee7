"""Defaults come from the camera's preset and then from the schema, at every depth, and from nowhere else."""

import json
from pathlib import Path

import jsonschema
import pytest

from veldt.config import ROOT, SCHEMA, load, resolve
from veldt.faults import ConfigError

CLIP = {"id": "a", "season": "winter", "frames": 1, "flight": {"pattern": "zigzag", "area_m": [0, 0, 9, 9]}}


def test_defaults_are_filled_in_at_every_depth():
    config = resolve(
        {"name": "x", "clips": [CLIP], "scene": {"groups": [{"name": "g"}], "terrain": {"size_m": 50}}}
    )
    assert config["seed"] == 1
    assert config["camera"]["width_px"] == 640
    assert config["scene"]["terrain"]["size_m"] == 50
    assert config["scene"]["terrain"]["cell_m"] == 2
    assert config["scene"]["groups"][0]["count"] == 1
    assert "speed_m_s" not in config["scene"]["groups"][0]
    assert config["clips"][0]["flight"]["altitude_m"] == 61


def test_resolving_leaves_its_input_alone_and_its_output_as_it_is():
    given = {"name": "x", "clips": [CLIP]}
    resolved = resolve(given)
    assert given == {"name": "x", "clips": [CLIP]}
    assert resolve(resolved) == resolved
    jsonschema.validate(resolved, json.loads(SCHEMA.read_text()))


def test_a_preset_stands_above_the_defaults_and_below_the_config():
    config = resolve(
        {
            "name": "x",
            "clips": [CLIP],
            "camera": {"width_px": 320},
            "sensor": {"preset": "boson_640_14mm", "noise": {"row_ratio": 0.7}},
        }
    )
    assert (config["camera"]["width_px"], config["camera"]["pixel_pitch_um"]) == (320, 12)
    noise = config["sensor"]["noise"]
    assert (noise["row_ratio"], noise["column_ratio"], noise["banding_ratio"]) == (0.7, 0.2, 0)


def test_an_unknown_preset_is_a_fault():
    with pytest.raises(ConfigError) as fault:
        resolve({"name": "x", "clips": [CLIP], "sensor": {"preset": "bosun"}})
    assert str(fault.value) == f'sensor.preset = "bosun"; expected a file of {ROOT / "assets" / "sensors"}'


def test_demo_config_keeps_to_the_schema():
    jsonschema.validate(load(ROOT / "configs" / "demo.json"), json.loads(SCHEMA.read_text()))


def test_unreadable_configs_are_faults(tmp_path: Path):
    with pytest.raises(ConfigError, match=r"config = .*none\.json; expected a readable file \(No such file"):
        load(tmp_path / "none.json")
    (tmp_path / "bad.json").write_text('{"name": }')
    with pytest.raises(ConfigError, match=r"expected JSON \(Expecting value: line 1 column 10"):
        load(tmp_path / "bad.json")
