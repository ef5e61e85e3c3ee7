"""Frames with temperatures of the heat balance: the same however they are made, and changing with the time of day."""

import numpy as np
import pytest

from configs import tiny
from datasets import content_of
from pictures import read_grey
from program import Veldt
from reports import Page

_NO_PROGRAMS = {"PATH": "/nonexistent"}


def _config(**weather) -> dict:
    """Ground with crowns, water and actors, at sunrise."""
    config = tiny()
    config["scene"]["terrain"]["relief_m"] = 12
    config["sensor"] = {"model": "physical", "noise": {"amount": 0}}
    config["render"] = {"engine": "embree"}
    config["weather"] = {"date": "2026-07-09", "time": "06:50", "wind_m_s": 1} | weather
    for clip, start_s in zip(config["clips"], (0, 600)):
        clip.update(season="winter", start_s=start_s, frames=4)
    return config


def _make(veldt: Veldt, *arguments) -> None:
    done = veldt("generate", *arguments, "--quiet", env=_NO_PROGRAMS)
    assert (done.code, done.out, done.err) == (0, "", "")


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    veldt = Veldt(tmp_path_factory.mktemp("heat"))
    veldt.write("config.json", _config())
    assert veldt("plan", "config.json", "--out", "plan", "--quiet").code == 0
    _make(veldt, "--plan", "plan", "--out", "whole", "--threads", 1)
    return veldt


def test_threads_change_nothing(place, tmp_path):
    _make(place, "--plan", "plan", "--out", tmp_path / "out", "--threads", 3)
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")


def test_shards_merge_to_the_undivided_dataset(place, tmp_path):
    for shard in range(2):
        _make(place, "--plan", "plan", "--shard", f"{shard}/2", "--out", tmp_path / str(shard))
    sources = [tmp_path / "0", tmp_path / "1"]
    assert place("merge", *sources, "--out", tmp_path / "out", "--progress", "none").code == 0
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")


def test_a_resumed_run_is_the_undisturbed_one(place, tmp_path):
    _make(place, "--plan", "plan", "--out", tmp_path / "out", "--clips", "side")
    _make(place, "--plan", "plan", "--out", tmp_path / "out")
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")


def test_kept_passes_are_converted_to_the_same_frames(place, tmp_path):
    made = Veldt(tmp_path)
    _make(made, place.folder / "config.json", "--out", "kept", "--keep-passes")
    done = made(
        "convert", "kept/passes", "--config", place.folder / "config.json", "--out", "again", "--quiet"
    )
    assert (done.code, done.err) == (0, "")
    assert made.pixels("again") == made.pixels("kept") == place.pixels("whole")


def test_passes_with_half_of_their_maps_are_refused(place, tmp_path):
    made = Veldt(tmp_path)
    _make(made, place.folder / "config.json", "--out", "kept", "--keep-passes")
    maps = next((tmp_path / "kept" / "passes").rglob("ground.bin"))
    maps.write_bytes(maps.read_bytes()[:100])
    done = made(
        "convert", "kept/passes", "--config", place.folder / "config.json", "--out", "again", "--quiet"
    )
    assert done.code == 3 and "ground.bin" in done.err


def test_a_report_shows_the_day(place, tmp_path):
    done = place("report", "whole", "--out", tmp_path / "page.html", "--quiet")
    assert (done.code, done.err) == (0, "")
    (day,) = Page(tmp_path / "page.html").figures["days"]
    first_h, _ = zip(*day["flown_h"])
    assert day["season"] == "winter" and list(first_h) == pytest.approx([6 + 50 / 60, 7])
    heat = place("heat", "config.json", "--json").json()["days"][0]["materials"]
    for name, values_k in day["materials_k"].items():
        assert values_k[::2][:24] == pytest.approx(heat[name]["hourly_k"], abs=0.006), name


def _kelvin(veldt: Veldt, name: str, **weather) -> np.ndarray:
    """Temperatures of the first frame of a clip that looks down."""
    frames, terms = weather.pop("frames", 1), weather.pop("terms", {})
    config = _config(**weather) | {"terms": terms}
    config["clips"] = [config["clips"][0] | {"frames": frames, "frame_rate_hz": 0.1}]
    veldt.write(f"{name}.json", config)
    _make(veldt, f"{name}.json", "--out", name)
    frame = read_grey(veldt.folder / name / "clips/down/ir16/000000.png").astype(float)
    return veldt.read(f"{name}/dataset.json")["kelvin_per_count"] * frame


@pytest.mark.parametrize("time, middle", [("06:30", "06:35"), ("09:00", "09:05")])
def test_temperatures_move_within_a_long_clip(veldt, time, middle):
    """Frames of a clip of ten minutes have the temperatures of their own time: as clips of one frame then."""
    long = _kelvin(veldt, "long", time=time, frames=61)
    then = _kelvin(veldt, "then", time=time)
    moved_k = np.abs(_kelvin(veldt, "middle", time=middle) - then)
    assert moved_k.mean() > 0.1
    # Straight lines in time: what is left is their curvature.
    off_k = np.abs(long - then)
    print(
        f"{time}: moved by {moved_k.mean():.3f} K, off by {off_k.mean():.3f} K, at most {off_k.max():.3f} K"
    )
    assert off_k.mean() < 0.1 * moved_k.mean()


def _common(picture: np.ndarray) -> float:
    """Share of the pixels that have one of the three most common values."""
    counts = np.sort(np.unique(picture, return_counts=True)[1])
    return counts[-3:].sum() / picture.size


def test_dropped_terms_make_the_picture_plainer(veldt):
    """Without places and directions, each material is as warm everywhere."""
    quiet = {"variation": "off", "sky": "off", "angular": "off", "path": "off"}
    flat = _kelvin(veldt, "flat", terms=quiet | {"place": "off", "facing": "off"})
    placed = _kelvin(veldt, "placed", terms=quiet | {"place": "on", "facing": "off"})
    full = _kelvin(veldt, "full", terms=quiet)
    assert _common(flat) > 2 * _common(placed)
    assert np.abs(placed - flat).mean() > 0.2 and np.abs(full - placed).max() > 0.2


def test_water_is_bright_at_night_and_dark_at_noon(veldt):
    """Water is in the south-west corner of the picture from above; the rest is ground and crowns."""
    night, noon = (_kelvin(veldt, name, time=time) for name, time in (("night", "03:00"), ("noon", "12:30")))
    assert night.max() - night.min() > 3 and noon.max() - noon.min() > 8
    # What is warm at night is the coolest at noon: water, and ground below crowns.
    warmest = night > np.quantile(night, 0.95)
    assert noon[warmest].mean() < noon[~warmest].mean()
