"""Datasets for Hugging Face's `datasets`, which must be installed."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import pyarrow
import pyarrow.parquet
from datasets import ClassLabel, Features, List, Value

import veldt._core as _core
from .datasets import Clip, Dataset, Frame

_PIXELS = ("ir8", "ir16")
# Folders that `datasets` recognizes as splits.
_SPLITS = ("train", "validation", "test")


def write_image_folder(
    dataset: Dataset, folder: str | PathLike[str], splits: Mapping[str, Iterable[str]] | None = None
) -> None:
    """Write a dataset so that `datasets.load_dataset("imagefolder", data_dir=folder)` reads it.

    A row has `image`, the 8-bit frame, and `ir16`, the 16-bit one (kelvin = value x `kelvin_per_count`); `image_id`,
    `clip`, `frame_index` and `time_s`; and `objects` as lists: `bbox` (x, y, width, height [px]), `category`, `area`
    [px], `track_id`, and `rle`, the mask as COCO's compressed run lengths. Labels marked `ignore` are left out.

    splits: the ids of the clips in train, validation and test; `val` is validation. None: all clips in train. Frames
    are linked, or copied where that is impossible. metadata.parquet has the rows with their types: with JSON lines,
    `datasets` rejects splits without targets, whose types it cannot infer.

    ConfigError for a folder that exists, other splits, one without frames, an unknown clip, and a clip in two of them;
    open_dataset()'s errors: no link of the dataset is followed. The folder appears when it is complete; a killed run
    leaves one beside it with the suffix `.part_`.
    """
    out = Path(folder)
    if out.exists():
        raise _core.ConfigError(f"folder = {out}; expected a new folder")
    chosen = _clips_of(dataset, splits)
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f"{out.name}.part_", dir=out.parent) as scratch:
        whole = Path(scratch) / "whole"
        for split, clips in chosen.items():
            _write_split(dataset, clips, whole / split)
        whole.rename(out)


def _clips_of(dataset: Dataset, splits: Mapping[str, Iterable[str]] | None) -> dict[str, list[Clip]]:
    given = {"train": [clip.id for clip in dataset]} if splits is None else splits
    chosen: dict[str, list[Clip]] = {}
    seen: set[str] = set()
    for name, clips in given.items():
        split = "validation" if name == "val" else name
        if split not in _SPLITS or split in chosen:
            raise _core.ConfigError(
                f"splits: {name}; expected train, validation (or val) and test, each once"
            )
        chosen[split] = [dataset[clip] for clip in clips]
        if not any(map(len, chosen[split])):
            raise _core.ConfigError(f"splits: {name} has 0 frames; expected at least one")
        for clip in chosen[split]:
            if clip.id in seen:
                raise _core.ConfigError(f"splits: clip {clip.id} twice; expected each clip in one split")
            seen.add(clip.id)
    return chosen


def _features(categories: list[str]) -> Features:
    objects = {
        "bbox": List(List(Value("float32"), length=4)),
        "category": List(ClassLabel(names=categories)),
        "area": List(Value("int64")),
        "track_id": List(Value("int64")),
        "rle": List(Value("string")),
    }
    return Features(
        {
            "file_name": Value("string"),  # becomes `image`
            "ir16_file_name": Value("string"),
            "image_id": Value("int64"),
            "clip": Value("string"),
            "frame_index": Value("int64"),
            "time_s": Value("float64"),
            "kelvin_per_count": Value("float64"),
            "objects": objects,
        }
    )


def _write_split(dataset: Dataset, clips: list[Clip], folder: Path) -> None:
    for pixels in _PIXELS:
        (folder / pixels).mkdir(parents=True)
    schema = _features(list(dataset.categories)).arrow_schema
    with pyarrow.parquet.ParquetWriter(folder / "metadata.parquet", schema) as writer:
        for clip in clips:
            rows = [_row(frame) for frame in clip]
            writer.write_table(pyarrow.Table.from_pylist(rows, schema))
            for frame, row in zip(clip, rows):
                for pixels, key in zip(_PIXELS, ("file_name", "ir16_file_name")):
                    _core.link_file(str(frame.file(pixels)), str(folder / row[key]))


def _row(frame: Frame) -> dict[str, Any]:
    dataset = frame.clip.dataset
    places = {of: place for place, of in enumerate(dataset.categories.values())}
    name = f"{frame.clip.id}_{frame.index:06d}.png"
    labels = [label for label in frame.labels if not label.values["ignore"]]
    return {
        "file_name": f"ir8/{name}",
        "ir16_file_name": f"ir16/{name}",
        "image_id": frame.image_id,
        "clip": frame.clip.id,
        "frame_index": frame.index,
        "time_s": frame.time_s,
        "kelvin_per_count": dataset.kelvin_per_count,
        "objects": {
            "bbox": [list(label.box_px) for label in labels],
            "category": [places[dataset.category_id(label.category)] for label in labels],
            "area": [label.values["area"] for label in labels],
            "track_id": [label.track_id for label in labels],
            "rle": [label.values["segmentation"]["counts"] for label in labels],
        },
    }
