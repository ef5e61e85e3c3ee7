"""`veldt video`: what is refused, and in which words."""

from __future__ import annotations

import json

import pytest

import passes
from program import check_fault, files_below
from reports import CLIPS, change, make_dataset


@pytest.fixture(name="dataset")
def _dataset(veldt):
    """Two clips of made-up passes, without poses."""
    return make_dataset(veldt)


FAULTS = {
    "no dataset": (["nowhere", "--out", "v.mp4"], 1, "nowhere does not exist"),
    "a folder of something else": (
        ["down", "--out", "v.mp4"],
        1,
        "down is not a dataset; expected a folder with dataset.json, or a clip's folder, DIR/clips/CLIP",
    ),
    "an unknown clip": (
        ["out", "--out", "v.mp4", "--clips", "down,sid"],
        2,
        '--clips = "sid"; expected a clip of out: down, side; did you mean "side"?',
    ),
    "clips of a clip": (
        ["out/clips/down", "--out", "v.mp4", "--clips", "down"],
        2,
        "--clips = down; expected none, because out/clips/down is one clip",
    ),
    "an unknown palette": (
        ["out", "--out", "v.mp4", "--palette", "turbbo"],
        2,
        '--palette = "turbbo"; expected one of white_hot, black_hot, ironbow, rainbow, inferno, viridis, turbo;'
        ' did you mean "turbo"?',
    ),
    "a range that falls": (
        ["out", "--out", "v.mp4", "--range", "300:270"],
        2,
        '--range = "300:270"; expected LO:HI in kelvin, 0 <= LO < HI <= 10000, such as 270:300',
    ),
    "another kind of file": (
        ["out", "--out", "v.avi"],
        2,
        '--out = "v.avi"; expected a name that ends in .mp4 (video), .png or .jpg (one frame)',
    ),
    "a frame of a video": (
        ["out", "--out", "v.mp4", "--frame", "1"],
        2,
        "--frame = 1; expected a picture as --out, .png or .jpg; a video shows all frames",
    ),
    "a frame past the end": (["out", "--out", "v.png", "--frame", "3"], 2, "--frame = 3; expected 0 to 2"),
    "a frame before the start": (
        ["out", "--out", "v.png", "--frame", "-1"],
        2,
        "--frame = -1; expected 0 to 2",
    ),
    "a folder as file": (
        ["out", "--out", "made.mp4"],
        2,
        '--out = "made.mp4"; expected a file, not a folder',
    ),
    "no such folder": (
        ["out", "--out", "nowhere/v.mp4"],
        1,
        "cannot write nowhere/v.mp4.tmp: No such file or directory",
    ),
    "no such folder for a picture": (
        ["out", "--out", "nowhere/v.png"],
        1,
        "cannot write nowhere/v.png.tmp: No such file or directory",
    ),
}


@pytest.mark.usefixtures("dataset")
@pytest.mark.parametrize("name", FAULTS)
def test_a_request_that_cannot_be_met(veldt, name):
    arguments, code, message = FAULTS[name]
    (veldt.folder / "made.mp4").mkdir()
    before = files_below(veldt.folder)
    done = veldt("video", *arguments, "--progress", "none")
    assert (done.code, done.out, done.err) == (code, "", f"veldt: {message}\n")
    assert files_below(veldt.folder) == before


def _video(veldt, *options):
    return veldt("video", "out", "--out", "v.mp4", "--progress", "none", *options)


def test_a_missing_frame_is_named_and_leaves_no_video(veldt, dataset):
    (dataset / "clips" / "side" / "ir8" / "000002.png").unlink()
    before = files_below(veldt.folder)
    done = _video(veldt)
    assert (done.code, done.out) == (1, "")
    assert done.err == "veldt: cannot read out/clips/side/ir8/000002.png: no such file\n"
    assert files_below(veldt.folder) == before
    assert _video(veldt, "--range", "250:300").code == 0  # which is made of ir16


