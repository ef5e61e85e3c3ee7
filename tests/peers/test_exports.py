"""Exports, read by the usual third-party programs, agree with the dataset.

Boxes given back as detections are perfect; shifted and dropped ones give figures that can be worked out by hand.
"""

import contextlib
import io
import itertools
import json
from collections import Counter

import motmetrics
import numpy as np
import pytest
import supervision
import webdataset
import yaml
from PIL import Image
from pycocotools import mask as coco_mask
from pycocotools.coco import COCO
from pycocotools.cocoeval import COCOeval

FIRST, ACTORS = 101, 6  # as draw_passes.py has them
BOX_WIDTH = 20
CLIPS = ("march_a", "march_b")


def _coco(folder) -> COCO:
    with contextlib.redirect_stdout(io.StringIO()):
        return COCO(str(folder / "annotations.json"))


# --- COCO in pycocotools ----------------------------------------------------------------------------------------------


def test_every_mask_is_its_actor_s_pixels(export, planes):
    coco = _coco(export("masks", "coco"))
    seen = Counter()
    for annotation in coco.anns.values():
        image = coco.imgs[annotation["image_id"]]
        clip = coco.dataset["videos"][image["video_id"] - 1]["name"]
        truth = planes[clip][image["frame_index"]] == FIRST + annotation["track_id"] - 10
        code = annotation["segmentation"]
        assert isinstance(code, dict)  # run lengths, no polygon
        pixels = coco.annToMask(annotation)
        assert (pixels == truth).all()
        assert coco_mask.area(code) == annotation["area"] == np.count_nonzero(truth)
        assert coco_mask.toBbox(code).tolist() == annotation["bbox"]
        again = coco_mask.encode(np.asfortranarray(pixels))
        assert (again["size"], again["counts"].decode()) == (code["size"], code["counts"])
        seen[clip, image["frame_index"]] += 1
    for clip in ("masks_a", "masks_b"):
        actors = [len(np.unique(plane[plane >= FIRST])) for plane in planes[clip]]
        assert [seen[clip, frame] for frame in range(len(actors))] == actors
    assert sum(seen.values()) == len(coco.anns) > 40


def _evaluate(coco: COCO, results: list[dict], kind: str = "bbox") -> np.ndarray:
    """pycocotools' twelve figures; the first is AP50:95, the second AP50."""
    with contextlib.redirect_stdout(io.StringIO()):
        evaluation = COCOeval(coco, coco.loadRes(results), kind)
        evaluation.evaluate()
        evaluation.accumulate()
        evaluation.summarize()
    return evaluation.stats


def _results(coco: COCO) -> list[dict]:
    keys = ("image_id", "category_id", "bbox", "segmentation")
    return [{key: a[key] for key in keys} | {"score": 1.0} for a in coco.anns.values()]


@pytest.mark.parametrize("dataset", ["masks", "march"])
@pytest.mark.parametrize("kind", ["bbox", "segm"])
def test_labels_given_back_are_perfect(export, dataset, kind):
    coco = _coco(export(dataset, "coco"))
    results = _results(coco)
    if kind == "bbox":
        results = [{key: r[key] for key in r if key != "segmentation"} for r in results]
    stats = _evaluate(coco, results, kind)
    assert stats[0] == pytest.approx(1, abs=1e-12)
    assert stats[8] == 1  # average recall


def test_shifted_boxes_are_found_at_smaller_overlaps(export):
    # 3 px of 20 aside: 17 px are common, of 23 in all: IoU 0.739, enough for thresholds 0.5, 0.55 … 0.7, half of them.
    coco = _coco(export("march", "coco"))
    results = [{k: r[k] for k in r if k != "segmentation"} for r in _results(coco)]
    for result in results:
        x, y, width, height = result["bbox"]
        assert width == BOX_WIDTH
        result["bbox"] = [x + 3, y, width, height]
    stats = _evaluate(coco, results)
    assert stats[0] == pytest.approx(0.5, abs=1e-12)
    assert stats[1] == pytest.approx(1, abs=1e-12)


def test_dropped_boxes_cost_recall(export):
    # Of the elephants every fourth is found. Precision is 1 up to a recall of 1/4, 0 beyond: 26 of the recalls 0,
    # 0.01 … 1 are reached. The two other categories are perfect.
    coco = _coco(export("march", "coco"))
    elephant = coco.getCatIds(["elephant"])[0]
    count = itertools.count()
    kept = [r for r in _results(coco) if r["category_id"] != elephant or next(count) % 4 == 0]
    assert next(count) % 4 == 0
    stats = _evaluate(coco, [{k: r[k] for k in r if k != "segmentation"} for r in kept])
    assert stats[0] == pytest.approx((2 + 26 / 101) / 3, abs=1e-12)


