#!/usr/bin/env python3
"""Does Ultralytics' own loader read an export as the dataset has it?

    tests/loaders/ultralytics_check.py DATASET

Run by hand, with the packages `ultralytics` and `torch`. Exports a dataset without and with splits, in both box styles,
and reads it with check_det_dataset() and YOLODataset. Pictures, categories and boxes must be those of the COCO export,
and no picture may be missing, rejected or read without its label file. The rules that this relies on are also in
tests/cli/test_export_yolo.py, which needs no package.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import cv2
import numpy as np
from ultralytics import __version__
from ultralytics.data.dataset import YOLODataset
from ultralytics.data.utils import check_det_dataset, load_dataset_cache_file

_VELDT = Path(__file__).resolve().parents[2] / "build" / "release" / "bin" / "veldt"
_SPLITS = ((), ("--split", "train:0.5,val:0.5"))
_STYLES = ("visible", "drawn")
_WITHIN_PX = 1e-3
_PICTURE_PX = 640


def _export(options: argparse.Namespace, out: Path, *more: str) -> Path:
    command = [options.veldt, "export", options.dataset, "--out", out, "--unfinished", "--quiet", *more]
    subprocess.run(command, check=True)
    return out


def _truth(coco: Path) -> dict[str, tuple[Path, list]]:
    """By name in a YOLO export: the picture's file, and its categories and boxes (x, y, width, height in px)."""
    document = json.loads((coco / "annotations.json").read_text(encoding="utf-8"))
    videos = {video["id"]: video["name"] for video in document["videos"]}
    names = {category["id"]: category["name"] for category in document["categories"]}
    boxes: dict[int, list] = {image["id"]: [] for image in document["images"]}
    for label in document["annotations"]:
        if not label.get("ignore", 0) and not label.get("iscrowd", 0):
            boxes[label["image_id"]].append((names[label["category_id"]], *label["bbox"]))
    return {
        f"{videos[image['video_id']]}_{image['frame_index']:06d}": (
            coco / image["file_name"],
            boxes[image["id"]],
        )
        for image in document["images"]
    }


def _read(loaded: YOLODataset, index: int) -> list:
    """What the loader has read of a picture, as _truth() has it."""
    label = loaded.labels[index]
    high, wide = label["shape"]
    boxes_px = label["bboxes"] * np.array([wide, high, wide, high])
    boxes_px[:, :2] -= boxes_px[:, 2:] / 2
    names = [loaded.data["names"][int(k)] for k in label["cls"][:, 0]]
    return [(name, *box) for name, box in zip(names, boxes_px.tolist())]


def _check_scan(out: Path, split: str, pictures: int) -> None:
    """The loader's counters: labels found for each picture, none corrupt, nothing to remark."""
    scan = load_dataset_cache_file(out / "labels" / f"{split}.cache")
    found, missing, _, corrupt, total = scan["results"]
    assert (found, missing, corrupt, total) == (pictures, 0, 0, pictures), scan["results"]
    assert not scan["msgs"], scan["msgs"]


def _check_picture(loaded: YOLODataset, index: int, truth: tuple[Path, list]) -> None:
    file, boxes = truth
    read = _read(loaded, index)
    assert [each[0] for each in read] == [each[0] for each in boxes]
    for one, other in zip(read, boxes):
        assert np.abs(np.subtract(one[1:], other[1:])).max() < _WITHIN_PX, (one, other)
    picture, size, _ = loaded.load_image(index)
    grey = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
    assert grey.dtype == np.uint8 and size == grey.shape
    if max(size) == _PICTURE_PX:  # others are scaled
        assert (picture == grey[..., None]).all()


def check(options: argparse.Namespace, scratch: Path, style: str, split: tuple[str, ...]) -> str:
    """Export one way, read it, and return what was read."""
    name = f"{style}{len(split)}"
    coco = _export(options, scratch / f"coco_{name}", "--format", "coco", "--box-style", style)
    out = _export(options, scratch / f"yolo_{name}", "--format", "yolo", "--box-style", style, *split)
    truth, data = _truth(coco), check_det_dataset(str(out / "data.yaml"))
    seen: set[str] = set()
    boxes = 0
    for part in ("train", "val") if split else ("train",):
        loaded = YOLODataset(data[part], _PICTURE_PX, augment=False, data=data, task="detect")
        _check_scan(out, part, len(loaded))
        for index, file in enumerate(map(Path, loaded.im_files)):
            _check_picture(loaded, index, truth[file.stem])
            boxes += len(truth[file.stem][1])
            seen.add(file.stem)
    assert seen == set(truth)
    return f"{style} boxes, {split[1] if split else 'no split'}: {len(seen)} pictures and {boxes} boxes agree"


def main() -> None:
    """Check a dataset."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("dataset", type=Path)
    parser.add_argument("--veldt", type=Path, default=_VELDT)
    options = parser.parse_args()
    lines = []
    with tempfile.TemporaryDirectory() as scratch:
        for style in _STYLES:
            lines += [check(options, Path(scratch), style, split) for split in _SPLITS]
    print(f"ultralytics {__version__}", *lines, sep="\n")


if __name__ == "__main__":
    main()
