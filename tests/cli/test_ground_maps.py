"""Maps of the ground in the folder of a plan: when they are made, kept and made again."""

import hashlib
import json

import jsonschema
import numpy as np
import pytest

from configs import tiny
from datasets import flip_bit
from program import ROOT, Veldt

_FILES = ("ground.json", "ground.bin")
_CELLS = 120


def _config(*seasons: str) -> dict:
    config = tiny()
    config["sensor"] = {"model": "physical"}
    for clip, season in zip(config["clips"], seasons):
        clip["season"] = season
    return config


def _plan(veldt: Veldt, out: str, *options: str) -> None:
    done = veldt("plan", "config.json", "--out", out, "--quiet", *options)
    assert (done.code, done.out, done.err) == (0, "", "")


def _sums(veldt: Veldt, out: str) -> dict[str, str]:
    return {
        file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in (veldt.folder / out).glob("*.*")
    }


def _days(veldt: Veldt, out: str) -> list[int]:
    return [path["day_of_year"] for path in veldt.read(f"{out}/ground.json")["sun_paths"]]


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    veldt = Veldt(tmp_path_factory.mktemp("ground"))
    veldt.write("config.json", _config("winter", "summer"))
    _plan(veldt, "plan")
    return veldt


def _array(veldt: Veldt, name: str) -> np.ndarray:
    entry = veldt.read("plan/ground.json")["arrays"][name]
    data = (veldt.folder / "plan" / "ground.bin").read_bytes()
    count = int(np.prod(entry["shape"]))
    return np.frombuffer(data, entry["type"], count, entry["offset"]).reshape(entry["shape"])


def test_a_physical_plan_has_maps_and_their_checksums(place):
    recorded = place.read("plan/checksums.json")
    sums = _sums(place, "plan")
    assert {name: recorded[name] for name in _FILES} == {name: sums[name] for name in _FILES}
    header = place.read("plan/ground.json")
    schema = json.loads((ROOT / "configs/schema/ground_maps.schema.json").read_text(encoding="utf-8"))
    jsonschema.validate(header, schema)
    assert (header["size_m"], header["cells"]) == (120, _CELLS)
    assert header["sun_paths"] == [
        {"latitude_deg": -19.0, "day_of_year": 190},
        {"latitude_deg": -19.0, "day_of_year": 15},
    ]


def test_they_show_the_crowns_and_the_water_of_the_scene(place):
    sky, crown = _array(place, "sky_view"), _array(place, "crown_top_m")
    assert sky[crown > 3].mean() < 0.8 * sky[crown == 0].mean()
    assert 0.02 < (crown > 0).mean() < 0.5
    moisture = _array(place, "moisture")
    assert moisture[60, 60] == 255  # in the middle of the water
    assert set(np.unique(_array(place, "sunlit")[0] >> 18)) == {0}  # no sun after 18:00 in winter
    assert _array(place, "sunlit")[1].max() >> 18 == 1


def test_they_say_what_each_half_metre_is_made_of(place):
    header = place.read("plan/ground.json")
    assert header["fine_cells"] == 2 * _CELLS
    assert header["kinds"][0] == "soil"
    for name in ("kind", "grass", "trodden", "ash"):
        assert _array(place, name).shape == (2 * _CELLS, 2 * _CELLS)
    grass, kind = _array(place, "grass"), _array(place, "kind")
    assert grass.max() > 200
    assert grass[kind != 0].max(initial=0) == 0
    assert kind.max() < len(header["kinds"])
    assert _array(place, "trodden").max() > 100


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_any_number_of_threads_makes_the_same_bytes(place, threads):
    _plan(place, f"plan_{threads}", "--threads", str(threads))
    assert _sums(place, f"plan_{threads}") == _sums(place, "plan")


def test_a_published_plan_has_none_until_they_are_needed(veldt):
    veldt.write("config.json", tiny())
    _plan(veldt, "plan")
    assert not (veldt.folder / "plan" / "ground.json").exists()
    scene = (veldt.folder / "plan" / "scene.bin").stat()
    _plan(veldt, "plan", "--set", "sensor.model=physical")
    assert (veldt.folder / "plan" / "scene.bin").stat().st_ino == scene.st_ino  # not planned again
    sums, recorded = _sums(veldt, "plan"), veldt.read("plan/checksums.json")
    assert all(recorded[name] == sums[name] for name in _FILES)
    maps = (veldt.folder / "plan" / "ground.bin").stat()
    _plan(veldt, "plan")  # published again: they are kept
    _plan(veldt, "plan", "--set", "sensor.model=physical")
    assert (veldt.folder / "plan" / "ground.bin").stat().st_ino == maps.st_ino
    assert not list(veldt.folder.glob("plan.part*"))


def test_only_seasons_of_the_config_are_traced(veldt):
    veldt.write("config.json", _config("summer", "summer"))
    _plan(veldt, "plan")
    assert _days(veldt, "plan") == [15]
    _plan(veldt, "plan", "--set", "clips[0].season=winter")
    assert _days(veldt, "plan") == [190, 15]
    _plan(veldt, "plan")  # both serve one as well
    assert _days(veldt, "plan") == [190, 15]


def test_damaged_maps_are_made_again(place):
    _plan(place, "damaged")
    before = _sums(place, "damaged")
    flip_bit(place.folder / "damaged" / "ground.bin")
    _plan(place, "damaged")
    assert _sums(place, "damaged") == before


def test_damaged_maps_are_not_used(place, tmp_path):
    place.write("config.json", _config("winter", "summer") | {"render": {"engine": "embree"}})
    _plan(place, "used")
    file = place.folder / "used" / "ground.bin"
    flip_bit(file)
    done = place("generate", "--plan", "used", "--out", tmp_path / "out", "--quiet")
    place.write("config.json", _config("winter", "summer"))
    assert done.code == 1
    assert "used/ground.bin is damaged, or of another plan" in done.err


def test_progress_shows_the_maps(place):
    done = place("plan", "config.json", "--out", "shown", "--progress", "json")
    events = [json.loads(line) for line in done.err.splitlines()]
    parts = [event["parts_done"] for event in events if event["clip"] == "ground maps"]
    assert parts == list(range(1, 51))
