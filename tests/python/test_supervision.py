"""`veldt.supervision`: labels as detections."""

import numpy as np
import pytest
import supervision

import passes
from veldt import ConfigError, open_dataset
from veldt.supervision import detections


def test_labels_have_their_boxes_masks_and_tracks(converted):
    dataset = open_dataset(converted[0])
    for frame in dataset["one"]:
        found = detections(frame.labels, ["zebra", *dataset.categories])
        order = np.argsort(found.tracker_id)
        plane = passes.object_index(frame.index)
        truth = np.array([plane == index for index in (passes.WALKER, passes.ELEPHANT)])
        assert np.array_equal(found.mask[order], truth)
        assert np.array_equal(found.xyxy, supervision.mask_to_xyxy(found.mask) + [0, 0, 1, 1])
        assert found.tracker_id[order].tolist() == [7, 9]
        assert found["class_name"][order].tolist() == ["human", "elephant"]
        assert found.class_id[order].tolist() == [1, 2]


def test_detections_can_be_drawn_and_sorted(converted):
    frame = open_dataset(converted[0])["one"][0]
    found = detections(frame.labels, ["human", "elephant"])
    people = found[found.class_id == 0]
    grey = np.repeat(frame.ir8()[..., None], 3, 2)
    drawn = supervision.MaskAnnotator(opacity=1).annotate(grey.copy(), people)
    assert np.array_equal((drawn != grey).any(2), people.mask[0])


def test_frames_without_labels_and_masks_left_out(converted):
    assert detections([], ["human"]) == supervision.Detections.empty()
    frame = open_dataset(converted[0])["one"][0]
    assert detections(frame.labels, ["human", "elephant"], masks=False).mask is None


def test_unknown_categories_are_an_error(converted):
    frame = open_dataset(converted[0])["one"][0]
    with pytest.raises(ConfigError, match="elephant"):
        detections(frame.labels, ["human"])
