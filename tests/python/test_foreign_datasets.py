"""Datasets that somebody else made or changed: nothing is read from elsewhere, and faults have their place."""

import json
import os
import shutil

import numpy as np
import pytest

os.environ |= {"HF_DATASETS_OFFLINE": "1", "HF_HUB_OFFLINE": "1"}

import passes
from veldt import DataError, Error, IoError, open_dataset, splits_of
from veldt.huggingface import write_image_folder


@pytest.fixture(name="foreign")
def _foreign(converted, tmp_path):
    """A copy of a dataset, to be changed, beside a private file."""
    shutil.copytree(converted[0], tmp_path / "out")
    shutil.copy(converted[0] / "clips/one/ir8/000000.png", tmp_path / "secret")
    return tmp_path / "out"


def _read_all(folder) -> None:
    """Everything that the package reads of a dataset."""
    dataset = open_dataset(folder)
    _ = (dataset.categories, dataset.kelvin_per_count, dataset.config)
    for clip in dataset:
        _ = (clip.record, clip.frame_rate_hz)
        for frame in clip:
            _ = (frame.time_s, frame.camera_to_world, frame.image_id, frame.ir8(), frame.ir16())
            _ = [label.mask() for label in frame.labels]


FILES = [
    "dataset.json",
    "annotations.json",
    "clips",
    "clips/one",
    "clips/one/clip.json",
    "clips/one/frames.jsonl",
]
FILES += ["clips/one/labels.json", "clips/one/ir8", "clips/one/ir8/000001.png", "clips/one/ir16/000002.png"]


@pytest.mark.parametrize("name", FILES)
def test_no_link_is_followed(foreign, name):
    _read_all(foreign)
    (foreign / name).rename(foreign.parent / "moved")
    (foreign / name).symlink_to(foreign.parent / "moved")
    with pytest.raises(IoError, match="link"):
        _read_all(foreign)


@pytest.mark.parametrize("name", ["clips/one/ir8/000001.png", "clips/one/ir16", "clips/one"])
def test_nothing_from_elsewhere_gets_into_a_folder_to_be_shared(foreign, tmp_path, name):
    (foreign / name).rename(foreign.parent / "moved")
    (foreign / name).symlink_to(foreign.parent / "moved")
    with pytest.raises(IoError, match="link"):
        write_image_folder(open_dataset(foreign), tmp_path / "shared")
    assert not (tmp_path / "shared").exists()


@pytest.mark.parametrize("name", [name for name in FILES if "." in name])
def test_a_pipe_is_no_file(foreign, name):
    (foreign / name).unlink()
    os.mkfifo(foreign / name)
    with pytest.raises(Error):
        _read_all(foreign)


def _annotation(change):
    def apply(document):
        change(document["annotations"][0])

    return apply


@pytest.mark.parametrize(
    "name, change, reason",
    [
        (
            "dataset.json",
            lambda d: d["config"].pop("sensor"),
            "config.sensor.kelvin_per_count = nothing; expected a number",
        ),
        ("dataset.json", lambda d: d.pop("clips"), "dataset.json: clips = missing; expected a list"),
        (
            "annotations.json",
            lambda d: d.pop("categories"),
            'annotations.json: no list "categories" before its images',
        ),
        (
            "clips/one/clip.json",
            lambda d: d.pop("frame_rate_hz"),
            "clip.json: frame_rate_hz = nothing; expected one",
        ),
        (
            "clips/one/labels.json",
            lambda d: d["images"].clear(),
            r"annotations\[0\].image_id = 1; expected the id",
        ),
        (
            "clips/one/labels.json",
            _annotation(lambda a: a.pop("ignore")),
            r"annotations\[0\].ignore = nothing",
        ),
        (
            "clips/one/labels.json",
            _annotation(lambda a: a.update(bbox=[0] * 3)),
            r"annotations\[0\].bbox = \[0,0,0\]",
        ),
        (
            "clips/one/labels.json",
            _annotation(lambda a: a["segmentation"].update(size=[50_000, 50_000])),
            "size of a mask = 50000 x 50000 px; expected 1 to 256000000 px in all",
        ),
        (
            "clips/one/labels.json",
            _annotation(lambda a: a["segmentation"].update(size=[10_000, 10_000])),
            "run lengths = 384 px; expected 100000000 px, as the picture has",
        ),
        (
            "clips/one/labels.json",
            _annotation(lambda a: a["segmentation"].update(counts="\x7f")),
            "are not a COCO mask",
        ),
    ],
)
def test_faults_name_the_file_and_the_value(foreign, name, change, reason):
    document = json.loads((foreign / name).read_text(encoding="utf-8"))
    change(document)
    (foreign / name).write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(DataError, match=reason):
        _read_all(foreign)


@pytest.mark.parametrize("name", [name for name in FILES if name.endswith(("json", "jsonl"))])
@pytest.mark.parametrize("text", ["", "{", "[" * 100_000, "[1]", '{"a": 1e999}', "\udcff", "null"])
def test_whatever_a_file_says_the_errors_are_the_packages(foreign, name, text):
    (foreign / name).write_text(text, encoding="utf-8", errors="surrogateescape")
    if name.endswith("frames.jsonl") and not text:
        return  # a clip without frames
    with pytest.raises(Error, match=name.rpartition("/")[2]):
        _read_all(foreign)


def test_a_category_that_annotations_json_lacks(foreign, tmp_path):
    dataset = open_dataset(foreign)
    assert dataset.category_id("human") == dataset.categories["human"]
    with pytest.raises(DataError, match='category = "lion"; expected one of annotations.json: '):
        dataset.category_id("lion")
    file = foreign / "clips/one/labels.json"
    file.write_text(file.read_text(encoding="utf-8").replace('"human"', '"lion"'), encoding="utf-8")
    with pytest.raises(DataError, match='category = "lion"'):
        write_image_folder(open_dataset(foreign), tmp_path / "shared")


def test_a_head_without_images_takes_memory_of_one_entry(tmp_path):
    (tmp_path / "annotations").mkdir()
    file = tmp_path / "annotations" / "train.json"
    entry = {"id": 1, "name": "x" * 1000}
    file.write_text(
        json.dumps({"categories": [entry], "videos": [entry] * 4, "more": [entry] * 40_000}), encoding="utf-8"
    )
    assert splits_of(tmp_path) == {"train": ["x" * 1000] * 4}


def test_masks_are_the_pixels(converted):
    label = open_dataset(converted[0])["one"][0].labels[0]
    assert np.count_nonzero(label.mask()) == label.values["area"]
    assert label.mask().shape == (passes.HEIGHT, passes.WIDTH)
