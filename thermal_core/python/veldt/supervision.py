"""Labels for Roboflow's `supervision`, which must be installed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import supervision as sv

from veldt._core import ConfigError
from .datasets import Label


def detections(labels: Sequence[Label], categories: Sequence[str], *, masks: bool = True) -> sv.Detections:
    """Boxes, masks and tracks of a frame's labels, those marked `ignore` too. `class_id` is the index in `categories`,
    as in list(dataset.categories) and the YOLO export; ConfigError for a missing category.

    >>> found = detections(frame.labels, list(dataset.categories))
    >>> picture = supervision.MaskAnnotator().annotate(cv2.cvtColor(frame.ir8(), cv2.COLOR_GRAY2BGR), found)
    """
    if not labels:
        return sv.Detections.empty()
    boxes = np.array([label.box_px for label in labels], np.float32)
    boxes[:, 2:] += boxes[:, :2]
    names = [label.category for label in labels]
    if not set(names) <= set(categories):
        raise ConfigError(
            f"categories: {', '.join(categories)}; expected all of the labels': {', '.join(sorted(set(names)))}"
        )
    return sv.Detections(
        xyxy=boxes,
        mask=np.array([label.mask() for label in labels]) if masks else None,
        class_id=np.array([list(categories).index(name) for name in names]),
        tracker_id=np.array([label.track_id for label in labels]),
        data={"class_name": np.array(names)},
    )
