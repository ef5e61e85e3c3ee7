"""`export --segmentation polygon`: outlines instead of run lengths (COCO) or boxes (YOLO), and how well they fit."""

import json

import numpy as np
import pytest

import passes
from program import Veldt

CLIPS = ("one", "two")


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A place with a dataset of two clips, in `data`."""
    veldt = Veldt(tmp_path_factory.mktemp("outlines"))
    clips = [passes.write_clip(veldt.folder / clip, clip) for clip in CLIPS]
    done = veldt("convert", *clips, "--out", "data", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt


def _export(place, out, *options, source="data"):
    return place("export", source, "--out", out, "--progress", "none", *options)


def _area(polygon: list) -> float:
    x, y = np.reshape(polygon, (-1, 2)).T
    return abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


def test_coco_polygons(place, tmp_path):
    done = _export(place, tmp_path / "x", "--format", "coco", "--segmentation", "polygon")
    assert (done.code, done.err) == (0, "")
    figures = "outlines of small targets: IoU with the masks 1.0000 on average, 1.0000 at least (12 labels)"
    assert done.out.splitlines()[-1] == figures
    made = json.loads((tmp_path / "x" / "annotations.json").read_text())
    whole = place.read("data/annotations.json")
    for annotation, original in zip(made["annotations"], whole["annotations"], strict=True):
        assert annotation | {"segmentation": 0} == original | {"segmentation": 0}
        assert sum(map(_area, annotation["segmentation"])) == annotation["area"]
        assert all(isinstance(number, int) for polygon in annotation["segmentation"] for number in polygon)
    # The elephant is a box, 5 x 4 px at (0, 10).
    (polygon,) = next(a["segmentation"] for a in made["annotations"] if a["category_id"] != 1)
    assert {tuple(corner) for corner in np.reshape(polygon, (-1, 2))} == {(0, 10), (5, 10), (5, 14), (0, 14)}
    record = json.loads((tmp_path / "x" / "export.json").read_text())
    assert record["request"]["segmentation"] == "polygon"
    assert record["outline_iou"] == {"small": {"targets": 12, "mean": 1.0, "least": 1.0}}


def test_coco_polygons_in_splits(place, tmp_path):
    done = _export(
        place, tmp_path / "x", "--format", "coco", "--segmentation", "polygon", "--split", "a:0.5,b:0.5"
    )
    assert (done.code, done.err) == (0, "")
    for name in "ab":
        document = json.loads((tmp_path / "x" / "annotations" / f"{name}.json").read_text())
        assert document["annotations"]
        assert all(isinstance(a["segmentation"], list) for a in document["annotations"])


def test_run_lengths_are_the_default(place, tmp_path):
    for out, options in (("x", []), ("y", ["--segmentation", "rle"])):
        assert _export(place, tmp_path / out, "--format", "coco", *options).code == 0
        labels = (tmp_path / out / "annotations.json").read_bytes()
        assert labels == (place.folder / "data" / "annotations.json").read_bytes()


def test_yolo_outlines(place, tmp_path):
    done = _export(place, tmp_path / "x", "--format", "yolo", "--segmentation", "polygon")
    assert (done.code, done.err) == (0, "")
    assert done.out.splitlines()[-1].startswith(
        "outlines of small targets: IoU with the masks 1.0000 on average"
    )
    lines = (tmp_path / "x" / "labels" / "train" / "one_000000.txt").read_text().splitlines()
    tables = {int(words[0]): np.array(words[1:], float).reshape(-1, 2) for words in map(str.split, lines)}
    corners = tables[1] * [passes.WIDTH, passes.HEIGHT]
    # Of the elephant, 0.02 px within its box of 5 x 4 px at (0, 10); seven decimals are 2.4e-6 px at most.
    assert sorted(map(tuple, corners.round(4))) == [
        (0.02, 10.02),
        (0.02, 13.98),
        (4.98, 10.02),
        (4.98, 13.98),
    ]


FAULTS = {
    "masks that YOLO has not": (
        ["--format", "yolo", "--segmentation", "rle"],
        "--segmentation = rle; expected polygon with --format yolo, or none for boxes",
    ),
    "drawn boxes and outlines": (
        ["--format", "yolo", "--segmentation", "polygon", "--box-style", "drawn"],
        "--segmentation = polygon; expected none with --box-style drawn: readers take boxes from the outlines",
    ),
    "a format without masks": (
        ["--format", "mot", "--segmentation", "polygon"],
        "--segmentation = polygon; expected none with --format mot: only coco and yolo have masks",
    ),
    "another kind": (
        ["--format", "coco", "--segmentation", "mask"],
        "--segmentation: mask not in {rle,polygon}; see veldt export --help",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_request_that_cannot_be_meant(place, name):
    options, message = FAULTS[name]
    done = _export(place, "x", *options)
    assert (done.code, done.out, done.err) == (2, "", f"veldt: {message}\n")
    assert not list(place.folder.glob("x*"))


@pytest.mark.parametrize("kind", ["coco", "yolo"])
def test_labels_without_masks(place, kind):
    document = place.read("data/annotations.json")
    del document["annotations"][3]["segmentation"]
    place.write("data/boxes.json", document)
    done = _export(place, "x", "--format", kind, "--segmentation", "polygon", source="data/boxes.json")
    rule = "expected run lengths of a mask, or polygons of three corners or more"
    assert (done.code, done.out, done.err) == (1, "", f"veldt: annotation 4: segmentation = null; {rule}\n")
    assert not list(place.folder.glob("x*"))
