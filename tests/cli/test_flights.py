"""Flights of a config are cut into clips, listed by a dry run, and made and converted like other clips."""

import json
import re

import pytest

import fake_blender
from configs import tiny

FLIGHT = {
    "id": "survey",
    "season": "summer",
    "start_s": 2,
    "duration_s": 24,
    "frame_rate_hz": 2,
    "clip_length_s": 6,
    "flight": {"pattern": "transect", "points_m": [[-50, 0], [50, 0]], "altitude_m": 30},
}


@pytest.fixture(autouse=True)
def _ready(veldt):
    fake_blender.install(veldt.folder)
    veldt.write("config.json", tiny() | {"flights": [FLIGHT]})


def _run(veldt, *arguments, out="out"):
    done = veldt(
        "generate", "config.json", "--out", out, "--blender", veldt.folder / "fake_blender", *arguments
    )
    assert (done.code, done.err) == (0, ""), done.err
    return done.out


def _dataset(veldt, out="out") -> dict:
    return json.loads((veldt.folder / out / "dataset.json").read_text())


def test_a_dry_run_lists_clips_and_flights_and_their_sizes(veldt):
    lines = _run(veldt, "--dry-run").splitlines()
    assert lines[0].split() == [
        "clip",
        "or",
        "flight",
        "clips",
        "frames",
        "with",
        "actors",
        "height",
        "[m",
        "AGL]",
    ]
    assert [line.split()[:3] for line in lines[1:5]] == [
        ["down", "1", "8"],
        ["side", "1", "8"],
        ["survey", "4", "48"],
        ["all", "6", "64"],
    ]
    assert re.fullmatch(r"about \d+ s on 2 cores, \d+ MB of disk space", lines[5])
    assert not (veldt.folder / "out").exists()


def test_a_dry_run_lists_only_what_was_chosen(veldt):
    lines = _run(veldt, "--dry-run", "--clips", "survey_0002,survey_0003").splitlines()
    assert [line.split()[:3] for line in lines[1:-1]] == [["survey", "2", "24"]]


def test_a_flight_is_made_clip_by_clip(veldt):
    assert _run(veldt, "--quiet") == ""
    dataset = _dataset(veldt)
    clips = {clip["id"]: clip for clip in dataset["config"]["clips"]}
    assert list(clips) == ["down", "side", "survey_0000", "survey_0001", "survey_0002", "survey_0003"]
    assert dataset["config"]["flights"] == []
    assert clips["survey_0002"]["of_flight"] == "survey"
    assert clips["survey_0002"]["start_s"] == 2 + 12
    assert clips["survey_0002"]["frames"] == 12
    assert {clip["status"] for clip in dataset["clips"]} == {"done"}
    assert len(list((veldt.folder / "out/clips/survey_0003/ir8").iterdir())) == 12
    again = _run(veldt)
    assert again == "out: nothing to do, 6 clips already existed\n"


def test_only_stretches_with_actors_are_kept_when_asked_for(veldt):
    everything = tiny() | {"flights": [FLIGHT]}
    veldt.write("config.json", tiny() | {"clips": [], "flights": [FLIGHT | {"keep": "with_actors"}]})
    lines = _run(veldt, "--dry-run").splitlines()
    _, _, frames, with_actors = lines[1].split()[:4]
    veldt.write("config.json", everything | {"clips": []})
    assert int(frames) < 48
    assert _run(veldt, "--dry-run").splitlines()[1].split()[3] == with_actors


def test_passes_of_a_flights_clip_are_converted_with_the_config_that_has_the_flight(veldt):
    _run(veldt, "--quiet", "--keep-passes", "--clips", "survey_0001")
    done = veldt("convert", "out/passes/survey_0001", "--out", "again", "--config", "config.json", "--quiet")
    assert (done.code, done.err) == (0, "")
    (clip,) = _dataset(veldt, "again")["clips"]
    made = next(clip for clip in _dataset(veldt)["clips"] if clip["id"] == "survey_0001")
    assert clip["season"] == "summer"
    assert clip["pixels_sha256"] == made["pixels_sha256"]


def test_the_config_of_a_dataset_makes_the_clips_of_its_flights_again(veldt):
    _run(veldt, "--quiet")
    veldt.write("config.json", _dataset(veldt)["config"])
    _run(veldt, "--quiet", out="again")
    assert _dataset(veldt, "again")["pixels_sha256"] == _dataset(veldt)["pixels_sha256"]


def test_shards_deal_out_the_clips_of_flights(veldt):
    for shard in range(3):
        _run(veldt, "--quiet", "--shard", f"{shard}/3", out=f"part_{shard}")
    made = [
        [clip["id"] for clip in _dataset(veldt, f"part_{shard}")["clips"] if clip["status"] == "done"]
        for shard in range(3)
    ]
    assert made == [["survey_0000", "survey_0003"], ["down", "survey_0001"], ["side", "survey_0002"]]


def test_a_fault_of_a_flight_is_reported_before_anything_is_made(veldt):
    veldt.write("config.json", tiny() | {"flights": [FLIGHT | {"clip_length_s": 60}]})
    done = veldt("generate", "config.json", "--out", "out", "--blender", veldt.folder / "fake_blender")
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        "veldt: config.json: flights[0].clip_length_s = 60 s; expected at most duration_s = 24 s,"
        " the length of the flight\n"
    )
    assert not (veldt.folder / "out").exists()
