"""Placement of a map's labels that hide neither each other nor their objects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

_LETTER = 0.53  # mean width of a letter in Blender's font, of its size; slightly more than measured
_PAD = 0.25  # of a letter's size, between the text and the border of its plate
_RINGS = (1.0, 2.2, 3.6, 5.2, 7.0)  # sizes from the anchor
_DIRECTIONS = 12


@dataclass(frozen=True)
class Label:
    """A text of the given size that starts at x_m, centred vertically on y_m."""

    text: str
    x_m: float
    y_m: float
    size_m: float

    @property
    def plate_m(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 of a plate around the text."""
        pad = _PAD * self.size_m
        half = 0.5 * self.size_m + 0.4 * pad
        width = _LETTER * self.size_m * len(self.text)
        return self.x_m - pad, self.y_m - half, self.x_m + width + pad, self.y_m + half


@dataclass(frozen=True)
class Anchor:
    """The object of a label: a position (x, y), and the distance that the label keeps from it."""

    text: str
    point_m: tuple[float, float]
    clear_m: float


def place_labels(
    anchors: Sequence[Anchor], taken_m: Sequence[tuple], bounds_m: tuple, size_m: float
) -> list[Label]:
    """A label near each anchor, within bounds (x0, y0, x1, y1), clear of occupied boxes and of each other.

    If there is no such position, chooses the one that hides least.
    """
    taken = [np.asarray(box, float) for box in taken_m]
    labels = []
    for anchor in anchors:
        choices = list(_choices(anchor, size_m))
        hidden = [_hidden_m2(label.plate_m, taken, bounds_m) for label in choices]
        labels.append(choices[int(np.argmin(hidden))])
        taken.append(np.array(labels[-1].plate_m))
    return labels


def _choices(anchor: Anchor, size_m: float):
    """Candidate labels around an anchor, nearest first."""
    width = Label(anchor.text, 0.0, 0.0, size_m).plate_m[2]
    for ring in _RINGS:
        for k in range(_DIRECTIONS):
            angle = 2.0 * np.pi * k / _DIRECTIONS
            away = anchor.clear_m + ring * size_m
            x = anchor.point_m[0] + away * np.cos(angle) - 0.5 * width * (1.0 - np.cos(angle))
            yield Label(anchor.text, float(x), float(anchor.point_m[1] + away * np.sin(angle)), size_m)


def _hidden_m2(plate: tuple, taken: list[np.ndarray], bounds: tuple) -> float:
    """The area of occupied boxes that a plate would hide, plus its area out of bounds."""
    x0, y0, x1, y1 = plate
    inside = max(min(x1, bounds[2]) - max(x0, bounds[0]), 0.0) * max(
        min(y1, bounds[3]) - max(y0, bounds[1]), 0.0
    )
    out = (x1 - x0) * (y1 - y0) - inside
    boxes = np.array(taken).reshape(-1, 4)
    wide = np.minimum(x1, boxes[:, 2]) - np.maximum(x0, boxes[:, 0])
    high = np.minimum(y1, boxes[:, 3]) - np.maximum(y0, boxes[:, 1])
    return 10.0 * out + float((np.maximum(wide, 0.0) * np.maximum(high, 0.0)).sum())
