"""`evaluate` gives the same results as pycocotools for the same files."""

import contextlib
import io
from collections import Counter

import numpy as np
import pytest
from pycocotools.coco import COCO
from pycocotools.cocoeval import COCOeval

WIDTH, HEIGHT = 640, 512
TOLERANCE = (
    1e-12  # the same figures, at most 4 categories x 10 IoUs x 101 recalls, added in other orders: n/2 eps
)


class HonouringIgnore(COCOeval):
    """pycocotools overwrites `ignore` by `iscrowd`. This puts it back, so that targets to be ignored are taken like
    those out of its area range: matched once, last and at their plain IoU, and not counted."""

    def _prepare(self):
        marked = {label["id"] for label in self.cocoGt.dataset["annotations"] if label.get("ignore")}
        super()._prepare()
        for labels in self._gts.values():
            for label in labels:
                label["ignore"] = label["ignore"] or label["id"] in marked


def _figure(precision):
    """Mean of the defined values, or None."""
    defined = precision[precision > -1]
    return float(np.mean(defined)) if defined.size else None


def _evaluated(kind, truth, detections, **parameters):
    """pycocotools' evaluation of all areas; `parameters` replace its own."""
    with contextlib.redirect_stdout(io.StringIO()):
        coco = COCO(str(truth))
        found = kind(coco, coco.loadRes(str(detections)), "bbox")
        found.params.areaRng, found.params.areaRngLbl = [[0, 1e10]], ["all"]
        for name, value in parameters.items():
            setattr(found.params, name, value)
        found.evaluate()
    return found


def _average_precision(found):
    """By category's name, and of all: (at IoU 0.5, at 0.5 to 0.95)."""
    with contextlib.redirect_stdout(io.StringIO()):
        found.accumulate()
    precision = found.eval["precision"][:, :, :, 0, -1]  # IoU, recall, category
    figures = {"all": precision}
    for place, category in enumerate(found.cocoGt.loadCats(found.params.catIds)):
        figures[category["name"]] = precision[:, :, place]
    return {name: (_figure(part[0]), _figure(part)) for name, part in figures.items()}


def _counts(found, score):
    """By category's name: [true positives, false positives, false negatives] at the first IoU.

    Detections are matched by decreasing score, so those below `score` do not affect the others."""
    names = {category["id"]: category["name"] for category in found.cocoGt.dataset["categories"]}
    counts = {name: np.zeros(3, int) for name in names.values()}
    for one in filter(None, found.evalImgs):
        sure = np.array(one["dtScores"]) >= score
        matched, ignored = one["dtMatches"][0] > 0, one["dtIgnore"][0]
        right, wrong = np.sum(sure & matched & ~ignored), np.sum(sure & ~matched)
        missed = np.sum(one["gtIgnore"] == 0) - right
        counts[names[one["category_id"]]] += (right, wrong, missed)
    return {name: count.tolist() for name, count in counts.items()}


def _report(veldt, *options):
    """The program's result for the same files."""
    done = veldt("evaluate", "--truth", "truth.json", "--detections", "found.json", "--json", *options)
    assert (done.code, done.err) == (0, "")
    return done.json()


def _assert_same_precision(report, theirs):
    ours = {"all": report["average_precision"]}
    ours |= {category["name"]: category["average_precision"] for category in report["categories"]}
    assert ours.keys() == theirs.keys()
    for name, figures in theirs.items():
        assert tuple(ours[name].values()) == pytest.approx(figures, rel=0, abs=TOLERANCE), name


def _assert_same_counts(report, theirs):
    keys = ("true_positives", "false_positives", "false_negatives")
    ours = {c["name"]: [c["sizes"]["all"][key] for key in keys] for c in report["categories"]}
    assert ours == theirs
    assert [report["sizes"]["all"][key] for key in keys] == np.sum(list(theirs.values()), axis=0).tolist()


def _box(random, whole):
    sides = np.exp(random.uniform(0, 5, 2))
    corner = random.uniform(0, 1, 2) * (WIDTH, HEIGHT) - sides / 2
    box = np.concatenate([corner, sides])
    box = np.round(box) + (0, 0, 1, 1) if whole else box
    box[:2] = np.clip(box[:2], -sides / 2, (WIDTH, HEIGHT))
    return box


