"""`evaluate` reports how well a detector found the targets of a dataset, by clip, category and size class."""

import pytest

import passes

HUMAN, ELEPHANT = 1, 2

# Two clips of two pictures. A human of 100 px, track 1, in all of them; an elephant of 400 px in the first of each.
BOXES = {HUMAN: [10, 10, 10, 10], ELEPHANT: [100, 100, 20, 20]}
TARGETS = [(1, HUMAN), (1, ELEPHANT), (2, HUMAN), (3, HUMAN), (3, ELEPHANT), (4, HUMAN)]


def _truth(**changes):
    return {
        "videos": [{"id": 1, "name": "day"}, {"id": 2, "name": "night"}],
        "images": [
            {
                "id": id,
                "file_name": f"{id}.png",
                "width": 640,
                "height": 512,
                "video_id": 1 + (id - 1) // 2,
                "frame_index": (id - 1) % 2,
            }
            for id in (1, 2, 3, 4)
        ],
        "categories": [{"id": HUMAN, "name": "human"}, {"id": ELEPHANT, "name": "elephant"}],
        "annotations": [
            {
                "id": i + 1,
                "image_id": image,
                "category_id": category,
                "bbox": BOXES[category],
                "track_id": category,
            }
            for i, (image, category) in enumerate(TARGETS)
        ],
    } | changes


def _answers(targets=None, score=0.9):
    """The output of a detector that finds exactly these targets."""
    return [
        {"image_id": image, "category_id": category, "bbox": BOXES[category], "score": score}
        for image, category in (TARGETS if targets is None else targets)
    ]


@pytest.fixture(name="evaluate")
def _evaluate(veldt):
    """Run `evaluate` on detections of _truth() and return its output."""
    veldt.write("truth.json", _truth())

    def run(detections, *options):
        veldt.write("found.json", detections)
        done = veldt("evaluate", "--truth", "truth.json", "--detections", "found.json", *options)
        assert (done.code, done.err) == (0, "")
        return done

    return run


def _row(found, wrong, missed):
    """A cell of the report: (precision, recall, true positives, false positives, false negatives)."""
    return {
        "precision": found / (found + wrong) if found + wrong else None,
        "recall": found / (found + missed) if found + missed else None,
        "true_positives": found,
        "false_positives": wrong,
        "false_negatives": missed,
    }


def _sizes(small, medium):
    both = [sum(pair) for pair in zip(small, medium)]
    return {"small": _row(*small), "medium": _row(*medium), "large": _row(0, 0, 0), "all": _row(*both)}


def test_the_whole_report(evaluate):
    found = _answers(TARGETS[1:])  # the first human is missed
    found.append({"image_id": 4, "category_id": ELEPHANT, "bbox": BOXES[ELEPHANT], "score": 0.6})
    found.append({"image_id": 4, "category_id": ELEPHANT, "bbox": BOXES[ELEPHANT], "score": 0.4})
    human = {"ap50": pytest.approx(76 / 101), "ap50_95": pytest.approx(76 / 101)}  # up to recall 3/4
    assert evaluate(found, "--json").json() == {
        "truth": "truth.json",
        "detections": "found.json",
        "iou": 0.5,
        "score": 0.5,
        "count_ignored": False,
        "pictures": 4,
        "targets": 6,
        "ignored_targets": 0,
        "detections_read": 7,
        "ignored_detections": 0,
        "average_precision": {key: pytest.approx((76 / 101 + 1) / 2) for key in human},
        "sizes": _sizes((3, 0, 1), (2, 1, 0)),
        "categories": [
            {"name": "human", "average_precision": human, "sizes": _sizes((3, 0, 1), (0, 0, 0))},
            {
                "name": "elephant",
                "average_precision": {"ap50": 1, "ap50_95": 1},
                "sizes": _sizes((0, 0, 0), (2, 1, 0)),
            },
        ],
        "clips": [
            {
                "name": "day",
                "sizes": _sizes((1, 0, 1), (1, 0, 0)),
                "categories": [
                    {"name": "human", "sizes": _sizes((1, 0, 1), (0, 0, 0))},
                    {"name": "elephant", "sizes": _sizes((0, 0, 0), (1, 0, 0))},
                ],
            },
            {
                "name": "night",
                "sizes": _sizes((2, 0, 0), (1, 1, 0)),
                "categories": [
                    {"name": "human", "sizes": _sizes((2, 0, 0), (0, 0, 0))},
                    {"name": "elephant", "sizes": _sizes((0, 0, 0), (1, 1, 0))},
                ],
            },
        ],
    }


