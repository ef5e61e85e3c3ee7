"""A dataset read without Veldt: its JSON, OpenCV for pictures, pycocotools for masks."""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from pycocotools import mask as coco_mask


@dataclass(frozen=True)
class Picture:
    """A frame, and what is in it."""

    clip: str
    image: dict[str, Any]
    """Its entry in annotations.json."""
    labels: list[dict[str, Any]]
    """Its annotations, with the name of their `category`."""
    dataset: Path

    @property
    def name(self) -> str:
        """As exports call it."""
        return f"{self.clip}_{self.image['frame_index']:06d}"

    def pixels(self, kind: str) -> np.ndarray:
        """Its "ir8" or "ir16", (height, width)."""
        file = self.dataset / "clips" / self.clip / kind / f"{self.image['frame_index']:06d}.png"
        return cv2.imread(str(file), cv2.IMREAD_UNCHANGED)

    def masks(self) -> np.ndarray:
        """(n, height, width)."""
        masks = [coco_mask.decode(label["segmentation"]).astype(bool) for label in self.labels]
        return np.array(masks).reshape((-1, self.image["height"], self.image["width"]))

    def corners_px(self) -> np.ndarray:
        """Boxes as left, top, right and bottom, (n, 4)."""
        boxes = np.array(self.of("bbox"), float).reshape(-1, 4)
        return np.hstack([boxes[:, :2], boxes[:, :2] + boxes[:, 2:]])

    def of(self, key: str) -> list:
        """A key of all labels."""
        return [label[key] for label in self.labels]


@dataclass(frozen=True)
class Truth:
    """A dataset."""

    folder: Path
    pictures: list[Picture]
    """In the order of annotations.json."""
    categories: dict[str, int]
    """Names with their ids."""
    kelvin_per_count: float

    @property
    def clips(self) -> list[str]:
        """Ids, in order."""
        return list(dict.fromkeys(picture.clip for picture in self.pictures))

    @property
    def targets(self) -> int:
        """How many labels there are."""
        return sum(len(picture.labels) for picture in self.pictures)


def read_truth(folder: Path) -> Truth:
    """Labels that are marked `ignore` are left out."""
    document = json.loads((folder / "annotations.json").read_text(encoding="utf-8"))
    names = {category["id"]: category["name"] for category in document["categories"]}
    clips = {video["id"]: video["name"] for video in document["videos"]}
    labels: dict[int, list] = {image["id"]: [] for image in document["images"]}
    for label in document["annotations"]:
        if not label["ignore"]:
            labels[label["image_id"]].append(label | {"category": names[label["category_id"]]})
    pictures = [
        Picture(clips[image["video_id"]], image, labels[image["id"]], folder) for image in document["images"]
    ]
    record = json.loads((folder / "dataset.json").read_text(encoding="utf-8"))
    return Truth(folder, pictures, {v: k for k, v in names.items()}, record["kelvin_per_count"])


def arguments(description: str) -> argparse.Namespace:
    """`dataset`, and `veldt`, the program, of a check's command line."""
    program = Path(__file__).resolve().parents[2] / "build" / "release" / "bin" / "veldt"
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("dataset", type=Path)
    parser.add_argument("--veldt", type=Path, default=program)
    return parser.parse_args()
