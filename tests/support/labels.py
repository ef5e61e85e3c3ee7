"""Check labels against index planes, pixel by pixel."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np


def decode_rle(segmentation: dict) -> np.ndarray:
    """Mask (height, width) of a COCO run-length string, decoded after the format's own description.

    Five bits a character from 48 up, lowest first, bit 5 says that more follow, bit 4 of the last is the sign; from
    the fourth on a number is the difference to the one two before. Runs of 0 and 1 in turn, down the columns.
    """
    counts, value, shift = [], 0, 0
    for character in segmentation["counts"]:
        bits = ord(character) - 48
        value |= (bits & 31) << shift
        shift += 5
        if bits & 32:
            continue
        if bits & 16:
            value -= 1 << shift
        counts.append(value + (counts[-2] if len(counts) > 2 else 0))
        value = shift = 0
    height, width = segmentation["size"]
    runs = np.repeat(np.arange(len(counts)) % 2, counts)
    assert len(runs) == height * width
    return runs.reshape(width, height).T == 1


def box_of(mask: np.ndarray) -> list[float]:
    """[x, y, width, height] of the pixels in a mask."""
    rows, columns = np.nonzero(mask)
    x, y = columns.min(), rows.min()
    return [float(x), float(y), float(columns.max() - x + 1), float(rows.max() - y + 1)]


def check_labels(
    document: dict,
    planes: Mapping[str, np.ndarray],
    manifests: Mapping[str, dict],
    alone: Mapping[str, np.ndarray] | None = None,
) -> int:
    """Check that every label has exactly its actor's pixels, and every actor in a plane one label; return their number.

    planes: object index (height, width) of each picture, by file name; alone: the same of actors alone, from which
    visibility is checked; manifests: by clip.
    """
    images = {image["id"]: image for image in document["images"]}
    categories = {category["id"]: category["name"] for category in document["categories"]}
    assert {image["file_name"] for image in images.values()} == set(planes)
    assert [a["id"] for a in document["annotations"]] == list(range(1, len(document["annotations"]) + 1))
    labelled = set()
    for label in document["annotations"]:
        name = images[label["image_id"]]["file_name"]
        actor = _actor(manifests[name.split("/")[1]], label["track_id"])
        mask = planes[name] == actor["index"]
        assert (decode_rle(label["segmentation"]) == mask).all()
        assert (label["bbox"], label["area"]) == (box_of(mask), np.count_nonzero(mask))
        assert categories[label["category_id"]] == actor["category"]
        whole = mask
        if alone is not None:
            there = alone[name] == actor["index"]
            whole = mask | there
            assert label["visibility"] == round(np.count_nonzero(mask) / np.count_nonzero(there), 4) <= 1
            assert label["occluded"] == (label["visibility"] < 0.9)
        edges = np.concatenate([whole[0], whole[-1], whole[:, 0], whole[:, -1]])
        assert label["truncated"] == edges.any()
        labelled.add((name, actor["index"]))
    seen = set()
    for name, plane in planes.items():
        actors = {o["index"] for o in manifests[name.split("/")[1]]["objects"] if o["class"] == "actor"}
        seen |= {(name, index) for index in np.unique(plane).astype(int) if index in actors}
    assert labelled == seen and len(document["annotations"]) == len(seen)
    return len(seen)


def _actor(manifest: dict, track_id: int) -> dict:
    (actor,) = (o for o in manifest["objects"] if o.get("track_id") == track_id)
    return actor
