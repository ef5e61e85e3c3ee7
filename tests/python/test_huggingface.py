"""`veldt.huggingface`, read by Hugging Face's `datasets`."""

import os

import numpy as np
import pytest

os.environ |= {"HF_DATASETS_OFFLINE": "1", "HF_HUB_OFFLINE": "1"}
import datasets

import passes
from raw_exr import write_exr
from veldt import ConfigError, IoError, open_dataset, splits_of
from veldt.huggingface import write_image_folder


@pytest.fixture(name="load")
def _load(tmp_path):
    """load(folder) -> splits by name."""
    return lambda folder: datasets.load_dataset(
        "imagefolder", data_dir=str(folder), cache_dir=str(tmp_path / "cache")
    )


@pytest.fixture(name="two", scope="module")
def _two(veldt):
    """A dataset of a clip with targets, and of one without, whose name is that of another split."""
    passes.write_clip(veldt.folder / "with")
    passes.write_clip(veldt.folder / "test_flight", "test_flight", 2)
    for frame in range(2):
        ground = np.full((passes.HEIGHT, passes.WIDTH), passes.GROUND, np.float32)
        planes = {passes.OBJECTS: ground, passes.DEPTH: np.full(ground.shape, 40.0)}
        write_exr(veldt.folder / "test_flight" / f"{frame:06d}.exr", planes)
    done = veldt("convert", "with", "test_flight", "--out", "two", "--quiet")
    assert (done.code, done.err) == (0, "")
    return open_dataset(veldt.folder / "two")


def test_rows_are_the_frames(generated, load, tmp_path):
    write_image_folder(generated, tmp_path / "out")
    loaded = load(tmp_path / "out")
    frames = list(generated.frames())
    assert (list(loaded), len(loaded["train"])) == (["train"], len(frames))
    names = loaded["train"].features["objects"]["category"].feature.names
    assert names == list(generated.categories) == ["human", "elephant", "zebra"]
    for row, frame in zip(loaded["train"], frames):
        assert np.array_equal(row["image"], frame.ir8())
        assert np.asarray(row["ir16"]).dtype == np.uint16 and np.array_equal(row["ir16"], frame.ir16())
        assert np.array_equal(
            (np.asarray(row["ir16"]) * row["kelvin_per_count"]).astype(np.float32), frame.ir16_k()
        )
        labels, objects = frame.labels, row["objects"]
        assert objects["bbox"] == [list(label.box_px) for label in labels]
        assert [names[k] for k in objects["category"]] == [label.category for label in labels]
        assert objects["track_id"] == [label.track_id for label in labels]
        assert objects["area"] == [np.count_nonzero(label.mask()) for label in labels]
        assert objects["rle"] == [label.values["segmentation"]["counts"] for label in labels]
    assert any(frame.labels for frame in frames)


def test_splits_are_clips_and_may_lack_targets(two, load, tmp_path):
    write_image_folder(two, tmp_path / "out", {"train": ["one"], "val": ["test_flight"]})
    loaded = load(tmp_path / "out")
    assert {name: len(part) for name, part in loaded.items()} == {"train": passes.FRAMES, "validation": 2}
    assert loaded["train"].features == loaded["validation"].features
    assert {row["clip"] for row in loaded["validation"]} == {"test_flight"}
    assert all(row["objects"]["bbox"] == [] for row in loaded["validation"])
    assert loaded["validation"]["image_id"] == [passes.FRAMES + 1, passes.FRAMES + 2]


def test_ignored_labels_are_left_out(veldt, load, tmp_path):
    passes.write_clip(veldt.folder / "small")
    done = veldt("convert", "small", "--out", "ignored", "--set", "labels.ignore_below_area_px=10", "--quiet")
    assert (done.code, done.err) == (0, "")
    dataset = open_dataset(veldt.folder / "ignored")
    marked = {label.category: label.values["ignore"] for label in dataset["one"][0].labels}
    assert marked == {"human": True, "elephant": False}
    write_image_folder(dataset, tmp_path / "out")
    assert load(tmp_path / "out")["train"][0]["objects"]["track_id"] == [9]


def test_splits_of_an_export(two, veldt, tmp_path):
    export = tmp_path / "coco"
    done = veldt(
        "export", two.folder, "--format", "coco", "--out", export, "--split", "train:0.5,val:0.5", "--quiet"
    )
    assert (done.code, done.err) == (0, "")
    assert sorted(clip for clips in splits_of(export).values() for clip in clips) == ["one", "test_flight"]
    assert set(splits_of(export)) == {"train", "val"}


def test_faults_leave_nothing(two, tmp_path):
    out = tmp_path / "out"
    expected = [
        ({"night": ["one"]}, "splits: night; expected train, validation (or val) and test, each once"),
        (
            {"val": ["one"], "validation": []},
            "splits: validation; expected train, validation (or val) and test, each once",
        ),
        ({"train": ["one"], "test": []}, "splits: test has 0 frames; expected at least one"),
        ({"train": ["one"], "test": ["one"]}, "splits: clip one twice; expected each clip in one split"),
    ]
    for splits, message in expected:
        with pytest.raises(ConfigError) as fault:
            write_image_folder(two, out, splits)
        assert str(fault.value) == message
    with pytest.raises(ConfigError, match='^clip = "three"; expected one of '):
        write_image_folder(two, out, {"train": ["three"]})
    (tmp_path / "there").mkdir()
    with pytest.raises(ConfigError) as fault:
        write_image_folder(two, tmp_path / "there")
    assert str(fault.value) == f"folder = {tmp_path / 'there'}; expected a new folder"
    assert [file.name for file in tmp_path.iterdir()] == ["there"]


def test_an_unreadable_frame_leaves_nothing(two, tmp_path, monkeypatch):
    monkeypatch.setattr("veldt.datasets.Frame.file", lambda frame, kind: tmp_path / "missing.png")
    with pytest.raises(IoError, match="missing.png"):
        write_image_folder(two, tmp_path / "out")
    assert not list(tmp_path.iterdir())
