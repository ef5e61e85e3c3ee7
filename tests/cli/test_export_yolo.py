"""`export --format yolo` obeys the rules of Ultralytics' loader, without needing it.

The rules are those of ultralytics 8.4.190: check_det_dataset(), img2label_paths(), check_image() and
verify_image_label() of ultralytics/data/utils.py, check_class_names() of nn/autobackend.py, get_img_files() and
load_image() of data/base.py, imread() of utils/patches.py. tests/loaders/ultralytics_check.py runs that code itself.
"""

import json
import os
from pathlib import Path

import numpy as np
import pytest
import yaml

import passes
from pictures import read_grey, write_exr
from program import Veldt

CLIPS = ("one", "two", "three")
SPLIT = ("--split", "train:0.67,val:0.33")
FORMATS = {"bmp", "jpeg", "jpg", "png", "tif", "tiff"}  # those of IMG_FORMATS that label sources have
LEAST_SIDE_PX = 10


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A place with a dataset of three clips, in `data`; the last frame of each is empty."""
    veldt = Veldt(tmp_path_factory.mktemp("yolo"))
    clips = [passes.write_clip(veldt.folder / clip, clip) for clip in CLIPS]
    ground = np.full((passes.HEIGHT, passes.WIDTH), passes.GROUND, np.float32)
    for clip in clips:
        write_exr(clip / f"{passes.FRAMES - 1:06d}.exr", {passes.OBJECTS: ground, passes.DEPTH: ground * 40})
    done = veldt("convert", *clips, "--out", "data", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt


def _made(place, out: Path, *options, source="data") -> Path:
    done = place(
        "export", source, "--out", out, "--format", "yolo", "--progress", "none", "--quiet", *options
    )
    assert (done.code, done.out, done.err) == (0, "", "")
    return out


@pytest.fixture(scope="module", name="made", params=["whole", "split", "drawn"])
def _exports(place, request) -> Path:
    options = {"whole": (), "split": SPLIT, "drawn": (*SPLIT, "--box-style", "drawn")}[request.param]
    # A folder of that name in the path must not be taken for the export's own: the loader replaces the last one.
    return _made(place, place.folder / "images" / request.param, *options)


def _data(made: Path) -> dict:
    return yaml.safe_load((made / "data.yaml").read_text(encoding="utf-8"))


def _pictures(folder: Path) -> list[str]:
    """As get_img_files() lists a folder: names with a dot, at any depth, of known endings."""
    return sorted(str(file) for file in folder.glob("**/*.*") if file.suffix[1:].lower() in FORMATS)


def _label_file(picture: str) -> Path:
    """As img2label_paths() derives it."""
    before, after = picture.rsplit(f"{os.sep}images{os.sep}", 1)
    return Path(f"{before}{os.sep}labels{os.sep}{after}".rsplit(".", 1)[0] + ".txt")


def _rows(file: Path) -> list[list[float]]:
    return [[float(word) for word in line.split()] for line in file.read_text(encoding="utf-8").splitlines()]


def _check_rows(rows: list[list[float]], categories: int) -> None:
    """What verify_image_label() asks of labels; it allows 1 % beyond the picture, we do not."""
    assert all(len(row) == 5 for row in rows)
    table = np.array(rows)
    assert table.min() >= 0 and table[:, 1:].max() <= 1
    assert (table[:, 0] % 1 == 0).all() and table[:, 0].max() < categories
    assert (table[:, 3:] > 0).all()
    assert len(np.unique(table.astype(np.float32), axis=0)) == len(
        table
    )  # it removes rows that are there twice


def test_data_yaml_has_what_the_loader_asks_for(made):
    data = _data(made)
    assert {"path", "train", "val", "names"} <= set(data) <= {"path", "train", "val", "test", "names"}
    assert all(isinstance(data[key], str) for key in ("path", "train", "val"))
    assert Path(data["path"]).is_absolute() and Path(data["path"]).samefile(made)
    assert all((made / data[key]).is_dir() for key in ("train", "val"))
    assert list(data["names"]) == list(range(len(data["names"]))) != []
    assert all(isinstance(name, str) for name in data["names"].values())
    assert not (made / "masks").exists()  # would make it a dataset for segmentation


def test_each_picture_leads_to_a_label_file(made, place):
    data = _data(made)
    found = [picture for folder in {data["train"], data["val"]} for picture in _pictures(made / folder)]
    assert len(found) == len(place.read("data/annotations.json")["images"])
    labels = [_label_file(picture) for picture in found]
    assert all(file.is_file() and made in file.parents for file in labels)
    assert set(labels) == set(made.rglob("*.txt"))


def test_labels_are_accepted(made):
    count = len(_data(made)["names"])
    tables = [_rows(file) for file in made.rglob("*.txt")]
    assert sum(not rows for rows in tables) == len(CLIPS)  # an empty frame has an empty file
    for rows in filter(None, tables):
        _check_rows(rows, count)


def test_names_belong_to_the_boxes(place, tmp_path):
    made = _made(place, tmp_path / "x")
    names = _data(made)["names"]
    document = place.read("data/annotations.json")
    categories = {category["id"]: category["name"] for category in document["categories"]}
    size = np.array([passes.WIDTH, passes.HEIGHT] * 2)
    for image in document["images"]:
        clip = document["videos"][image["video_id"] - 1]["name"]
        read = [
            (names[int(row[0])], *(np.array(row[1:]) * size))
            for row in _rows(made / f"labels/train/{clip}_{image['frame_index']:06d}.txt")
        ]
        labels = [a for a in document["annotations"] if a["image_id"] == image["id"]]
        assert [row[0] for row in read] == [categories[a["category_id"]] for a in labels]
        for row, (x, y, wide, high) in zip(read, (a["bbox"] for a in labels)):
            assert row[1:] == pytest.approx([x + wide / 2, y + high / 2, wide, high], abs=1e-6)


def test_pictures_are_grey_of_eight_bits(made):
    for picture in made.rglob("*.png"):
        pixels = read_grey(picture)  # a reader of three channels repeats the one
        assert pixels.dtype == np.uint8 and pixels.ndim == 2
        assert min(pixels.shape) >= LEAST_SIDE_PX


def test_boxes_beyond_the_picture_are_cut(place, tmp_path):
    document = place.read("data/annotations.json")
    document["annotations"][0]["bbox"] = [-5, -3, 10, 8]
    document["annotations"][1]["bbox"] = [passes.WIDTH - 2, passes.HEIGHT - 1, 50, 50]
    (place.folder / "data" / "beyond.json").write_text(json.dumps(document), encoding="utf-8")
    made = _made(place, tmp_path / "x", source="data/beyond.json")
    rows = _rows(made / "labels/train/one_000000.txt")
    _check_rows(rows, len(_data(made)["names"]))
    wide, high = passes.WIDTH, passes.HEIGHT
    assert rows[0][1:] == pytest.approx([2.5 / wide, 2.5 / high, 5 / wide, 5 / high], abs=1e-8)
    assert rows[1][1:] == pytest.approx([1 - 1 / wide, 1 - 0.5 / high, 2 / wide, 1 / high], abs=1e-8)