def _near(random, box, whole):
    """A box near another one, or equal to it."""
    if random.random() < 0.2:
        return box
    moved = box + random.normal(0, 0.15, 4) * np.tile(box[2:], 2)
    moved[2:] = np.maximum(moved[2:], 0)
    moved = np.round(moved) if whole else moved
    moved[:2] = np.clip(moved[:2], -moved[2:], (WIDTH, HEIGHT))
    return moved


def _random_files(seed):
    """A truth and detections with all that makes matching hard: crowds, targets to be ignored, overlapping and equal
    boxes, equal scores, categories without targets or detections, empty pictures, pictures with over 100 detections.
    """
    random = np.random.default_rng(seed)
    whole = bool(seed % 2)  # whole numbers make equal overlaps likely
    scores = [None, 10, 2][seed % 3]  # distinct scores there are
    categories = [3, 7, 1, 4][: random.integers(1, 5)]
    images = random.permutation(1000)[: random.integers(1, 12)].tolist()
    labels, found = [], []
    for image in images:
        crowded = random.random() < 0.1
        for category in categories[: random.integers(0, len(categories) + 1)]:
            boxes = [_box(random, whole) for _ in range(random.poisson(12 if crowded else 3))]
            boxes += [boxes[0]] if boxes and random.random() < 0.1 else []
            for box in boxes:
                labels.append(
                    {
                        "id": len(labels) + 1,
                        "image_id": image,
                        "category_id": category,
                        "bbox": box.tolist(),
                        "area": float(box[2] * box[3]),
                        "iscrowd": int(random.random() < 0.1),
                        "ignore": int(random.random() < 0.2),
                    }
                )
            guesses = [_near(random, box, whole) for box in boxes for _ in range(random.integers(0, 4))]
            guesses += [_box(random, whole) for _ in range(150 if crowded else random.integers(0, 5))]
            for box in guesses:
                score = random.random() if scores is None else int(random.integers(0, scores)) / scores
                found.append(
                    {"image_id": image, "category_id": category, "bbox": box.tolist(), "score": score}
                )
    if not labels or not found:
        return _random_files(
            seed + 1000
        )  # pycocotools reads no empty results, and ours measures nothing without labels
    random.shuffle(found)
    random.shuffle(labels)
    return {
        "info": {},  # pycocotools copies it
        "images": [{"id": id, "file_name": f"{id}.png", "width": WIDTH, "height": HEIGHT} for id in images],
        "categories": [{"id": id, "name": f"kind {id}"} for id in categories],
        "annotations": labels,
    }, found


SEEDS = range(48)
OPTIONS = {"--count-ignored": COCOeval, None: HonouringIgnore}


@pytest.mark.parametrize("seed", SEEDS)
def test_any_set_is_measured_as_pycocotools_measures_it(veldt, seed):
    truth, found = _random_files(seed)
    files = veldt.write("truth.json", truth), veldt.write("found.json", found)
    iou, score = (0.5, 0.5) if seed % 4 else (0.75, 0.2)
    for option, kind in OPTIONS.items():
        report = _report(veldt, "--iou", iou, "--score", score, *filter(None, [option]))
        _assert_same_precision(report, _average_precision(_evaluated(kind, *files)))
        all_matched = _evaluated(kind, *files, iouThrs=[iou], maxDets=[10**6])
        _assert_same_counts(report, _counts(all_matched, score))


def test_random_sets_are_hard():
    """Ignored targets, crowds, ties and the limit of 100 detections make a difference in the sets above."""
    sets = [_random_files(seed) for seed in SEEDS]
    for key in ("iscrowd", "ignore"):
        assert sum(any(label[key] for label in truth["annotations"]) for truth, _ in sets) > 30
    most = [max(Counter((d["image_id"], d["category_id"]) for d in found).values()) for _, found in sets]
    assert sum(number > 100 for number in most) > 10
    assert sum(len({d["score"] for d in found}) < len(found) for _, found in sets) >= 30


def test_the_truth_given_back_is_perfect_for_both(veldt):
    truth, _ = _random_files(5)
    for label in truth["annotations"]:
        label["iscrowd"] = label["ignore"] = 0
    found = [
        {key: label[key] for key in ("image_id", "category_id", "bbox")} | {"score": 1}
        for label in truth["annotations"]
    ]
    files = veldt.write("truth.json", truth), veldt.write("found.json", found)
    report = _report(veldt)
    assert (report["sizes"]["all"]["precision"], report["sizes"]["all"]["recall"]) == (1, 1)
    assert report["average_precision"] == {"ap50": 1, "ap50_95": 1}
    _assert_same_precision(report, _average_precision(_evaluated(COCOeval, *files)))