TABLES = """\
4 pictures; 6 targets, 0 of them ignored
6 detections, 6 of score 0.5 or more, 0 of these on ignored targets
a target is found at IoU 0.5 or more

precision and recall           small          medium           large             all
day                    1.000   0.500   1.000   1.000       -       -   1.000   0.667
night                  1.000   1.000   0.500   1.000       -       -   0.750   1.000

human                  1.000   0.750       -       -       -       -   1.000   0.750
elephant                   -       -   0.667   1.000       -       -   0.667   1.000
all                    1.000   0.750   0.667   1.000       -       -   0.833   0.833

TP/FP/FN                       small          medium           large             all
day                            1/0/1           1/0/0           0/0/0           2/0/1
night                          2/0/0           1/1/0           0/0/0           3/1/0

human                          3/0/1           0/0/0           0/0/0           3/0/1
elephant                       0/0/0           2/1/0           0/0/0           2/1/0
all                            3/0/1           2/1/0           0/0/0           5/1/1

average precision       AP50 AP50:95
human                  0.752   0.752
elephant               1.000   1.000
mean                   0.876   0.876
"""


def test_the_tables(evaluate):
    found = _answers(TARGETS[1:])
    found.append({"image_id": 4, "category_id": ELEPHANT, "bbox": BOXES[ELEPHANT], "score": 0.6})
    assert evaluate(found).out == TABLES


def test_the_truth_given_back_is_perfect(evaluate):
    report = evaluate(_answers(), "--json").json()
    assert report["sizes"] == _sizes((4, 0, 0), (2, 0, 0))
    assert report["average_precision"] == {"ap50": 1, "ap50_95": 1}


def test_no_detections_are_allowed(evaluate):
    report = evaluate([], "--json").json()
    assert report["sizes"] == _sizes((0, 0, 4), (0, 0, 2))
    assert report["sizes"]["all"]["precision"] is None
    assert report["average_precision"] == {"ap50": 0, "ap50_95": 0}
    rates = [line for line in evaluate([]).out.splitlines() if line.startswith("all ")][0]
    assert rates.split() == ["all", "-", "0.000", "-", "0.000", "-", "-", "-", "0.000"]


def test_iou_and_score_are_chosen(evaluate):
    shifted = [d | {"bbox": [d["bbox"][0] + d["bbox"][2] / 4, *d["bbox"][1:]]} for d in _answers(score=0.3)]
    assert evaluate(shifted, "--json").json()["sizes"] == _sizes((0, 0, 4), (0, 0, 2))
    report = evaluate(shifted, "--score", "0.3", "--json").json()
    assert (report["score"], report["sizes"]) == (0.3, _sizes((4, 0, 0), (2, 0, 0)))
    report = evaluate(shifted, "--score", "0.3", "--iou", "0.61", "--json").json()  # 3/4 shared of 5/4
    assert (report["iou"], report["sizes"]) == (0.61, _sizes((0, 4, 4), (0, 2, 2)))
    assert report["average_precision"] == {"ap50": 1, "ap50_95": pytest.approx(0.3)}  # at 0.5, 0.55 and 0.6


def test_ignored_targets_count_only_if_asked(veldt, evaluate):
    truth = _truth()
    for label in truth["annotations"]:
        label["ignore"] = label["category_id"] == HUMAN
    veldt.write("truth.json", truth)
    report = evaluate(_answers(), "--json").json()
    assert (report["ignored_targets"], report["ignored_detections"]) == (4, 4)
    assert report["sizes"] == _sizes((0, 0, 0), (2, 0, 0))
    assert report["categories"][0]["average_precision"] == {"ap50": None, "ap50_95": None}
    assert report["average_precision"] == {"ap50": 1, "ap50_95": 1}
    report = evaluate(_answers(TARGETS[:2]), "--count-ignored", "--json").json()
    assert (report["count_ignored"], report["ignored_targets"], report["ignored_detections"]) == (True, 0, 0)
    assert report["sizes"] == _sizes((1, 0, 3), (1, 0, 1))


def test_yolo_results_measure_the_same(veldt, evaluate):
    (veldt.folder / "found").mkdir()
    for image, category in TARGETS[1:]:
        x, y, width, height = BOXES[category]
        numbers = ((x + width / 2) / 640, (y + height / 2) / 512, width / 640, height / 512, 0.9)
        name = f"{'day' if image < 3 else 'night'}_{image}.txt"
        with open(veldt.folder / "found" / name, "a", encoding="utf-8") as file:
            file.write(" ".join(map(str, (category - 1, *numbers))) + "\n")
    yolo = veldt("evaluate", "--truth", "truth.json", "--detections", "found", "--json")
    assert (yolo.code, yolo.err) == (0, "")
    assert yolo.json() | {"detections": "found.json"} == evaluate(_answers(TARGETS[1:]), "--json").json()


def test_our_own_dataset_is_a_truth(veldt):
    folders = [passes.write_clip(veldt.folder / clip, clip) for clip in ("one", "two")]
    assert veldt("convert", *folders, "--out", "out", "--quiet").code == 0
    labels = veldt.read("out/annotations.json")["annotations"]
    veldt.write("found.json", [label | {"score": 1} for label in labels])
    report = veldt(
        "evaluate", "--truth", "out", "--detections", "found.json", "--count-ignored", "--json"
    ).json()
    assert [clip["name"] for clip in report["clips"]] == ["one", "two"]
    assert report["sizes"]["all"] == _row(len(labels), 0, 0)
    assert report["average_precision"] == {"ap50": 1, "ap50_95": 1}


