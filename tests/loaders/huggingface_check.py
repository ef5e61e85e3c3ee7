#!/usr/bin/env python3
"""Does Hugging Face's `datasets` read what veldt.huggingface writes as the dataset has it?

    tests/loaders/huggingface_check.py DATASET

Run by `./run loaders`, with the packages `datasets` and `pycocotools`, without network. Splits are those of an export.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from pycocotools import mask as coco_mask

os.environ |= {"HF_DATASETS_OFFLINE": "1", "HF_HUB_OFFLINE": "1", "HF_DATASETS_DISABLE_PROGRESS_BARS": "1"}
import datasets

from truth import Picture, Truth, arguments, read_truth
from veldt import open_dataset, splits_of
from veldt.huggingface import write_image_folder


def _check_row(row: dict, picture: Picture, truth: Truth, names: list[str]) -> None:
    ir8, ir16 = np.asarray(row["image"]), np.asarray(row["ir16"])
    assert (ir8.dtype, ir16.dtype) == (np.uint8, np.uint16)
    assert np.array_equal(ir8, picture.pixels("ir8")) and np.array_equal(ir16, picture.pixels("ir16"))
    assert row["kelvin_per_count"] == truth.kelvin_per_count
    assert (row["clip"], row["frame_index"]) == (picture.clip, picture.image["frame_index"])
    assert (row["image_id"], row["time_s"]) == (picture.image["id"], picture.image["time_s"])
    objects = row["objects"]
    assert [names[k] for k in objects["category"]] == picture.of("category")
    for key in ("bbox", "track_id", "area"):
        assert objects[key] == picture.of(key), key
    for rle, mask in zip(objects["rle"], picture.masks(), strict=True):
        size = (picture.image["height"], picture.image["width"])
        assert np.array_equal(coco_mask.decode({"size": size, "counts": rle}), mask)


def check(truth: Truth, veldt: Path, scratch: Path) -> list[str]:
    """Write the dataset, with splits and without, and read it in both ways."""
    coco = scratch / "coco"
    command = [veldt, "export", truth.folder, "--format", "coco", "--out", coco, "--quiet", "--unfinished"]
    subprocess.run([*command, "--split", "train:0.5,val:0.5"], check=True)
    dataset, parts, lines = open_dataset(truth.folder), splits_of(coco), []
    for splits in (None, parts):
        out = scratch / f"folder_{'split' if splits else 'whole'}"
        write_image_folder(dataset, out, splits)
        for read in ({"path": "imagefolder", "data_dir": str(out)}, {"path": str(out)}):
            loaded = datasets.load_dataset(**read, cache_dir=str(scratch / "cache"))
            rows = {name: {row["image_id"]: row for row in part} for name, part in loaded.items()}
            assert list(rows) == (["train", "validation"] if splits else ["train"])
            assert sum(map(len, rows.values())) == len(truth.pictures)
            names = loaded["train"].features["objects"]["category"].feature.names
            assert names == list(truth.categories)
            for picture in truth.pictures:
                part = "validation" if splits and picture.clip in splits["val"] else "train"
                _check_row(rows[part][picture.image["id"]], picture, truth, names)
        sizes = ", ".join(f"{name} {len(part)}" for name, part in rows.items())
        lines.append(f"{sizes} frames: pixels and {truth.targets} boxes, masks, tracks and names agree")
    return lines


def main() -> None:
    """Check a dataset."""
    options = arguments(__doc__)
    with tempfile.TemporaryDirectory() as scratch:
        lines = check(read_truth(options.dataset), options.veldt, Path(scratch))
    print(f"datasets {datasets.__version__}", *lines, sep="\n")


if __name__ == "__main__":
    main()