def test_splits_are_the_whole(export, place):
    folder = export("march", "coco", "--split", "train:0.5,val:0.5")
    with contextlib.redirect_stdout(io.StringIO()):
        parts = [COCO(str(folder / "annotations" / f"{name}.json")) for name in ("train", "val")]
    whole = json.loads((place.folder / "march" / "annotations.json").read_text())
    assert sorted(i for part in parts for i in part.anns) == [a["id"] for a in whole["annotations"]]
    assert {len(part.dataset["videos"]) for part in parts} == {1}
    for part in parts:
        assert all((folder / image["file_name"]).is_file() for image in part.imgs.values())


# --- MOTChallenge in motmetrics ---------------------------------------------------------------------------------------


def _rows(folder, clip: str):
    """A clip's table, by frame and track."""
    return motmetrics.io.loadtxt(str(folder / "train" / clip / "gt" / "gt.txt"), fmt="mot16")


def _compare(truth, found) -> dict:
    """motmetrics' figures where boxes match that overlap by at least half."""
    accumulator = motmetrics.utils.compare_to_groundtruth(truth, found, "iou", distth=0.5)
    names = ["mota", "idf1", "num_misses", "num_false_positives", "num_switches", "num_objects"]
    return motmetrics.metrics.create().compute(accumulator, metrics=names).iloc[0].to_dict()


def test_rows_are_read_as_the_dataset_has_them(export, place):
    document = json.loads((place.folder / "march" / "annotations.json").read_text())
    folder = export("march", "mot")
    for video, clip in enumerate(CLIPS, 1):
        rows = _rows(folder, clip)
        frames = {i["id"]: i["frame_index"] for i in document["images"] if i["video_id"] == video}
        labels = {
            (frames[a["image_id"]] + 1, a["track_id"]): (a["bbox"], a["category_id"])
            for a in document["annotations"]
            if a["image_id"] in frames
        }
        # motmetrics takes one from X and Y, for MOTChallenge's pixels count from 1.
        read = {
            key: ([row.X, row.Y, row.Width, row.Height], row.ClassId)
            for key, row in zip(rows.index, rows.itertuples())
        }
        assert read == labels
        assert set(rows.Confidence) == set(rows.Visibility) == {1}


@pytest.mark.parametrize("clip", CLIPS)
def test_tracks_given_back_are_perfect(export, clip):
    rows = _rows(export("march", "mot"), clip)
    figures = _compare(rows, rows)
    assert (figures["mota"], figures["idf1"], figures["num_objects"]) == (1, 1, 20 * ACTORS - 4)


def test_odd_boxes_given_back_are_perfect_too(export):
    rows = _rows(export("masks", "mot"), "masks_b")
    figures = _compare(rows, rows)
    assert (figures["mota"], figures["idf1"]) == (1, 1)


@pytest.mark.parametrize("dropped", [1, 7, 29])
def test_dropped_boxes_are_misses(export, dropped):
    # MOTA = 1 - misses / n. IDF1 = 2 IDTP / (boxes of the truth + boxes found), of which IDTP is what is left.
    rows = _rows(export("march", "mot"), "march_a")
    n = len(rows)
    keep = np.ones(n, bool)
    keep[np.linspace(0, n - 1, dropped).astype(int)] = False
    figures = _compare(rows, rows[keep])
    assert (figures["num_misses"], figures["num_false_positives"]) == (dropped, 0)
    assert figures["mota"] == pytest.approx(1 - dropped / n, abs=1e-12)
    assert figures["idf1"] == pytest.approx(2 * (n - dropped) / (2 * n - dropped), abs=1e-12)


def test_boxes_shifted_past_half_are_missed_and_false(export):
    # Aside by s of 20 px the overlap is (20 - s) / (20 + s): 7/13 at 6 px, still a match, 3/7 at 8 px, none.
    rows = _rows(export("march", "mot"), "march_a")
    n, shifted = len(rows), np.zeros(len(rows), bool)
    shifted[::9] = True
    near, far = rows.copy(), rows.copy()
    near.loc[shifted, "X"] += 6
    far.loc[shifted, "X"] += 8
    assert _compare(rows, near)["mota"] == 1
    figures = _compare(rows, far)
    k = int(shifted.sum())
    assert (figures["num_misses"], figures["num_false_positives"]) == (k, k)
    assert figures["mota"] == pytest.approx(1 - 2 * k / n, abs=1e-12)
    assert figures["idf1"] == pytest.approx((n - k) / n, abs=1e-12)


