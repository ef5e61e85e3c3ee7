#!/usr/bin/env python3
"""Does veldt.supervision give `supervision` what the dataset has, and what supervision reads of the YOLO export?

    tests/loaders/supervision_check.py DATASET

Run by `./run loaders`, with the package `supervision`. The dataset must have no labels that are marked `ignore`.
"""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

import numpy as np
import supervision

from truth import Truth, arguments, read_truth
from veldt import open_dataset
from veldt.supervision import detections


def check_frames(truth: Truth) -> str:
    """Boxes, masks, tracks and names of every frame."""
    dataset = open_dataset(truth.folder)
    categories = list(dataset.categories)
    for frame, picture in zip(dataset.frames(), truth.pictures, strict=True):
        found = detections(frame.labels, categories)
        assert len(found) == len(picture.labels)
        if picture.labels:
            assert np.array_equal(found.xyxy, picture.corners_px())
            assert np.array_equal(found.mask, picture.masks())
            assert found.tracker_id.tolist() == picture.of("track_id")
            assert found["class_name"].tolist() == picture.of("category")
            assert [categories[k] for k in found.class_id] == picture.of("category")
            assert np.array_equal(found.area, picture.of("area"))
    return f"{len(truth.pictures)} frames: {truth.targets} boxes, masks, tracks and names agree"


def check_yolo(truth: Truth, veldt: Path) -> str:
    """Class ids and boxes are those that supervision reads of the YOLO export."""
    dataset = open_dataset(truth.folder)
    with tempfile.TemporaryDirectory() as scratch:
        out = Path(scratch) / "yolo"
        command = [veldt, "export", truth.folder, "--format", "yolo", "--out", out, "--quiet", "--unfinished"]
        subprocess.run(command, check=True)
        parts = (str(out / kind / "train") for kind in ("images", "labels"))
        read = supervision.DetectionDataset.from_yolo(*parts, str(out / "data.yaml"))
        assert read.classes == list(dataset.categories)
        for frame, picture in zip(dataset.frames(), truth.pictures, strict=True):
            theirs = read.annotations[str(out / "images" / "train" / f"{picture.name}.png")]
            ours = detections(frame.labels, read.classes, masks=False)
            assert len(theirs) == len(ours)
            if len(ours):
                assert np.array_equal(theirs.class_id, ours.class_id)
                assert np.abs(theirs.xyxy - ours.xyxy).max() < 1e-3  # the export's six digits
    return f"YOLO export: {truth.targets} classes and boxes agree"


def main() -> None:
    """Check a dataset."""
    options = arguments(__doc__)
    truth = read_truth(options.dataset)
    print(
        f"supervision {supervision.__version__}",
        check_frames(truth),
        check_yolo(truth, options.veldt),
        sep="\n",
    )


if __name__ == "__main__":
    main()
