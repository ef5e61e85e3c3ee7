"""`output.link` and `sensor.processing`: 8-bit frames alone pass through a processor and an analogue link."""

import json

import numpy as np
import pytest

from configs import QUIET_LINK, tiny
from pictures import read_grey
from program import Veldt

PHYSICAL = {"preset": "boson_640_14mm"}


def _made(veldt, name: str, sensor: dict, output: dict, terms: dict) -> None:
    config = tiny(lambda one: one.update(sensor=PHYSICAL | sensor, output=output, terms=terms))
    veldt.write(f"{name}.json", config | {"clips": config["clips"][:1]})
    done = veldt("generate", f"{name}.json", "--out", name, "--engine", "embree", "--quiet")
    assert (done.code, done.err) == (0, "")


@pytest.fixture(name="made", scope="module")
def _veldt_made(tmp_path_factory) -> Veldt:
    veldt = Veldt(tmp_path_factory.mktemp("link"))
    _made(veldt, "plain", {}, {}, {"smear": "on"})
    _made(veldt, "linked", {}, {"preset": "analogue_pal"}, {"smear": "on"})
    _made(veldt, "combed", {}, {"link": QUIET_LINK}, {"smear": "on"})
    _made(veldt, "still", {}, {"link": QUIET_LINK}, {"smear": "off"})
    _made(veldt, "sharp", {}, {}, {"smear": "off"})
    _made(veldt, "halos", {"processing": {"unsharp_amount": 1}}, {}, {"smear": "on"})
    return veldt


def _frames(veldt, name: str, kind: str) -> np.ndarray:
    folder = veldt.folder / name / "clips" / "down" / kind
    return np.array([read_grey(file) for file in sorted(folder.iterdir())], float)


def test_16_bit_frames_and_labels_know_nothing_of_it(made):
    for name in ("linked", "combed", "halos"):
        assert np.array_equal(_frames(made, name, "ir16"), _frames(made, "plain", "ir16"))
        assert made.read(f"{name}/annotations.json") == made.read("plain/annotations.json")
        difference = np.abs(_frames(made, name, "ir8") - _frames(made, "plain", "ir8"))
        assert 0 < difference.mean() < 20
        assert made("validate", name).code == 0


def test_what_moves_is_combed_and_only_if_it_is_known_to(made):
    assert np.abs(_frames(made, "combed", "ir8") - _frames(made, "plain", "ir8")).mean() > 0.1  # 0.1 px or so
    assert np.array_equal(_frames(made, "still", "ir8"), _frames(made, "sharp", "ir8"))


def _first_line(made, name: str) -> dict:
    file = made.folder / name / "clips" / "down" / "frames.jsonl"
    return json.loads(file.read_text(encoding="utf-8").splitlines()[0])


def test_frames_say_whether_levels_are_kelvin(made):
    invertible = {name: _first_line(made, name)["agc"]["invertible"] for name in ("plain", "linked", "halos")}
    assert invertible == {"plain": True, "linked": False, "halos": False}


def test_it_is_recorded_and_refused_by_name(made):
    output = made.read("linked/dataset.json")["config"]["output"]
    assert output["preset"] == "analogue_pal"
    assert (output["link"]["standard"], output["link"]["lines"]) == ("pal", "standard")
    assert output["link"]["noise_levels"] == 3
    done = made("validate", "linked.json", "--set", "output.link.standard=secam")
    assert done.code == 2
    assert 'output.link.standard = "secam"; expected one of pal, ntsc' in done.err


def test_the_config_of_a_dataset_generates_the_same_frames_again(made):
    plan = json.loads((made.folder / "linked" / "dataset.json").read_text(encoding="utf-8"))["config"]
    made.write("again.json", plan)
    done = made("generate", "again.json", "--out", "again", "--quiet")
    assert (done.code, done.err) == (0, "")
    assert np.array_equal(_frames(made, "again", "ir8"), _frames(made, "linked", "ir8"))