def test_birdsai_is_a_truth(veldt):
    (veldt.folder / "birdsai" / "annotations").mkdir(parents=True)
    veldt.write("birdsai/annotations/0001.csv", "0,7,10,10,10,10,1,0,0,0\n0,8,100,100,20,20,0,1,0,0\n")
    veldt.write("found.json", _answers(TARGETS[:2]))
    report = veldt("evaluate", "--truth", "birdsai", "--detections", "found.json", "--json").json()
    assert [(clip["name"], clip["sizes"]) for clip in report["clips"]] == [
        ("0001", _sizes((1, 0, 0), (1, 0, 0)))
    ]


def test_long_names_and_large_counts_stay_in_their_columns(veldt):
    images = [{"id": i, "file_name": f"{i}.png", "width": 640, "height": 512} for i in range(250)]
    categories = [{"id": 1, "name": "a name that is longer than the column"}]
    labels = [
        {"id": i, "image_id": i // 80, "category_id": 1, "bbox": [i % 80, 10 * (i % 2), 1, 9]}
        for i in range(20000)
    ]
    veldt.write("truth.json", {"images": images, "categories": categories, "annotations": labels})
    veldt.write("found.json", [label | {"score": 1} for label in labels[:10000]] * 2)
    done = veldt("evaluate", "--truth", "truth.json", "--detections", "found.json")
    assert done.code == 0
    rates, rates_in_all, counts, counts_in_all, _ = done.out.split("\n\n")[1:]
    assert "a name that is longer than the column 10000/10000/10000 " in counts_in_all
    assert len({len(line) for part in (rates, rates_in_all) for line in part.splitlines()}) == 1
    assert len({len(line) for part in (counts, counts_in_all) for line in part.splitlines()}) == 1


# --- files of other programs ------------------------------------------------------------------------------------------


def _precision(veldt, truth, detections):
    """Average precision at IoU 0.5 by category."""
    veldt.write("truth.json", truth)
    veldt.write("found.json", detections)
    done = veldt("evaluate", "--truth", "truth.json", "--detections", "found.json", "--json")
    assert (done.code, done.err) == (0, "")
    return {one["name"]: one["average_precision"]["ap50"] for one in done.json()["categories"]}


def test_results_of_ultralytics_name_pictures_and_count_classes(veldt):
    names = [f"night/{k:06d}.png" for k in range(3)]
    categories = {1: "human", 2: "elephant", 5: "zebra"}
    truth = {
        "images": [{"id": k + 1, "file_name": n, "width": 640, "height": 512} for k, n in enumerate(names)],
        "categories": [{"id": id, "name": name} for id, name in categories.items()],
        "annotations": [
            {"id": k + 1, "image_id": k + 1, "category_id": id, "bbox": [10 + 60 * k, 20, 30, 40]}
            for k, id in enumerate(categories)
        ],
    }
    found = [
        {
            "image_id": f"night_{k:06d}",
            "file_name": f"night_{k:06d}.png",
            "category_id": k + 1,
            "bbox": [10 + 60 * k, 20, 30, 40],
            "score": 0.9,
        }
        for k in range(3)
    ]
    assert _precision(veldt, truth, found) == {"human": 1, "elephant": 1, "zebra": 1}


def test_camera_traps_have_ids_of_text_and_empty_pictures(veldt):
    truth = {
        "images": [
            {"id": f"site1/{k}", "file_name": f"site1/{k}.png", "seq_id": "s", "frame_num": k} for k in (0, 1)
        ],
        "categories": [{"id": 0, "name": "empty"}, {"id": 1, "name": "elephant"}],
        "annotations": [
            {"id": "7f2c-a", "image_id": "site1/0", "category_id": 1, "bbox": [10.5, 20.25, 30, 40]},
            {"id": "7f2c-b", "image_id": "site1/1", "category_id": 0},
        ],
    }
    found = [{"image_id": "site1/0", "category_id": 1, "bbox": [10, 20, 30, 40], "score": 0.9}]
    assert _precision(veldt, truth, found) == {"elephant": 1}


def test_ids_may_be_floats(veldt):
    truth = {
        "images": [{"id": 1, "file_name": "a/0001.png", "width": 64.0, "height": 48}],
        "categories": [{"id": 1, "name": "human"}],
        "annotations": [
            {"id": 1, "image_id": 1.0, "category_id": 1.0, "bbox": [10, 8, 20, 30], "area": 600.0}
        ],
    }
    found = [{"image_id": 1, "category_id": 1, "bbox": [10, 8, 20, 30], "score": 0.9}]
    assert _precision(veldt, truth, found) == {"human": 1}
