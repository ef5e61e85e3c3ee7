"""Datasets of `veldt generate` and `veldt convert`, as sequences of clips and frames. Files are read lazily."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import veldt._core as _core


@dataclass(frozen=True)
class Label:
    """One actor in one frame."""

    category: str
    track_id: int
    box_px: tuple[float, float, float, float]
    """Bounding box of its visible pixels: x, y, width and height."""
    values: dict[str, Any] = field(repr=False)
    """All keys of its annotation, such as range_m and contrast_k; thermal_core/DATASET.md explains them."""

    @classmethod
    def of(cls, annotation: dict[str, Any], category: str) -> Label:
        """The label of an annotation."""
        return cls(category, annotation["track_id"], tuple(annotation["bbox"]), annotation)

    def mask(self) -> NDArray[np.bool_]:
        """Its visible pixels, (height, width)."""
        segmentation = self.values["segmentation"]
        height_px, width_px = segmentation["size"]
        return _core.mask_of(segmentation["counts"], width_px, height_px)


@dataclass(frozen=True)
class Frame:
    """One frame of a clip."""

    clip: Clip = field(repr=False)
    index: int
    line: str = field(repr=False)
    """Its line of frames.jsonl as text, in a fifth of the memory."""

    @property
    def values(self) -> dict[str, Any]:
        """Its line of frames.jsonl: gain curve, checksums and further keys."""
        return json.loads(self.line)

    @property
    def image_id(self) -> int:
        """Its image's id in the dataset's annotations.json, and so in results for `veldt evaluate`."""
        return self.clip.dataset.images_before[self.clip.id] + self.index + 1

    @property
    def time_s(self) -> float:
        """Time of the scene [s]."""
        return self.values["time_s"]

    @property
    def shutter_closed(self) -> bool:
        """Whether the picture is frozen."""
        return self.values["ffc"]

    @property
    def camera_to_world(self) -> NDArray[np.float64] | None:
        """(4, 4): from OpenCV's camera axes to east, north, up [m]; None if the passes did not state it."""
        pose = self.values.get("camera_to_world")
        return None if pose is None else np.array(pose, float).reshape(4, 4)

    def ir8(self) -> NDArray[np.uint8]:
        """Grey levels, (height, width)."""
        return _core.read_png8(str(self.file("ir8")))

    def ir16(self) -> NDArray[np.uint16]:
        """Apparent temperature in counts, (height, width)."""
        return _core.read_png16(str(self.file("ir16")))

    def ir16_k(self) -> NDArray[np.float32]:
        """Apparent temperature [K], (height, width): ir16() times kelvin_per_count, rounded to single precision."""
        return (self.ir16() * self.clip.dataset.kelvin_per_count).astype(np.float32)

    @property
    def labels(self) -> list[Label]:
        """Its actors."""
        return self.clip.labels_of(self.index)

    def file(self, kind: str) -> Path:
        """Path of its "ir8" or "ir16" file."""
        return self.clip.folder / kind / f"{self.index:06d}.png"


class Clip(Sequence[Frame]):
    """The frames of a clip, in order. Skipped frames are missing."""

    def __init__(self, dataset: Dataset, name: str) -> None:
        """Made by Dataset."""
        self.dataset = dataset
        self.id = name
        self.folder = dataset.folder / "clips" / name

    @cached_property
    def record(self) -> dict[str, Any]:
        """clip.json: season, seed, checksums."""
        return json.loads(_core.read_clip_record(str(self.folder / "clip.json")))

    @property
    def frame_rate_hz(self) -> float:
        """Frames a second."""
        return self.record["frame_rate_hz"]

    def labels_of(self, frame_index: int) -> list[Label]:
        """The actors of a frame."""
        return self._labels.get(frame_index, [])

    def __getitem__(self, at: int) -> Frame:
        """A frame by index; a slice gives a list."""
        return self._frames[at]

    def __len__(self) -> int:
        return len(self._frames)

    def __repr__(self) -> str:
        return f"Clip({self.id!r}, {len(self)} frames)"

    @cached_property
    def _frames(self) -> list[Frame]:
        return [Frame(self, index, line) for index, line in _core.read_clip_frames(str(self.folder))]

    @cached_property
    def _labels(self) -> dict[int, list[Label]]:
        found: dict[int, list[Label]] = {}
        for frame_index, category, annotation in _core.read_clip_labels(str(self.folder)):
            found.setdefault(frame_index, []).append(Label.of(json.loads(annotation), category))
        return found


class Dataset(Sequence[Clip]):
    """The complete clips of a dataset, in the order of its config."""

    def __init__(self, folder: Path) -> None:
        """Made by open_dataset()."""
        self.folder = folder
        self.document = json.loads(_core.read_dataset_file(str(folder)))
        self._clips = [Clip(self, clip["id"]) for clip in self.document["clips"] if clip["status"] == "done"]

    @property
    def config(self) -> dict[str, Any]:
        """The resolved config."""
        return self.document["config"]

    @property
    def kelvin_per_count(self) -> float:
        """Step of ir16 [K]."""
        return self.config["sensor"]["kelvin_per_count"]

    @cached_property
    def categories(self) -> dict[str, int]:
        """Names of all categories with their ids in annotations.json, in its order. IoError or DataError if that file
        cannot be read."""
        categories, _ = _core.read_coco_head(str(self.folder / "annotations.json"))
        return dict(categories)

    def category_id(self, name: str) -> int:
        """Id of a category in annotations.json; DataError for an unknown name."""
        if name in self.categories:
            return self.categories[name]
        known = ", ".join(self.categories)
        raise _core.DataError(
            f'{self.folder}: category = "{name}"; expected one of annotations.json: {known}'
        )

    @cached_property
    def images_before(self) -> dict[str, int]:
        """By clip: the largest id of an image in annotations.json before its own. Skipped frames count."""
        largest = accumulate((clip[-1].index + 1 if len(clip) else 0 for clip in self), initial=0)
        return dict(zip((clip.id for clip in self), largest))

    def frames(self) -> Iterator[Frame]:
        """All frames of all clips."""
        for clip in self:
            yield from clip

    def __getitem__(self, at: int | str) -> Clip:
        """A clip by index or id, ConfigError for an unknown one; a slice gives a list."""
        if not isinstance(at, str):
            return self._clips[at]
        for clip in self._clips:
            if clip.id == at:
                return clip
        known = ", ".join(clip.id for clip in self._clips)
        raise _core.ConfigError(f'clip = "{at}"; expected one of {known or "none: no clip is complete"}')

    def __len__(self) -> int:
        return len(self._clips)

    def __repr__(self) -> str:
        return f"Dataset({str(self.folder)!r}, {len(self)} clips)"


def open_dataset(folder: str | PathLike[str]) -> Dataset:
    """A dataset's clips. Contents are checked when they are first read: IoError if a file cannot be read, is not
    regular, or a link; DataError, with file, location and value, for invalid contents.
    """
    return Dataset(Path(folder))


def splits_of(export: str | PathLike[str]) -> dict[str, list[str]]:
    """The ids of the clips in each split of an export by `veldt export --format coco --split`. IoError unless it has a
    folder annotations/, not a link, with a file for each split; DataError if one is not a COCO file.
    """
    files = sorted(Path(export).glob("annotations/*.json"))
    if not files:
        raise _core.IoError(
            f"{export}: no annotations/*.json; expected an export in COCO's format with splits"
        )
    return {file.stem: _core.read_coco_head(str(file))[1] for file in files}