def test_two_tracks_that_swap_names_are_switches(export):
    # From frame 11 on the first two tracks, 20 boxes, have each other's name: a switch each, nothing missed.
    rows = _rows(export("march", "mot"), "march_a")
    swapped = rows.reset_index()
    late = swapped.FrameId > 10
    swapped.loc[late, "Id"] = swapped.loc[late, "Id"].replace({10: 11, 11: 10})
    figures = _compare(rows, swapped.set_index(["FrameId", "Id"]))
    assert figures["num_switches"] == 2
    assert figures["mota"] == pytest.approx(1 - 2 / len(rows), abs=1e-12)


# --- YOLO in supervision ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dataset", ["masks", "march"])
def test_boxes_come_back_from_yolo(export, place, dataset):
    folder = export(dataset, "yolo")
    read = supervision.DetectionDataset.from_yolo(
        str(folder / "images" / "train"), str(folder / "labels" / "train"), str(folder / "data.yaml")
    )
    document = json.loads((place.folder / dataset / "annotations.json").read_text())
    assert read.classes == [category["name"] for category in document["categories"]]
    assert len(read) == len(document["images"])
    places = {category["id"]: k for k, category in enumerate(document["categories"])}
    negatives = 0
    for image in document["images"]:
        clip = document["videos"][image["video_id"] - 1]["name"]
        found = read.annotations[str(folder / "images" / "train" / f"{clip}_{image['frame_index']:06d}.png")]
        labels = [a for a in document["annotations"] if a["image_id"] == image["id"]]
        negatives += not labels
        assert len(found) == len(labels)
        for k, label in enumerate(labels):
            x, y, width, height = label["bbox"]
            assert np.abs(found.xyxy[k] - [x, y, x + width, y + height]).max() < 1e-3
            assert found.class_id[k] == places[label["category_id"]]
    assert negatives == 2


def test_data_yaml_leads_to_the_pictures(export):
    folder = export("march", "yolo", "--split", "train:0.5,val:0.5")
    data = yaml.safe_load((folder / "data.yaml").read_text())
    assert data["names"] == {0: "human", 1: "elephant", 2: "zebra"}
    for split in ("train", "val"):
        assert len(list((folder / data["path"] / data[split]).glob("*.png"))) == 21


# --- tar files in webdataset ------------------------------------------------------------------------------------------


def _samples(shards: list, *stages) -> list:
    """Samples as a training reads them: JSON and pictures decoded, shards and samples in their order."""
    urls = [str(shard) for shard in shards]
    dataset = webdataset.WebDataset(urls, shardshuffle=False, empty_check=True).decode("l8")
    for stage, arguments in stages:
        dataset = getattr(dataset, stage)(*arguments)
    return list(dataset)


@pytest.mark.parametrize("size", [7, 1000])
def test_samples_are_the_pictures_with_their_labels(export, place, size):
    folder = export("masks", "webdataset", "--samples-per-shard", str(size))
    document = json.loads((place.folder / "masks" / "annotations.json").read_text())
    samples = _samples(sorted(folder.glob("train/*.tar")))
    assert len(samples) == len(document["images"]) == 18
    for sample, image in zip(samples, document["images"]):
        clip = document["videos"][image["video_id"] - 1]["name"]
        assert sample["__key__"] == f"{clip}_{image['frame_index']:06d}"
        labels = sample["json"]
        assert (labels["clip"], labels["frame_index"]) == (clip, image["frame_index"])
        found = [(a["category_id"], a["track_id"], a["bbox"]) for a in labels["annotations"]]
        of_image = [a for a in document["annotations"] if a["image_id"] == image["id"]]
        assert found == [(a["category_id"], a["track_id"], a["bbox"]) for a in of_image]


def test_pictures_have_the_dataset_s_pixels(export, place):
    folder = export("march", "webdataset", "--split", "train:0.5,val:0.5")
    for split in ("train", "val"):
        shards = list((folder / split).glob("*.tar"))
        pairs = _samples(shards, ("to_tuple", ("png", "json")))
        assert len(pairs) == 21
        for picture, labels in pairs:
            file = (
                place.folder / "march" / "clips" / labels["clip"] / "ir8" / f"{labels['frame_index']:06d}.png"
            )
            assert (np.asarray(picture) == np.asarray(Image.open(file))).all()
            assert picture.shape == (labels["height"], labels["width"])
