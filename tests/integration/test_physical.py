"""The model `physical` and supersampling with passes of a real Blender, up to the dataset on disk."""

import struct

import pytest

from configs import tiny


def _physical(config: dict) -> None:
    config["sensor"] = {"model": "physical", "netd_mk": 40}
    config["render"]["supersample"] = 2
    for clip in config["clips"]:
        clip["frames"] = 2


@pytest.fixture(name="made")
def _made(veldt, blender):
    """A dataset with every term weighed, two pixels rendered for each of the camera's both ways."""
    veldt.write("config.json", tiny(_physical))
    done = veldt("generate", "config.json", "--out", "out", "--keep-passes", "--quiet", "--blender", blender)
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt


def test_passes_are_finer_than_frames(made):
    passes = made("inspect", "out/passes/down", "--json").json()
    assert (passes["width_px"], passes["height_px"]) == (192, 160)
    png = (made.folder / "out/clips/down/ir8/000000.png").read_bytes()
    assert struct.unpack(">II", png[16:24]) == (96, 80)
    for annotation in made.read("out/annotations.json")["annotations"]:
        x, y, width, height = annotation["bbox"]
        assert 0 <= x and x + width <= 96 and 0 <= y and y + height <= 80


def test_the_dataset_says_which_terms_it_kept(made):
    terms = {term["term"]: term for term in made.read("out/dataset.json")["physics"]["terms"]}
    budget = made("budget", "config.json", "--json").json()
    assert list(terms.values()) == budget["terms"]
    assert terms["sky"]["kept"] and terms["path"]["kept"] and terms["variation"]["kept"]
    netd_mk = 40
    for term in terms.values():
        assert term["choice"] == "auto"
        possible = term["term"] != "mirror"  # Blender's passes do not show what water mirrors
        assert term["kept"] == (possible and term["spread_mk"] > netd_mk / 3)


def test_threads_and_conversion_again_change_no_pixel(made):
    for threads in ("1", "2"):
        done = made(
            "convert",
            "out/passes",
            "--out",
            threads,
            "--config",
            "config.json",
            "--threads",
            threads,
            "--quiet",
        )
        assert (done.code, done.out, done.err) == (0, "", "")
        assert made.pixels(threads) == made.pixels("out")


def test_terms_change_the_picture(made):
    """The same passes look different without the sky's reflection, and with the published model."""
    seen = {made.pixels("out")["all"]}
    for setting in ("terms.sky=off", "sensor.model=published"):
        done = made(
            "convert", "out/passes", "--out", setting, "--config", "config.json", "--set", setting, "--quiet"
        )
        assert (done.code, done.out, done.err) == (0, "", "")
        seen.add(made.pixels(setting)["all"])
    assert len(seen) == 3
