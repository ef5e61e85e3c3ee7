#!/usr/bin/env python3
"""Does Ultralytics' own loader read an export as the dataset has it?

    tests/loaders/ultralytics_check.py DATASET

Run by `./run loaders`, with the packages `ultralytics` and `torch`. Exports a dataset without and with splits, in both
box styles, and reads it with check_det_dataset() and YOLODataset. Pictures, categories and boxes must be those of the
COCO export, and no picture may be missing, rejected or read without its label file. The rules that this relies on are
also in tests/cli/test_export_yolo.py, which needs no package.

Outlines (--segmentation polygon), drawn as Ultralytics draws them, must fit the masks as well as export.json says. The
masks that it trains on are drawn through a thousand points along each outline, and may differ on its border alone.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import tempfile
from pathlib import Path

import cv2
import numpy as np

os.environ |= {"YOLO_OFFLINE": "true", "YOLO_VERBOSE": "false"}
from ultralytics import __version__
from ultralytics.cfg import get_cfg
from ultralytics.data.dataset import YOLODataset
from ultralytics.data.utils import check_det_dataset, load_dataset_cache_file, polygon2mask

from truth import Picture, Truth, arguments, read_truth

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


def _iou(one: np.ndarray, other: np.ndarray) -> float:
    return np.count_nonzero(one & other) / np.count_nonzero(one | other)


def _is_at_border(pixels: np.ndarray, mask: np.ndarray) -> bool:
    """Whether all pixels are within one pixel of the mask's border."""
    near = np.ones((3, 3), np.uint8)
    inner, outer = cv2.erode(mask.astype(np.uint8), near), cv2.dilate(mask.astype(np.uint8), near)
    return not (pixels & ((outer == 0) | (inner == 1))).any()


def _trained_on(loaded: YOLODataset, index: int, size: tuple[int, int]) -> np.ndarray:
    """The masks of a sample, (n, height, width), without the border that makes it square."""
    masks = loaded[index]["masks"].numpy().astype(bool)
    top, left = ((total - used) // 2 for total, used in zip(masks.shape[1:], size))
    return masks[:, top : top + size[0], left : left + size[1]]


def _fit_of(loaded: YOLODataset, index: int, picture: Picture) -> list[tuple[str, float, float]]:
    """Of each target: size class, IoU of its outline with its mask, and of the mask that is trained on."""
    size = (picture.image["height"], picture.image["width"])
    label, fits = loaded.labels[index], []
    names = [loaded.data["names"][int(k)] for k in label["cls"][:, 0]]
    assert names == picture.of("category")
    masks, trained_on = picture.masks(), _trained_on(loaded, index, size)
    for k, mask in enumerate(masks):
        outline = polygon2mask(size, [(label["segments"][k] * size[::-1]).reshape(-1)]).astype(bool)
        assert _is_at_border(trained_on[k] ^ outline, outline)
        fits.append((picture.labels[k]["size_class"], _iou(outline, mask), _iou(trained_on[k], mask)))
    return fits


def check_outlines(options: argparse.Namespace, scratch: Path, truth: Truth) -> list[str]:
    """Export outlines, read them, and return how well they fit the masks."""
    out = _export(options, scratch / "outlines", "--format", "yolo", "--segmentation", "polygon")
    data, hyp = check_det_dataset(str(out / "data.yaml")), get_cfg()
    hyp.mask_ratio, hyp.overlap_mask = 1, False  # whole masks of their own
    loaded = YOLODataset(data["train"], _PICTURE_PX, augment=False, data=data, task="segment", hyp=hyp)
    _check_scan(out, "train", len(truth.pictures))
    pictures = {picture.name: picture for picture in truth.pictures}
    fits = []
    for index, file in enumerate(map(Path, loaded.im_files)):
        fits += _fit_of(loaded, index, pictures[file.stem])
    assert len(fits) == truth.targets
    lines = []
    record = json.loads((out / "export.json").read_text(encoding="utf-8"))["outline_iou"]
    for name, stated in record.items():
        figures = np.array([fit[1:] for fit in fits if fit[0] == name])
        (drawn, trained_on), (least, least_trained_on) = figures.mean(0), figures.min(0)
        assert len(figures) == stated["targets"]
        assert max(abs(drawn - stated["mean"]), abs(least - stated["least"])) < 1e-9
        lines.append(
            f"{name}: {len(figures)} outlines, IoU with the masks {drawn:.4f} (at least {least:.4f}), "
            f"as trained on {trained_on:.4f} ({least_trained_on:.4f})"
        )
    return lines


def main() -> None:
    """Check a dataset."""
    options = arguments(__doc__)
    lines = []
    with tempfile.TemporaryDirectory() as scratch:
        for style in _STYLES:
            lines += [check(options, Path(scratch), style, split) for split in _SPLITS]
        lines += check_outlines(options, Path(scratch), read_truth(options.dataset))
    print(f"ultralytics {__version__}", *lines, sep="\n")


if __name__ == "__main__":
    main()
