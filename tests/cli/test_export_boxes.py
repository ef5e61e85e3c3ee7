"""`export --box-style drawn` gives boxes the margin that people leave: by a rule, a known set or one's own labels."""

import json

import numpy as np
import pytest

import passes
from exports import export, export_whole, with_three_clips
from pictures import write_grey
from program import Veldt


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    return with_three_clips(tmp_path_factory.mktemp("export"))


@pytest.mark.parametrize("options", [["--format", "coco"], ["--format", "coco", "--split", "a:0.5,b:0.5"]])
def test_drawn_boxes_are_wider_and_everything_else_is_as_it_was(place, tmp_path, options):
    made = export_whole(place, tmp_path / "x", *options, "--box-style", "drawn")
    files = [made / "annotations.json"] if len(options) == 2 else sorted((made / "annotations").iterdir())
    drawn = {a["id"]: a for file in files for a in json.loads(file.read_text())["annotations"]}
    visible = json.loads((place.folder / "data" / "annotations.json").read_text())["annotations"]
    assert len(drawn) == len(visible) > 0
    for annotation in visible:
        x, y, wide, high = annotation["bbox"]
        margin = min(2.1, 0.7 + 0.1 * (wide * high) ** 0.5)
        left, top = max(x - margin, 0), max(y - margin, 0)
        right, low = min(x + wide + margin, passes.WIDTH), min(y + high + margin, passes.HEIGHT)
        assert drawn[annotation["id"]]["bbox"] == pytest.approx([left, top, right - left, low - top])
        assert drawn[annotation["id"]] | {"bbox": annotation["bbox"]} == annotation
    record = json.loads((made / "export.json").read_text())
    assert record["request"]["box_style"] == "drawn"


def test_drawn_boxes_are_in_every_format(place, tmp_path):
    labels = {}
    for style in ("visible", "drawn"):
        made = export_whole(place, tmp_path / style, "--format", "yolo", "--box-style", style)
        lines = [
            line.split() for file in sorted(made.rglob("*.txt")) for line in file.read_text().splitlines()
        ]
        labels[style] = np.array([[float(word) for word in words[1:]] for words in lines if len(words) == 5])
    assert (labels["drawn"][:, 2:] > labels["visible"][:, 2:]).all()


def _write_drawn(place, folder: str, count: int, names=("Person", "Deer")) -> None:
    """Labelled frames: people of 8 x 12 px in boxes of 16 x 15 px, animals of 10 x 6 in 20 x 20, some dark."""
    annotations = []
    (place.folder / folder / "frames").mkdir(parents=True)
    for k in range(count):
        levels = np.full((60, 80), 50, np.uint8)
        boxes = [[10 + k % 5, 20, 16, 15], [45, 20 + k % 5, 20, 20]]
        for category, (x, y, wide, high), (left, top) in zip((0, 1), boxes, ((4, 1), (5, 7))):
            levels[y + top : y + high - top - (category == 0), x + left : x + wide - left] = 50 + 100 * (
                k % 4 > 0
            )
            annotations.append(
                {"id": len(annotations), "image_id": k, "category_id": category, "bbox": [x, y, wide, high]}
            )
        write_grey(place.folder / folder / "frames" / f"{k:02d}.png", levels)
    images = [{"id": k, "file_name": f"{k:02d}.png", "width": 80, "height": 60} for k in range(count)]
    categories = [{"id": k, "name": name} for k, name in enumerate(names)]
    place.write(
        f"{folder}/labels.json", {"images": images, "annotations": annotations, "categories": categories}
    )


def test_boxes_like_those_of_other_labels(place, tmp_path):
    _write_drawn(place, "theirs", 40)
    options = ("--format", "coco", "--box-style", "drawn", "--like", "theirs/labels.json")
    done = export(place, tmp_path / "x", *options, "--like-frames", "theirs/frames")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith(
        "theirs/labels.json: people fill 0.500 x 0.800 of their boxes (30 of 40 boxes measured)\n"
        "theirs/labels.json: animals fill 0.500 x 0.300 of their boxes (30 of 40 boxes measured)\n"
    )
    record = json.loads((tmp_path / "x" / "export.json").read_text())
    assert record["request"]["box_fill"] == {
        "people": [0.5, 0.8],
        "animals": [0.5, 0.3],
        "vehicles": [0.5, 0.55],
    }
    drawn = {
        a["id"]: a["bbox"] for a in json.loads((tmp_path / "x/annotations.json").read_text())["annotations"]
    }
    for annotation in place.read("data/annotations.json")["annotations"]:
        x, y, wide, high = annotation["bbox"]
        share = {1: (0.5, 0.8), 2: (0.5, 0.3)}[annotation["category_id"]]
        across, down = (max(0, ((side - 0.6) / s - side) / 2) for side, s in zip((wide, high), share))
        left, top = max(x - across, 0), max(y - down, 0)
        right, low = min(x + wide + across, passes.WIDTH), min(y + high + down, passes.HEIGHT)
        assert drawn[annotation["id"]] == pytest.approx([left, top, right - left, low - top])


def test_boxes_like_those_of_a_known_set(place, tmp_path):
    options = ("--format", "yolo", "--box-style", "drawn", "--like", "birdsai")
    record = json.loads((export_whole(place, tmp_path / "x", *options) / "export.json").read_text())
    assert record["request"]["box_fill"]["animals"] == [0.54, 0.44]
    done = export(place, tmp_path / "x", "--format", "yolo", "--box-style", "drawn")
    assert (done.code, done.err) == (
        2,
        f"veldt: {tmp_path}/x holds another export: box_fill is only there; "
        "expected the same request, or an empty or new folder\n",
    )


@pytest.mark.parametrize(
    "options, code, message",
    [
        (["--like", "birdsai"], 2, "--like = birdsai; expected --box-style drawn beside it"),
        (
            ["--box-style", "drawn", "--like", "birdsay"],
            2,
            '--like = birdsay; expected hit_uav, birdsai or labels of your own; did you mean "birdsai"?',
        ),
        (
            ["--box-style", "drawn", "--like", "birdsai", "--like-frames", "frames"],
            2,
            "--like-frames = frames; expected none with a named style",
        ),
        (
            ["--box-style", "drawn", "--like", "few/labels.json", "--like-frames", "few/frames"],
            1,
            "few/labels.json = 18 boxes whose targets stand out; expected at least 20",
        ),
        (
            ["--box-style", "drawn", "--like", "few/labels.json"],
            1,
            "few/labels.json: no picture 00.png in few; expected the folder of its pictures as --like-frames",
        ),
    ],
)
def test_faults_of_like(place, tmp_path, options, code, message):
    if not (place.folder / "few").exists():
        _write_drawn(place, "few", 12)
    done = export(place, tmp_path / "x", "--format", "coco", *options)
    assert (done.code, done.out, done.err) == (code, "", f"veldt: {message}\n")
