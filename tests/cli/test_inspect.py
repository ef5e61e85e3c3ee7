"""`inspect` tells what is in passes and what `convert` would make of them."""

import numpy as np
import pytest

import passes
from pictures import write_exr

SIZE = passes.HEIGHT * passes.WIDTH


@pytest.fixture(name="clip")
def _clip(veldt):
    return passes.write_clip(veldt.folder / "one")


def test_in_words(veldt, clip):
    done = veldt("inspect", "one/000000.exr")
    assert (done.code, done.err) == (0, "")
    index = passes.object_index(0)
    pixels = {number: f"{np.count_nonzero(index == number):>9} px" for number in (0, 1, 4, 101, 102)}
    assert done.out.splitlines() == [
        "one/000000.exr",
        "  24 x 16 px, compression ZIP",
        "channels",
        "  Scene.Depth.Z                float",
        "  Scene.IndexOB.X              float",
        "object indices",
        f"      0 {pixels[0]}  sky",
        f"      1 {pixels[1]}  ground",
        f"      4 {pixels[4]}  shrub",
        f"    101 {pixels[101]}  walker",
        f"    102 {pixels[102]}  cow",
        "depth",
        "  40.00 m to 40.00 m",
        "conversion",
        "  objects from Scene.IndexOB.X, materials from the objects, meanings from manifest.json",
    ]
    assert clip.exists()


def test_a_folder_shows_its_first_frame_and_counts_them(veldt, clip):
    report = veldt("inspect", "one", "--json").json()
    assert (report["file"], report["files"]) == ("one/000000.exr", 3)
    assert veldt("inspect", clip).out.splitlines()[1] == "  24 x 16 px, compression ZIP; the first of 3 files"


def test_in_json(veldt, clip):
    write_exr(
        clip / "000001.exr", {passes.OBJECTS: passes.object_index(1), "Scene.IndexMA.X": np.zeros((16, 24))}
    )
    report = veldt("inspect", "one/000001.exr", "--json").json()
    objects = report.pop("objects")
    assert report == {
        "file": "one/000001.exr",
        "files": 1,
        "width_px": 24,
        "height_px": 16,
        "compression": "ZIP",
        "channels": [
            {"name": "Scene.IndexMA.X", "part": 0, "type": "float"},
            {"name": "Scene.IndexOB.X", "part": 0, "type": "float"},
        ],
        "depth": None,
        "conversion": "objects from Scene.IndexOB.X, materials from Scene.IndexMA.X, meanings from manifest.json",
    }
    assert [entry["index"] for entry in objects] == [0, 1, 4, 101, 102]
    assert sum(entry["pixels"] for entry in objects) == SIZE


def test_overscan_is_told(veldt, clip):
    passes.write_manifest(clip, passes.manifest() | {"overscan_px": 2})
    assert veldt("inspect", "one").out.splitlines()[2] == "  2 of the camera's px on every side are overscan"
    assert veldt("inspect", "one", "--json").json()["overscan_px"] == 2


def test_without_a_manifest(veldt, clip):
    (clip / "manifest.json").unlink()
    report = veldt("inspect", "one", "--json").json()
    assert [entry["name"] for entry in report["objects"]] == ["sky", "", "", "", ""]
    assert report["conversion"] == (
        "objects from Scene.IndexOB.X, materials from the objects, needs a manifest (--manifest FILE)"
    )


def test_an_index_the_manifest_lacks_is_marked(veldt, clip):
    passes.change_index(clip, 0, 77)
    names = {entry["index"]: entry["name"] for entry in veldt("inspect", "one", "--json").json()["objects"]}
    assert names[77] == "not in the manifest"


def test_passes_that_cannot_be_converted_are_described_all_the_same(veldt, clip):
    write_exr(clip / "000000.exr", {"Scene.Depth.Z": np.full((16, 24), 12.5)})
    done = veldt("inspect", "one", "--json")
    report = done.json()
    assert (done.code, report["objects"]) == (0, [])
    assert report["depth"] == {"nearest_m": 12.5, "farthest_m": 12.5}
    assert report["conversion"] == "cannot be converted: no object index channel, such as Scene.IndexOB.X"


def test_an_index_that_is_none_is_told(veldt, clip):
    passes.change_index(clip, 0, -3)
    report = veldt("inspect", "one", "--json").json()
    assert [channel["name"] for channel in report["channels"]] == [passes.OBJECTS]
    assert report["conversion"] == (
        f"cannot be converted: {passes.OBJECTS} at pixel (3, 2) = -3; expected a whole number from 0 to 32767"
    )


FAULTS = {
    "missing": ("none.exr", "cannot read none.exr: there is no such file"),
    "no EXR": (
        "text.exr",
        "cannot read text.exr: not an EXR file (its first bytes are others)",
    ),
    "folder without frames": ("empty", "empty holds no .exr file"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_fault(veldt, name):
    what, message = FAULTS[name]
    (veldt.folder / "empty").mkdir()
    veldt.write("text.exr", "not an EXR file")
    done = veldt("inspect", what)
    assert (done.code, done.out, done.err) == (1, "", f"veldt: {message}\n")
