"""What the detections in some frames are worth: average precision as COCO defines it, at any overlap, and the recall at
one false alarm a frame.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def scores_of(
    detections: Sequence[np.ndarray], truth_px: Sequence[np.ndarray], iou: float
) -> tuple[float, float]:
    """Average precision, and the share of people found at a threshold that lets one false alarm a frame through.

    detections: of each frame (n, 5): x, y, width, height, score; truth_px: its boxes (m, 4).
    """
    score = np.concatenate([found[:, 4] for found in detections])
    right = np.concatenate([_is_right(found, boxes, iou) for found, boxes in zip(detections, truth_px)])
    right = right[np.argsort(-score, kind="stable")]
    people = sum(map(len, truth_px))
    found, false = np.cumsum(right), np.cumsum(~right)
    recall, precision = found / people, np.maximum.accumulate((found / (found + false))[::-1])[::-1]
    at = np.searchsorted(recall, np.linspace(0, 1, 101))
    precisions = np.append(precision, 0.0)[at]  # 0 where that recall was not reached
    alarm = min(int(np.searchsorted(false, len(truth_px), "right")), len(recall)) - 1
    return float(precisions.mean()), float(recall[alarm])


def enlarged(boxes: np.ndarray, scale: float) -> np.ndarray:
    """Boxes or detections (n, 4 or more) about the same middles, `scale` times as wide and as high."""
    grown = boxes.copy()
    grown[:, 2:4] = boxes[:, 2:4] * scale
    grown[:, :2] = boxes[:, :2] + (boxes[:, 2:4] - grown[:, 2:4]) / 2
    return grown


def _is_right(found: np.ndarray, boxes_px: np.ndarray, iou: float) -> np.ndarray:
    """Which detections (n,) match a person that none of higher score has matched."""
    right, free = np.zeros(len(found), bool), np.ones(len(boxes_px), bool)
    for k in np.argsort(-found[:, 4], kind="stable"):
        overlap = _overlaps(found[k], boxes_px) * free
        best = int(overlap.argmax()) if len(overlap) else -1
        if best >= 0 and overlap[best] >= iou:
            right[k], free[best] = True, False
    return right


def _overlaps(box: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Intersections over unions (m,) of a box with others (m, 4)."""
    low = np.maximum(box[:2], others[:, :2])
    high = np.minimum(box[:2] + box[2:4], others[:, :2] + others[:, 2:])
    shared = np.clip(high - low, 0, None).prod(axis=1)
    return shared / (box[2] * box[3] + others[:, 2] * others[:, 3] - shared)
