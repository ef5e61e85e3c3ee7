"""Outlines of targets in the readers' own rasterisation: pycocotools for COCO, supervision (OpenCV) for YOLO."""

import contextlib
import io

import cv2
import numpy as np
import pytest
import supervision
from pycocotools.coco import COCO

OPTIONS = ("--segmentation", "polygon")


def _coco(folder) -> COCO:
    with contextlib.redirect_stdout(io.StringIO()):
        return COCO(str(folder / "annotations.json"))


def _iou(a: np.ndarray, b: np.ndarray) -> float:
    return np.count_nonzero(a & b) / np.count_nonzero(a | b)


def _parts(mask: np.ndarray) -> int:
    return cv2.connectedComponents(mask.astype(np.uint8), connectivity=8)[0] - 1


@pytest.mark.parametrize("dataset", ["masks", "march"])
def test_polygons_are_the_masks_in_pycocotools(export, dataset):
    truth, made = _coco(export(dataset, "coco")), _coco(export(dataset, "coco", *OPTIONS))
    holes = 0
    for key, annotation in made.anns.items():
        assert isinstance(annotation["segmentation"], list)
        mask = truth.annToMask(truth.anns[key])
        assert (made.annToMask(annotation) == mask).all()
        holes += cv2.connectedComponents(1 - np.pad(mask, 1), connectivity=4)[0] > 2
    assert len(made.anns) == len(truth.anns)
    assert dataset == "march" or holes > 4


def test_yolo_outlines_in_supervision(export, place):
    truth = _coco(export("masks", "coco"))
    folder = export("masks", "yolo", *OPTIONS)
    read = supervision.DetectionDataset.from_yolo(
        str(folder / "images" / "train"),
        str(folder / "labels" / "train"),
        str(folder / "data.yaml"),
        force_masks=True,
    )
    whole, several = [], []
    for image in truth.imgs.values():
        clip = truth.dataset["videos"][image["video_id"] - 1]["name"]
        found = read.annotations[str(folder / "images" / "train" / f"{clip}_{image['frame_index']:06d}.png")]
        labels = [a for a in truth.dataset["annotations"] if a["image_id"] == image["id"]]
        assert len(found) == len(labels)
        for k, label in enumerate(labels):
            mask = truth.annToMask(label).astype(bool)
            (whole if _parts(mask) == 1 else several).append(_iou(found.mask[k], mask))
            if (
                _parts(mask) == 1
            ):  # supervision rounds the box from the corners down, which are 0.02 px inside
                x, y, width, height = label["bbox"]
                assert np.abs(found.xyxy[k] - [x, y, x + width, y + height]).max() < 1
    assert len(whole) > 10 and set(whole) == {1}
    # Noise of hundreds of parts; what a single outline can say of it is limited, and the export says the same figures.
    record = place.read(folder / "export.json")["outline_iou"]
    figures = [record[size] for size in record]
    assert min(whole + several) == pytest.approx(min(f["least"] for f in figures), abs=1e-9)
    mean = sum(f["mean"] * f["targets"] for f in figures) / sum(f["targets"] for f in figures)
    assert np.mean(whole + several) == pytest.approx(mean, abs=1e-9)