def test_missing_labels_are_named_where_they_are_asked_for(veldt, dataset):
    (dataset / "clips" / "down" / "labels.json").unlink()
    assert _video(veldt).code == 0
    for option in ("--boxes", "--tracks"):
        done = _video(veldt, option)
        assert (done.code, done.err) == (
            1,
            "veldt: cannot read out/clips/down/labels.json: No such file or directory\n",
        )


def test_a_clip_that_is_not_made_is_left_out_and_named(veldt, dataset):
    def fail(record):
        record["clips"][1] = {"id": "side", "status": "failed", "reason": "Blender was killed"}

    change(dataset / "dataset.json", fail)
    done = _video(veldt)
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("v.mp4: 1 clip, 1280 x ")
    assert done.out.endswith("left out, because not made: side\n")
    done = _video(veldt, "--clips", "side")
    assert (done.code, done.out, done.err) == (1, "", "veldt: out: clip side is not made\n")


def test_more_clips_than_a_grid_holds_are_refused(veldt, dataset):
    def multiply(record):
        record["clips"] = [record["clips"][0] | {"id": f"c{k}"} for k in range(17)]

    change(dataset / "dataset.json", multiply)
    done = _video(veldt)
    assert (done.code, done.out) == (2, "")
    assert done.err == "veldt: out has 17 clips; expected at most 16 in one video, chosen by --clips\n"


def test_an_id_that_leads_elsewhere_is_refused(veldt, dataset):
    change(dataset / "dataset.json", lambda record: record["clips"][0].update(id="../../elsewhere"))
    done = _video(veldt)
    assert (done.code, done.out) == (1, "")
    assert done.err.startswith(
        'veldt: out/dataset.json: clips[0].id = "../../elsewhere"; expected a name of '
    )


def test_damaged_records_are_named_with_their_line(veldt, dataset):
    frames = dataset / "clips" / "side" / "frames.jsonl"
    lines = frames.read_text(encoding="utf-8").splitlines()
    frames.write_text("\n".join([lines[0], lines[1][:40], lines[2]]), encoding="utf-8")
    done = _video(veldt)
    assert (done.code, done.out) == (1, "")
    assert done.err.startswith("veldt: out/clips/side/frames.jsonl:2: not a frame of a clip: ")
    frames.write_text("\n".join([lines[0], lines[0]]), encoding="utf-8")
    assert _video(veldt).err == (
        "veldt: out/clips/side/frames.jsonl:2: frame_index = 0; expected rising ones\n"
    )


def test_datasets_without_a_common_clip_are_refused(veldt, dataset):
    assert dataset.name == "out" and CLIPS == ("down", "side")
    other = veldt.folder / "other"
    other.mkdir()
    record = veldt.read("out/dataset.json")
    record["clips"] = [clip | {"id": "up"} for clip in record["clips"][:1]]
    (other / "dataset.json").write_text(json.dumps(record), encoding="utf-8")
    done = _video(veldt, "--side-by-side", "other")
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        "veldt: --side-by-side other has none of the clips down, side; expected the same ids\n"
    )


def test_a_scale_of_local_gain_control_needs_a_range(veldt):
    """A level has no temperature of its own in mode clahe."""
    folder = passes.write_clip(veldt.folder / "one")
    made = veldt("convert", folder, "--out", "out", "--quiet", "--set", "sensor.agc.mode=clahe")
    assert (made.code, made.err) == (0, "")
    lines = (veldt.folder / "out" / "clips" / "one" / "frames.jsonl").read_text(encoding="utf-8").splitlines()
    agc = json.loads(lines[0])["agc"]
    assert agc["mode"] == "clahe" and agc["low_k"] < agc["high_k"]
    assert "thresholds" not in agc
    assert veldt("video", "out", "--out", "v.mp4", "--quiet").code == 0
    assert veldt("video", "out", "--out", "v.mp4", "--scale", "--range", "250:310", "--quiet").code == 0
    check_fault(
        veldt("video", "out", "--out", "v.mp4", "--scale"),
        2,
        "--scale: clip one has the gain control clahe, whose levels depend on the place; expected --range as well, "
        "or no --scale",
    )
