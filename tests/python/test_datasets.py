"""Datasets as sequences."""

import json

import numpy as np
import pytest
from PIL import Image

import passes
from veldt import ConfigError, DataError, IoError, open_dataset, splits_of


def _read(file) -> np.ndarray:
    """A picture, by another reader."""
    return np.asarray(Image.open(file))


def test_clips_and_frames_are_those_of_the_files(converted):
    folder, _ = converted
    dataset = open_dataset(folder)
    assert ([clip.id for clip in dataset], len(dataset["one"])) == (["one"], passes.FRAMES)
    frame = dataset["one"][1]
    assert (frame.index, frame.time_s, frame.shutter_closed) == (1, pytest.approx(1 / 9), False)
    assert np.array_equal(frame.ir8(), _read(folder / "clips/one/ir8/000001.png"))
    counts = _read(folder / "clips/one/ir16/000001.png")
    assert np.array_equal(frame.ir16(), counts)
    assert np.array_equal(frame.ir16_k(), (counts * 0.01).astype(np.float32))
    assert [one.index for one in dataset.frames()] == [0, 1, 2]
    assert dataset["one"][1:][0].index == 1


def test_labels_have_masks_and_values(converted):
    frame = open_dataset(converted[0])["one"][0]
    walker, elephant = sorted(frame.labels, key=lambda label: label.track_id)
    assert (walker.category, walker.track_id, elephant.category) == ("human", 7, "elephant")
    assert np.array_equal(walker.mask(), passes.object_index(0) == passes.WALKER)
    assert np.array_equal(elephant.mask(), passes.object_index(0) == passes.ELEPHANT)
    assert elephant.values["truncated"]
    assert elephant.box_px == (0, 10, 5, 4)


def test_ids_and_categories_are_those_of_annotations_json(veldt, generated):
    passes.write_clip(veldt.folder / "first", "first", 4)
    (veldt.folder / "first" / "000001.exr").write_bytes(b"broken")
    passes.write_clip(veldt.folder / "second", "second")
    done = veldt("convert", "first", "second", "--out", "ids", "--quiet")
    assert done.code == 3  # a frame is skipped, and its id with it
    for dataset in (open_dataset(veldt.folder / "ids"), generated):
        document = json.loads((dataset.folder / "annotations.json").read_text(encoding="utf-8"))
        assert dataset.categories == {each["name"]: each["id"] for each in document["categories"]}
        clips = {video["id"]: video["name"] for video in document["videos"]}
        ids = {(clips[i["video_id"]], i["frame_index"]): i["id"] for i in document["images"]}
        assert {(frame.clip.id, frame.index): frame.image_id for frame in dataset.frames()} == ids


def test_splits_of_what_has_none(tmp_path):
    with pytest.raises(IoError) as fault:
        splits_of(tmp_path)
    expected = "no annotations/*.json; expected an export in COCO's format with splits"
    assert str(fault.value) == f"{tmp_path}: {expected}"
    (tmp_path / "annotations").mkdir()
    (tmp_path / "annotations" / "train.json").write_text("{", encoding="utf-8")
    with pytest.raises(DataError, match="train.json:1:2: not JSON: "):
        splits_of(tmp_path)


def test_poses_are_matrices_or_unknown(generated, converted):
    pose = generated["down"][0].camera_to_world
    assert pose.shape == (4, 4)
    assert np.allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-8)
    assert open_dataset(converted[0])["one"][0].camera_to_world is None


def test_faults(tmp_path, converted):
    with pytest.raises(IoError, match="dataset.json"):
        open_dataset(tmp_path)
    (tmp_path / "dataset.json").write_text(json.dumps({"format": "other"}), encoding="utf-8")
    with pytest.raises(DataError, match="does not belong to a Veldt dataset"):
        open_dataset(tmp_path)
    with pytest.raises(ConfigError, match='^clip = "two"; expected one of one$'):
        _ = open_dataset(converted[0])["two"]
