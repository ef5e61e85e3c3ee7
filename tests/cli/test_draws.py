"""Clips with settings of their own, given or drawn: the same pixels however a dataset is made."""

import json
import re

import jsonschema
import pytest

from configs import tiny
from datasets import content_of
from program import ROOT, Veldt, check_fault

_CLIPS = 6


def _drawn() -> dict:
    """Six clips that differ in everything that may differ, and one that gives its own values."""
    config = tiny()
    config["render"] = {"actor_layer": True, "engine": "embree", "supersample": 2}
    config["sensor"] = {
        "preset": {"choice": ["boson_640_14mm", "flir_vue_pro_640_13mm"]},
        "model": "physical",
        "noise": {"amount": {"uniform": [0, 1]}},
        "agc": {
            "choice": [
                {"mode": "plateau", "damping_s": 0},
                {"mode": "linear", "low_k": {"uniform": [260, 270]}},
            ]
        },
    }
    config["camera"]["focal_length_m"] = {"normal": [0.013, 0.001]}
    config["weather"] = {
        "time": {"uniform": ["22:00", "04:00"]},
        "air_temperature_k": {"uniform": [272, 296]},
        "cloud_fraction": {"choice": [0, {"uniform": [0.2, 1]}]},
    }
    config["output"] = {
        "codec": {"choice": [None, {"name": "mjpeg", "bitrate_kbit_s": {"uniform": [40, 90]}}]}
    }
    config["labels"] = {"ignore_below_area_px": {"uniform": [0, 3]}}
    first = config["clips"][0]
    first["flight"] |= {"altitude_m": {"uniform": [30, 50]}, "look_angle_deg": {"uniform": [50, 90]}}
    season = {"choice": ["winter", "summer"]}
    many = first | {
        "id": "many",
        "count": _CLIPS - 1,
        "frames": 2,
        "season": season,
        "start_s": {"uniform": [0, 9]},
    }
    own = {
        "weather": {"air_temperature_k": 281},
        "terms": {"path": "off"},
        "sensor": {"noise": {"amount": 0}},
    }
    config["clips"] = [many, first | {"id": "own", "frames": 2, **own}]
    return config


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A drawn dataset."""
    veldt = Veldt(tmp_path_factory.mktemp("draws"))
    veldt.write("config.json", _drawn())
    _run(veldt, "generate", "config.json", "--out", "whole")
    return veldt


def _run(veldt, *arguments) -> None:
    done = veldt(*arguments, "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")


def _distributions_in(value) -> bool:
    if isinstance(value, dict):
        return any(
            key in ("uniform", "normal", "choice") or _distributions_in(one) for key, one in value.items()
        )
    return isinstance(value, list) and any(_distributions_in(one) for one in value)


def test_a_dataset_records_numbers_and_what_was_drawn(place):
    config = place.read("whole/dataset.json")["config"]
    assert not _distributions_in(config)
    assert [clip["id"] for clip in config["clips"]] == [*(f"many_{k:04d}" for k in range(_CLIPS - 1)), "own"]
    temperatures = [clip["weather"]["air_temperature_k"] for clip in config["clips"]]
    assert len(set(temperatures)) == _CLIPS and temperatures[-1] == 281
    assert {"flight.altitude_m", "season", "start_s", "weather.time"} <= set(config["clips"][0]["drawn"])
    assert "weather.air_temperature_k" not in config["clips"][-1]["drawn"]
    assert not _distributions_in(place.read("whole/plan/plan.json"))
    cameras = {video["camera"]["fx_px"] for video in place.read("whole/annotations.json")["videos"]}
    assert len(cameras) == _CLIPS


def test_shards_have_the_pixels_of_an_undivided_run(place):
    _run(place, "plan", "config.json", "--out", "plan")
    for shard in range(2):
        _run(place, "generate", "--plan", "plan", "--shard", f"{shard}/2", "--out", f"shard_{shard}")
    _run(place, "merge", "shard_0", "shard_1", "--out", "merged")
    whole = {
        name: part
        for name, part in content_of(place.folder / "whole").items()
        if not name.startswith("plan/")
    }
    assert content_of(place.folder / "merged") == whole


def test_a_resumed_run_and_a_resolved_config_give_the_same_pixels(place):
    _run(place, "generate", "config.json", "--out", "again", "--clips", "many_0001,own")
    _run(place, "generate", "config.json", "--out", "again")
    assert place.pixels("again") == place.pixels("whole")
    place.write("resolved.json", place.read("whole/dataset.json")["config"])
    _run(place, "generate", "resolved.json", "--out", "from_resolved")
    assert place.pixels("from_resolved") == place.pixels("whole")


def test_passes_of_a_drawn_dataset_convert_to_the_same_frames(place):
    _run(place, "generate", "config.json", "--out", "kept", "--keep-passes")
    clips = sorted((place.folder / "kept" / "passes").glob("m*"))[:2]
    _run(place, "convert", *clips, "--config", "config.json", "--out", "converted")
    made = {clip["id"]: clip["pixels_sha256"] for clip in place.read("converted/dataset.json")["clips"]}
    assert made == {clip.name: place.pixels("whole")[clip.name] for clip in clips}


def test_views_are_found_beside_their_config_by_all_commands(veldt):
    config = _drawn()
    flight = {
        key: value for key, value in config["clips"][1]["flight"].items() if key[:4] not in ("alti", "look")
    }
    config["clips"] = [config["clips"][1] | {"flight": flight | {"views": {"file": "views.csv"}}}]
    (veldt.folder / "sub").mkdir()
    veldt.write("sub/config.json", config)
    veldt.write("sub/views.csv", "altitude_m,look_angle_deg\n35,80\n45,60\n")
    _run(veldt, "generate", "sub/config.json", "--out", "out", "--keep-passes")
    flown = veldt.read("out/dataset.json")["config"]["clips"][0]["flight"]
    assert (flown["altitude_m"], flown["look_angle_deg"]) in ((35, 80), (45, 60))
    _run(veldt, "convert", "out/passes/own", "--config", "sub/config.json", "--out", "converted")
    assert veldt.read("converted/dataset.json")["config"]["clips"][0]["flight"] == flown
    (veldt.folder / "sub" / "views.csv").unlink()
    fault = f"clips[0].flight.views: cannot read {veldt.folder / 'sub' / 'views.csv'}: no such file"
    check_fault(veldt("validate", "sub/config.json"), 2, f"sub/config.json: {fault}")


def test_flights_draw_once_for_all_their_clips(veldt):
    config = _drawn()
    flight = config["clips"][1] | {"id": "long", "duration_s": 4, "frame_rate_hz": 1, "clip_length_s": 2}
    del flight["frames"]
    config |= {"clips": [], "flights": [flight]}
    veldt.write("config.json", config)
    _run(veldt, "plan", "config.json", "--out", "plan")
    planned = veldt.read("plan/config.json")["flights"][0]
    _run(veldt, "generate", "--plan", "plan", "--out", "out")
    clips = veldt.read("out/dataset.json")["config"]["clips"]
    assert [clip["id"] for clip in clips] == ["long_0000", "long_0001"]
    for clip in clips:
        assert {key: clip[key] for key in ("flight", "sensor", "weather", "drawn")} == {
            key: planned[key] for key in ("flight", "sensor", "weather", "drawn")
        }


def test_dry_runs_and_budgets_know_drawn_clips(place):
    done = place("generate", "config.json", "--out", "dry", "--dry-run")
    assert (done.code, done.err) == (0, "")
    assert re.search(r"^many_0003 +1 +2 ", done.out, re.MULTILINE)
    assert place("budget", "config.json", "--json").json()["terms"]
    assert "0 with actors" not in place("validate", "config.json").out


def test_errors_name_the_key(veldt):
    config = _drawn()
    config["clips"][0]["flight"]["altitude_m"] = {"uniform": [50, 30]}
    veldt.write("config.json", config)
    rule = "flight.altitude_m.uniform = [50,30]; expected the lowest first"
    check_fault(veldt("validate", "config.json"), 2, f'config.json: clips[0] ("many", 5 clips).{rule}')


def test_faults_that_the_planner_finds_name_the_entry_as_well(veldt):
    config = _drawn()
    many, own = config["clips"]
    low = many | {"id": "low", "count": 3, "flight": many["flight"] | {"altitude_m": 0}}
    veldt.write("config.json", config | {"clips": [many, low, own]})
    rule = "flight.altitude_m = 0 m; expected more than 0 m above ground"
    check_fault(veldt("validate", "config.json"), 2, f'config.json: clips[1] ("low", 3 clips).{rule}')


def test_a_clip_cannot_have_a_scene_or_a_size_of_picture_of_its_own(veldt):
    config = _drawn()
    config["clips"][1]["camera"] = {"width_px": 64}
    veldt.write("config.json", config)
    rule = "camera.width_px = 64 px; expected 96 px, the dataset's: all clips have the same"
    check_fault(veldt("validate", "config.json"), 2, f"config.json: clips[1].{rule}")


def test_editors_accept_distributions():
    schema = json.loads((ROOT / "configs" / "schema" / "editor.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    for config in [_drawn(), *_shipped()]:
        jsonschema.validate(config, schema)
    for wrong in ({"unifrom": [1, 2]}, {"uniform": [1]}, {"choice": []}, 70):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(_drawn() | {"weather": {"wind_m_s": wrong}}, schema)


def _shipped() -> list[dict]:
    files = (ROOT / "configs").glob("*.json")
    configs = [json.loads(file.read_text(encoding="utf-8")) for file in files]
    return [config for config in configs if "variants" not in config]
