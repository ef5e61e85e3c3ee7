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


def _array(veldt: Veldt, name: str, out: str = "plan") -> np.ndarray:
    entry = veldt.read(f"{out}/ground.json")["arrays"][name]
    data = (veldt.folder / out / "ground.bin").read_bytes()
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
    seen = sky < 255
    assert sky[seen & (crown > 3)].mean() < 0.8 * sky[seen & (crown == 0)].mean()
    assert 0.02 < (crown > 0).mean() < 0.5
    moisture = _array(place, "moisture")
    assert moisture[60, 60] == 255  # in the middle of the water
    assert set(np.unique(_array(place, "sunlit")[0] >> 18)) == {0}  # no sun after 18:00 in winter
    assert _array(place, "sunlit")[1].max() >> 18 == 1


def test_they_say_what_each_half_metre_is_made_of(place):
    header = place.read("plan/ground.json")
    assert header["fine_cells"] == 2 * _CELLS
    assert header["kinds"][0] == "soil"
    for name in ("kind", "border", "grass", "trodden", "ash"):
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


def test_progress_counts_their_cells(place):
    done = place("plan", "config.json", "--out", "shown", "--progress", "json")
    events = [json.loads(line) for line in done.err.splitlines()]
    cells = [event for event in events if event["clip"] == "ground maps"]
    assert len({event["cells_total"] for event in cells}) == 1
    assert 0 < cells[-1]["cells_done"] == cells[-1]["cells_total"] <= _CELLS**2


def _seen_from_above(veldt: Veldt) -> Veldt:
    """A config whose only clip looks down on a part of the place."""
    config = _config("winter", "summer")
    flight = {"pattern": "transect", "points_m": [[-30, 25], [30, 25]], "altitude_m": 20, "speed_m_s": 5}
    config["clips"] = [config["clips"][0] | {"flight": flight | {"look_angle_deg": 90}}]
    veldt.write("config.json", config)
    return veldt


def _lit(veldt: Veldt, out: str) -> tuple[np.ndarray, np.ndarray]:
    return _array(veldt, "sky_view", out), _array(veldt, "sunlit", out)[0]


def test_light_is_traced_and_ground_is_detailed_where_a_clip_can_see(veldt):
    _seen_from_above(veldt)
    _plan(veldt, "seen")
    _plan(veldt, "whole", "--set", "render.posed_actors=all", "--set", "render.engine=embree")
    sky, sun = _lit(veldt, "seen")
    whole_sky, whole_sun = _lit(veldt, "whole")
    open_hours = np.bitwise_or.reduce(whole_sun, axis=None)
    is_open = (sky == 255) & (sun == open_hours)
    assert 0.05 < (~is_open).mean() < 0.6
    assert np.array_equal(sun[~is_open], whole_sun[~is_open])
    assert np.abs(sky[~is_open].astype(int) - whole_sky[~is_open]).mean() < 0.05
    track = veldt.read(next((veldt.folder / "seen/tracks").glob("*.json")).relative_to(veldt.folder))
    entry = track["arrays"]["camera_to_world"]
    data = next((veldt.folder / "seen/tracks").glob("*.bin")).read_bytes()
    poses = np.frombuffer(data, entry["type"], int(np.prod(entry["shape"])), entry["offset"]).reshape(
        -1, 4, 4
    )
    for x_m, y_m in poses[:, :2, 3]:
        row, column = int(y_m + 60), int(x_m + 60)
        around = np.s_[row - 5 : row + 6, column - 5 : column + 6]
        assert np.array_equal(sun[around], whole_sun[around])
    for name in ("height_m", "crown_top_m", "moisture"):
        assert np.array_equal(*(_array(veldt, name, out)[~is_open] for out in ("seen", "whole"))), name
    fine = np.repeat(np.repeat(~is_open, 2, axis=0), 2, axis=1)
    for name in ("kind", "grass"):
        assert np.array_equal(*(_array(veldt, name, out)[fine] for out in ("seen", "whole"))), name


def test_other_flights_make_other_maps(veldt):
    _seen_from_above(veldt)
    _plan(veldt, "plan")
    before = _lit(veldt, "plan")
    _plan(veldt, "plan", "--set", "clips[0].flight.points_m=[[-30,-40],[30,-40]]")
    elsewhere = _lit(veldt, "plan")
    assert (before[0][:60] == 255).mean() > 0.99 > 0.9 > (elsewhere[0][:60] == 255).mean()
    _plan(veldt, "again", "--set", "clips[0].flight.points_m=[[-30,-40],[30,-40]]")
    assert _sums(veldt, "again")["ground.bin"] == _sums(veldt, "plan")["ground.bin"]
