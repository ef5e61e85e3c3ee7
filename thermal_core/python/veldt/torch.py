"""Frames and labels for torchvision's detection models and transforms; `torch` and `torchvision` must be installed."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from os import PathLike
from typing import Any

import numpy as np
import torch
from torchvision import tv_tensors

import veldt._core as _core
from .datasets import Dataset, Frame, Label, open_dataset

Target = dict[str, Any]
Transforms = Callable[[tv_tensors.Image, Target], tuple[tv_tensors.Image, Target]]

# PyTorch supports few operations on uint16; int32 holds all counts, and torchvision's transforms support it.
_TYPES = {"ir8": np.uint8, "ir16": np.int32, "ir16_k": np.float32}


class FrameDataset(torch.utils.data.Dataset[tuple[tv_tensors.Image, Target]]):
    """The frames of a dataset, in order, as pairs of image and target.

    The image is (1, height, width). The target has `boxes` (n, 4): XYXY [px], float32; `labels` (n): ids of
    `categories`, from 1 as 0 is torchvision's background; `track_ids` (n); `masks` (n, height, width), bool;
    `image_id`: as in annotations.json. Worker processes read files themselves, after fork and spawn.

    >>> frames = FrameDataset("build/demo", clips=["winter_zigzag_61m"], transforms=v2.RandomHorizontalFlip()) >>>
    batches = torch.utils.data.DataLoader(frames, batch_size=4, shuffle=True, num_workers=2, collate_fn=collate)
    """

    def __init__(
        self,
        dataset: Dataset | str | PathLike[str],
        *,
        clips: Iterable[str] | None = None,
        pixels: str = "ir16_k",
        masks: bool = True,
        ignored: bool = False,
        transforms: Transforms | None = None,
    ) -> None:
        """clips: only these, such as those of a split (splits_of()). pixels: "ir16_k", apparent temperature [K] in
        float32, from which every count of ir16 can be restored; "ir16", counts in int32; "ir8", grey levels in uint8.
        masks: whether targets have them. ignored: whether targets have labels that are marked `ignore` too. transforms:
        of image and target, such as those of torchvision.transforms.v2; boxes and masks follow them. They pad with 0 K,
        unless `fill` is set.

        ConfigError for other pixels and an unknown clip; open_dataset()'s errors.
        """
        if pixels not in _TYPES:
            raise _core.ConfigError(f'pixels = "{pixels}"; expected one of ir16, ir16_k, ir8')
        self.dataset = dataset if isinstance(dataset, Dataset) else open_dataset(dataset)
        self._frames = [frame for clip in self._chosen(clips) for frame in clip]
        self._pixels = pixels
        self._masks = masks
        self._ignored = ignored
        self._transforms = transforms

    @property
    def categories(self) -> dict[str, int]:
        """Names with the ids in `labels`. A model needs one class more than the largest id."""
        return self.dataset.categories

    def frame(self, at: int) -> Frame:
        """The frame of an item."""
        return self._frames[at]

    def __len__(self) -> int:
        return len(self._frames)

    def __getitem__(self, at: int) -> tuple[tv_tensors.Image, Target]:
        frame = self._frames[at]
        pixels = getattr(frame, self._pixels)().astype(_TYPES[self._pixels], copy=False)
        labels = [label for label in frame.labels if self._ignored or not label.values["ignore"]]
        sample = tv_tensors.Image(pixels[None]), self._target(frame, labels, pixels.shape)
        return sample if self._transforms is None else self._transforms(*sample)

    def _chosen(self, clips: Iterable[str] | None) -> Iterable[Any]:
        return self.dataset if clips is None else [self.dataset[clip] for clip in clips]

    def _target(self, frame: Frame, labels: list[Label], size: tuple[int, int]) -> Target:
        boxes = torch.tensor([label.box_px for label in labels], dtype=torch.float32).reshape(-1, 4)
        boxes[:, 2:] += boxes[:, :2]
        target = {
            "boxes": tv_tensors.BoundingBoxes(boxes, format="XYXY", canvas_size=size),
            "labels": torch.tensor(
                [self.dataset.category_id(label.category) for label in labels], dtype=torch.int64
            ),
            "track_ids": torch.tensor([label.track_id for label in labels], dtype=torch.int64),
            "image_id": frame.image_id,
        }
        if self._masks:
            masks = [label.mask() for label in labels] or np.zeros((0, *size), bool)
            target["masks"] = tv_tensors.Mask(np.array(masks))
        return target


def collate(samples: list[tuple[tv_tensors.Image, Target]]) -> tuple[list[tv_tensors.Image], list[Target]]:
    """A batch for detection models, from a DataLoader: a list of images and one of targets."""
    images, targets = zip(*samples)
    return list(images), list(targets)


def per_label(sample: tuple[tv_tensors.Image, Target]) -> tuple[torch.Tensor, torch.Tensor]:
    """The parts of a target that v2.SanitizeBoundingBoxes(labels_getter=per_label) removes with each box: labels and
    track ids.
    """
    return sample[1]["labels"], sample[1]["track_ids"]


def results(outputs: list[Target], targets: list[Target]) -> list[dict[str, Any]]:
    """A detection model's outputs for untransformed frames as COCO results, which `veldt evaluate` reads from JSON."""
    rows = []
    for output, target in zip(outputs, targets, strict=True):
        corners = output["boxes"].detach().cpu()
        boxes = torch.cat([corners[:, :2], corners[:, 2:] - corners[:, :2]], 1).tolist()
        for box, label, score in zip(
            boxes, output["labels"].tolist(), output["scores"].tolist(), strict=True
        ):
            row = {"image_id": target["image_id"], "category_id": label, "bbox": box, "score": score}
            rows.append(row)
    return rows
