"""Lens distortion with `--engine embree`: the rays follow the lens, so passes, pictures and labels are exact."""

import numpy as np
import pytest

from configs import tiny
from labels import check_labels
from lenses import HEIGHT, LENS, WIDTH, behind_a_lens, check_inside
from pictures import read_planes
from program import Veldt

NAME = "k1 -0.2, k2 0.03, p1 0.001, p2 -0.0005, k3 0"


def _embree(veldt: Veldt, *options, command="generate", out="out"):
    return veldt(command, "config.json", "--out", out, "--engine", "embree", "--quiet", *options)


def _check(done) -> None:
    assert (done.code, done.out, done.err) == (0, "", "")


@pytest.fixture(scope="module", name="made")
def _made(tmp_path_factory) -> Veldt:
    """A physical dataset with its passes: every term of the radiance follows the rays."""
    veldt = Veldt(tmp_path_factory.mktemp("made"))
    names = ("place", "facing", "variation", "parts", "sky", "angular", "mirror", "path", "falloff")
    terms = dict.fromkeys(names, "on")
    settings = {"sensor": {"model": "physical"}, "terms": terms, "render": {"supersample": 1}}
    veldt.write("config.json", tiny(behind_a_lens) | settings)
    _check(_embree(veldt, "--keep-passes"))
    return veldt


@pytest.fixture(name="manifests")
def _manifests(made) -> dict[str, dict]:
    clips = made.read("config.json")["clips"]
    return {clip["id"]: made.read(f"out/passes/{clip['id']}/manifest.json") for clip in clips}


def _planes(made: Veldt, manifests: dict, channel: str) -> dict[str, np.ndarray]:
    """A plane of each frame, by the name of its picture."""
    return {
        f"clips/{clip}/ir8/{k:06d}.png": read_planes(made.folder / f"out/passes/{clip}/{k:06d}.exr")[channel]
        for clip, manifest in manifests.items()
        for k in range(len(manifest["frames"]))
    }


def test_the_passes_are_as_large_as_the_picture_and_say_which_lens_they_follow(made, manifests):
    for manifest in manifests.values():
        assert manifest["overscan_px"] == 0
        assert manifest["camera"]["distortion"] == LENS
    assert made.read("out/dataset.json")["config"]["render"]["overscan_px"] == 0
    assert {plane.shape for plane in _planes(made, manifests, "Scene.Depth.Z").values()} == {(HEIGHT, WIDTH)}


def test_labels_are_the_pixels_of_the_passes_within_half_a_pixel_of_the_actors_box(made, manifests):
    """The slack is a pinhole's: a pixel's centre is half a pixel from its edge, and poses are rounded."""
    labels = made.read("out/annotations.json")
    shown = _planes(made, manifests, "Scene.IndexOB.X")
    assert check_labels(labels, shown, manifests) > 30
    assert check_inside(labels, manifests, LENS, 0.51) > 3


def test_passes_convert_to_the_same_pixels(made, manifests):
    folders = [f"out/passes/{clip}" for clip in manifests]
    _check(made("convert", *folders, "--out", "again", "--config", "config.json", "--quiet"))
    assert made.pixels("again") == made.pixels("out")


def test_without_a_config_passes_keep_their_lens(made):
    _check(made("convert", "out/passes", "--out", "plain", "--quiet"))
    assert made.read("plain/dataset.json")["config"]["camera"]["distortion"] == LENS
    for video in made.read("plain/annotations.json")["videos"]:
        assert {key: video["camera"][key] for key in LENS} == LENS


def test_passes_convert_with_no_other_lens(made):
    done = made("convert", "out/passes", "--out", "other", "--quiet", "--set", "camera.distortion.k1=0.1")
    assert (done.code, done.out) == (2, "")
    assert done.err.endswith(
        ": camera.distortion = k1 0.1, k2 0.03, p1 0.001, p2 -0.0005, k3 0;"
        f" expected {NAME}, the lens that the rays of these passes follow\n"
    )


def test_inspect_names_the_lens(made, manifests):
    folder = f"out/passes/{next(iter(manifests))}"
    assert f"  rays follow the lens: {NAME}" in made("inspect", folder).out.splitlines()
    assert made("inspect", folder, "--json").json()["distortion"] == LENS


def test_overscan_is_refused(made):
    done = _embree(made, "--set", "render.overscan_px=4", out="wide")
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        "veldt: config.json: render.overscan_px = 4 px;"
        " expected none with the engine embree, whose rays follow the lens\n"
    )


def test_samples_where_they_matter_are_those_of_all(made):
    """The labels, that is: actors have all samples. Their surroundings have fewer, so contrasts differ a little."""

    def outlines(dataset: str) -> list[dict]:
        labels = made.read(f"{dataset}/annotations.json")["annotations"]
        return [
            {key: label[key] for key in ("image_id", "track_id", "bbox", "segmentation")} for label in labels
        ]

    finer = ("--set", "render.supersample=2")
    _check(_embree(made, *finer, out="full"))
    _check(_embree(made, *finer, "--set", "render.sampling=adaptive", out="adaptive"))
    assert outlines("full") == outlines("adaptive") and len(outlines("full")) > 30
