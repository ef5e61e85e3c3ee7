"""Labelled frames for a detector of people: read from COCO files, cut into crops, and turned into targets."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

PEOPLE = ("human", "person", "poacher")
CROP_PX = 256
STRIDE = 4
_FLOOR_DN = 8.0  # added to a frame's deviation, so that an empty frame is not amplified
_ZOOM = (0.7, 1.4)
_ON_A_PERSON = 0.8  # share of crops about a person, where there is one
_FLIPPED = 0.5
_GAIN, _OFFSET = (0.7, 1.4), (-0.5, 0.5)
_SPREAD = 0.3  # of a peak, in square roots of a box's area
_LEAST_SPREAD = 0.6  # cells


@dataclass(frozen=True)
class Frame:
    """A picture and the boxes (n, 4) of its people: x, y, width and height in px."""

    file: Path
    boxes_px: np.ndarray


def read_frames(labels: Path, folder: Path) -> list[Frame]:
    """The pictures of a COCO file in the order of their names, with people that are not marked as ignored."""
    document = json.loads(labels.read_text(encoding="utf-8"))
    wanted = {c["id"] for c in document["categories"] if c["name"].lower() in PEOPLE}
    boxes: dict[int, list] = {image["id"]: [] for image in document["images"]}
    for annotation in document["annotations"]:
        if annotation["category_id"] in wanted and not annotation.get("ignore", False):
            boxes[annotation["image_id"]].append(annotation["bbox"])
    frames = [
        Frame(folder / image["file_name"], np.reshape(np.array(boxes[image["id"]], np.float32), (-1, 4)))
        for image in document["images"]
    ]
    return sorted(frames, key=lambda frame: frame.file)


def normalised(grey: np.ndarray) -> np.ndarray:
    """A frame of mean 0 and deviation about 1: cameras and gain controls differ in both."""
    values = grey.astype(np.float32)
    return (values - values.mean()) / (values.std() + _FLOOR_DN)


Chain = Callable[[np.ndarray, int], np.ndarray]


class Crops:
    """Random crops of frames, each of another size, brightness and side.

    chain: what each frame passes through ahead of its crop, drawn by a number; draws: how many numbers a frame has, or
    0 for another one each time.
    """

    def __init__(self, frames: list[Frame], seed: int, chain: Chain | None = None, draws: int = 0):
        self._frames, self._rng = frames, np.random.default_rng(seed)
        self._chain, self._draws = chain, draws
        self._pictures: dict[Path, np.ndarray] = {}

    def draw(self, count: int) -> tuple[np.ndarray, list[np.ndarray]]:
        """Crops (count, CROP_PX, CROP_PX) and the boxes of each."""
        crops, boxes = zip(*(self._crop() for _ in range(count)))
        return np.stack(crops), list(boxes)

    def _picture(self, k: int) -> np.ndarray:
        file = self._frames[k].file
        if file not in self._pictures:
            grey = cv2.imread(str(file), cv2.IMREAD_GRAYSCALE)
            if grey is None:
                raise SystemExit(f"{file}: expected a picture")
            self._pictures[file] = grey
        if self._chain is None:
            return normalised(self._pictures[file])
        draw = (
            self._rng.integers(self._draws) + k * self._draws if self._draws else self._rng.integers(2**32)
        )
        return normalised(self._chain(self._pictures[file], int(draw)))

    def _crop(self) -> tuple[np.ndarray, np.ndarray]:
        rng, k = self._rng, int(self._rng.integers(len(self._frames)))
        picture, boxes_px = self._picture(k), self._frames[k].boxes_px
        high, wide = picture.shape
        side = min(int(CROP_PX / rng.uniform(*_ZOOM)), high, wide)
        middle = rng.uniform([0, 0], [wide, high])
        if len(boxes_px) and rng.random() < _ON_A_PERSON:
            x, y, w, h = boxes_px[rng.integers(len(boxes_px))]
            middle = np.array([x + w / 2, y + h / 2]) + rng.uniform(-side / 3, side / 3, 2)
        left, top = np.clip(middle - side / 2, 0, [wide - side, high - side]).astype(int)
        crop = cv2.resize(picture[top : top + side, left : left + side], (CROP_PX, CROP_PX))
        boxes_px = (boxes_px - np.array([left, top, 0, 0], np.float32)) * np.float32(CROP_PX / side)
        if rng.random() < _FLIPPED:
            crop = crop[:, ::-1]
            boxes_px[:, 0] = CROP_PX - boxes_px[:, 0] - boxes_px[:, 2]
        return crop * np.float32(rng.uniform(*_GAIN)) + np.float32(rng.uniform(*_OFFSET)), boxes_px


def targets_of(boxes_px: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The targets of a detector in a crop: peaks (n, n), offsets and log sizes (4, n, n), and where they count (n, n).

    A peak is a Gaussian about the middle of a box, 1 in the cell that holds it.
    """
    cells = CROP_PX // STRIDE
    peaks, shapes = np.zeros((cells, cells), np.float32), np.zeros((4, cells, cells), np.float32)
    counts = np.zeros((cells, cells), np.float32)
    row, column = np.mgrid[:cells, :cells]
    for x, y, wide, high in boxes_px:
        at_x, at_y = (x + wide / 2) / STRIDE, (y + high / 2) / STRIDE
        if not (0 <= at_x < cells and 0 <= at_y < cells):
            continue
        i, j = int(at_y), int(at_x)
        spread = max(_LEAST_SPREAD, _SPREAD * np.sqrt(wide * high) / STRIDE)
        peaks = np.maximum(peaks, np.exp(-((column - j) ** 2 + (row - i) ** 2) / (2 * spread**2)))
        shapes[:, i, j] = (at_x - j, at_y - i, *np.log(np.maximum([wide, high], 1) / STRIDE))
        counts[i, j] = 1
    return peaks, shapes, counts
