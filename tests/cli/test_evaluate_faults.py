"""Inputs that `evaluate` rejects with exact messages and no other output."""

import pytest

TRUTH = {
    "images": [{"id": 1, "file_name": "1.png", "width": 640, "height": 512}],
    "categories": [{"id": 1, "name": "human"}, {"id": 2, "name": "elephant"}],
    "annotations": [{"id": 1, "image_id": 1, "category_id": 1, "bbox": [10, 10, 10, 10]}],
}
GOOD = '{"image_id": 1, "category_id": 1, "bbox": [10, 10, 10, 10], "score": 0.9}'


def _changed(old, new):
    """Results of two detections, the second one changed."""
    assert old in GOOD
    return f"[{GOOD},\n {GOOD.replace(old, new)}]"


BOX = "[10, 10, 10, 10]"
NOT_FINITE = "; expected a finite number: JSON has no NaN and no Infinity, though Python writes them"
NO_LIST = 'no list of detections; expected [{"image_id", "category_id", "bbox", "score"}, …]'
FORM_OF_BOX = "expected x, y, width and height in px, the last two not negative"
INSIDE = "expected a box that touches its picture, 640 x 512 px"

# What the results file holds: what is said of it.
RESULTS = {
    "unknown picture": (
        _changed('"image_id": 1', '"image_id": 9'),
        ": [1].image_id = 9; expected the id of one of the truth's pictures",
    ),
    "unknown category": (
        _changed('"category_id": 1', '"category_id": 3'),
        ": [1].category_id = 3; expected one of 1 (human), 2 (elephant)",
    ),
    "category by name": (
        _changed('"category_id": 1', '"category_id": "humen"'),
        ': [1].category_id = "humen"; expected one of 1 (human), 2 (elephant); did you mean "human"?',
    ),
    "picture of another name": (
        _changed('"image_id": 1', '"image_id": 1, "file_name": "2.png"'),
        ': [1].image_id = 1; expected the id of its file_name, "2.png", and not of 1.png',
    ),
    "score null": (_changed("0.9", "null"), ": [1].score = null; expected a finite number"),
    "score text": (_changed("0.9", '"0.9"'), ': [1].score = "0.9"; expected a finite number'),
    "score missing": (_changed(', "score": 0.9', ""), ": [1].score = nothing; expected one"),
    "side below 0": (
        _changed(BOX, "[10, 10, -1, 10]"),
        f": [1].bbox = [10,10,-1,10]; {FORM_OF_BOX}",
    ),
    "three numbers": (_changed(BOX, "[10, 10, 10]"), f": [1].bbox = [10,10,10]; {FORM_OF_BOX}"),
    "box right of the picture": (
        _changed(BOX, "[641, 10, 10, 10]"),
        f": [1].bbox = [641,10,10,10]; {INSIDE}",
    ),
    "box above the picture": (_changed(BOX, "[10, -20, 10, 10]"), f": [1].bbox = [10,-20,10,10]; {INSIDE}"),
    "annotations, not results": (f'{{"annotations": [{GOOD}]}}', f": {NO_LIST}"),
    "an object": ("{}", f": {NO_LIST}"),
    "a list of numbers": ("[1, 2]", ": [0] = 1; expected an object"),
    "number too large": (_changed("0.9", "1e999"), ": not JSON: number overflow parsing '1e999'"),
}


def _said(veldt, results, *options):
    """What is said on standard error of results that are refused."""
    if not (veldt.folder / "truth.json").exists():
        veldt.write("truth.json", TRUTH)
    veldt.write("found.json", results)
    before = sorted(veldt.folder.iterdir())
    done = veldt("evaluate", "--truth", "truth.json", "--detections", "found.json", "--json", *options)
    assert (done.code, done.out) == (1, "")
    assert sorted(veldt.folder.iterdir()) == before
    return done.err


@pytest.mark.parametrize("name", RESULTS)
def test_results_that_cannot_be(veldt, name):
    results, message = RESULTS[name]
    assert _said(veldt, results) == f"veldt: found.json{message}\n"


@pytest.mark.parametrize("score", ["NaN", "Infinity", "-Infinity"])
def test_python_writes_what_is_not_json(veldt, score):
    column = f" {GOOD}".index("0.9") + 1 + score.startswith("-")  # the parser stops at the first letter
    said = _said(veldt, _changed("0.9", score))
    assert said.startswith(f"veldt: found.json:2:{column}: not JSON: syntax error while parsing value")
    assert said.endswith(f"{NOT_FINITE}\n")


def test_results_cut_short(veldt):
    assert _said(veldt, f"[{GOOD}").startswith("veldt: found.json:1:75: not JSON: syntax error while parsing")


def test_a_truth_without_labels_has_nothing_to_measure(veldt):
    veldt.write("truth.json", TRUTH | {"annotations": []})
    assert _said(veldt, "[]") == ("veldt: truth.json = 0 labels; expected at least one\n")


def test_results_that_are_not_there(veldt):
    veldt.write("truth.json", TRUTH)
    done = veldt("evaluate", "--truth", "truth.json", "--detections", "missing.json")
    assert (done.code, done.out) == (1, "")
    assert done.err == "veldt: cannot read missing.json: No such file or directory\n"


# File of a folder of YOLO results, what it holds: what is said of it.
YOLO = {
    "no such picture": (
        "truth_2.txt",
        "",
        ': names no picture of the truth; expected VIDEO_PICTURE.txt; did you mean "truth_1"?',
    ),
    "no score": ("truth_1.txt", "0 .5 .5 .1 .1\n", ":1 = 5 words; expected class cx cy w h score"),
    "unknown class": (
        "truth_1.txt",
        "0 .5 .5 .1 .1 1\n2 .5 .5 .1 .1 1\n",
        ":2: class = 2; expected one of 0 (human), 1 (elephant)",
    ),
    "score nan": ("truth_1.txt", "0 .5 .5 .1 .1 nan", ":1: score = nan; expected a finite number"),
    "pixels": (
        "truth_1.txt",
        "0 320 256 10 10 1",
        ":1: box = [320, 256, 10, 10]; expected a box that touches its picture, 640 x 512 px",
    ),
}


@pytest.mark.parametrize("name", YOLO)
def test_yolo_results_that_cannot_be(veldt, name):
    file, text, message = YOLO[name]
    veldt.write("truth.json", TRUTH)
    (veldt.folder / "found").mkdir()
    veldt.write(f"found/{file}", text)
    done = veldt("evaluate", "--truth", "truth.json", "--detections", "found")
    assert (done.code, done.out, done.err) == (1, "", f"veldt: found/{file}{message}\n")


OPTIONS = {
    "--iou": {
        "0": "--iou = 0; expected above 0 and at most 1",
        "1.01": "--iou = 1.01; expected above 0 and at most 1",
        "nan": "--iou = nan; expected above 0 and at most 1",
    },
    "--score": {"inf": "--score = inf; expected a finite number"},
}


@pytest.mark.parametrize(
    "option, value", [(option, value) for option in OPTIONS for value in OPTIONS[option]]
)
def test_options_out_of_range(veldt, option, value):
    done = veldt("evaluate", "--truth", "none", "--detections", "none", option, value)
    assert (done.code, done.out, done.err) == (2, "", f"veldt: {OPTIONS[option][value]}\n")


def test_truth_and_detections_are_asked_for(veldt):
    done = veldt("evaluate", "--truth", "truth.json")
    assert (done.code, done.out) == (2, "")
    assert done.err == "veldt: --detections is required; see veldt evaluate --help\n"
