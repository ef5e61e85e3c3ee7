"""`report`: a self-contained page about a dataset that states what it cannot show."""

import base64
import hashlib
import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from pictures import read_grey
from program import files_below
from reports import CLIPS, Page, change, make_dataset

HOSTILE = '</script><script>alert(1)</script><img src=x onerror=alert(2)> & "quoted" \u2028 {{figures}}'


@pytest.fixture(name="dataset")
def _dataset(veldt):
    """Two clips of made-up passes, without poses."""
    return make_dataset(veldt)


def _report(veldt, *arguments) -> Page:
    done = veldt("report", *arguments, "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    out = arguments[arguments.index("--out") + 1] if "--out" in arguments else f"{arguments[0]}/report.html"
    return Page(veldt.folder / out)


def _shown(veldt, frame: dict) -> np.ndarray:
    """The picture of a frame on the page."""
    file = veldt.folder / "frame.jpg"
    file.write_bytes(base64.b64decode(frame["picture"].split(",", 1)[1]))
    return read_grey(file)


# --- the page ---------------------------------------------------------------------------------------------------------


def test_the_page_lies_in_the_dataset_and_changes_nothing_else(veldt, dataset):
    before = files_below(dataset)
    done = veldt("report", "out")
    assert (done.code, done.err) == (0, "")
    assert re.fullmatch(r"out/report\.html: 2 clips, 6 frames, 12 labels, \d+ kB\n", done.out)
    assert files_below(dataset) == sorted([*before, "report.html"])
    assert veldt("validate", "out").code == 0
    assert veldt("convert", *CLIPS, "--out", "out").out == "out: nothing to do, 2 clips already existed\n"


def test_the_published_model_has_no_day(veldt, dataset):
    assert _report(veldt, dataset.name).figures["days"] == []


def test_the_same_dataset_gives_the_same_bytes(veldt, dataset):
    _report(veldt, "out")
    first = (dataset / "report.html").read_bytes()
    _report(veldt, "out")
    _report(veldt, "out", "--out", "page.html")
    assert (dataset / "report.html").read_bytes() == first == (veldt.folder / "page.html").read_bytes()


def test_the_page_needs_nothing_but_itself(veldt, dataset):
    page = _report(veldt, dataset.name)
    for tag, attributes, _ in page.elements:
        assert tag not in ("link", "iframe", "object", "embed", "base")
        for name in ("src", "href", "srcset", "action", "poster"):
            assert name not in attributes, (tag, attributes)
    (style,) = (text for _, text in page.all("style"))
    assert "url(" not in style and "@import" not in style
    assert all(
        frame["picture"].startswith("data:image/jpeg;base64,") for frame in page.figures["samples"]["frames"]
    )


def _source(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def test_the_page_may_run_and_load_nothing_else(veldt, dataset):
    """Its policy allows only its own scripts and style, by their hashes, and no external sources."""
    page = _report(veldt, dataset.name)
    (policy,) = (
        a["content"] for a, _ in page.all("meta") if a.get("http-equiv") == "Content-Security-Policy"
    )
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    code = [text for attributes, text in page.all("script") if "type" not in attributes]
    assert rules == {
        "default-src": "'none'",
        "img-src": "data:",
        "style-src": _source(page.all("style")[0][1]),
        "script-src": " ".join(map(_source, code)),
        "base-uri": "'none'",
        "form-action": "'none'",
    }


def test_the_page_holds_the_chart_librarys_licence(veldt, dataset):
    _report(veldt, "out")
    text = (dataset / "report.html").read_text(encoding="utf-8")
    assert "Chart.js Contributors" in text and "Jukka Kurkela" in text
    assert "The above copyright notice and this permission notice shall be included" in text


def test_names_are_text_whatever_is_in_them(veldt, dataset):
    def rename(document):
        document["categories"][0]["name"] = HOSTILE

    change(dataset / "annotations.json", rename)
    change(dataset / "dataset.json", lambda record: record["config"].update(name=HOSTILE))
    page = _report(veldt, "out")
    assert len(page.all("script")) == 3 and not page.all("img")
    assert page.all("title")[0][1] == f"{HOSTILE} · Veldt report"
    assert page.figures["name"] == HOSTILE
    assert HOSTILE in page.figures["labels"]["categories"]


# --- figures ----------------------------------------------------------------------------------------------------------


@pytest.mark.usefixtures("dataset")
def test_counts_are_those_of_the_labels(veldt):
    labels = _report(veldt, "out").figures["labels"]
    assert (labels["images"], labels["labels"], labels["sizes"]) == (6, 12, [[24, 16]])
    assert labels["categories"] == ["elephant", "human"]
    counts = [
        {key: entry[key] for key in ("small", "medium", "large", "truncated", "tracks")}
        for entry in labels["counts"]
    ]
    small = {"small": 6, "medium": 0, "large": 0, "tracks": 2}
    assert counts == [small | {"truncated": 6}, small | {"truncated": 0}]
    assert [(v["name"], v["images"], v["labels"], v["negatives"]) for v in labels["videos"]] == [
        (clip, 3, 6, 0) for clip in CLIPS
    ]
    document = veldt.read("out/annotations.json")
    for key, values in {
        "area_px": [a["bbox"][2] * a["bbox"][3] for a in document["annotations"]],
        "contrast_k": [a["contrast_k"] for a in document["annotations"]],
    }.items():
        histogram = labels["histograms"][key]
        assert (histogram["known"], histogram["of"]) == (12, 12)
        assert (histogram["least"], histogram["most"]) == (min(values), max(values))
        assert (
            np.sum(histogram["counts"], axis=0).tolist()
            == np.histogram(values, histogram["edges"])[0].tolist()
        )


@pytest.mark.usefixtures("dataset")
def test_the_heat_map_is_the_mean_of_boxes(veldt):
    """Cells of 0.6 x 0.59 px: their sum over the picture is the mean area of boxes."""
    heat = _report(veldt, "out").figures["labels"]["heat"]
    boxes = np.reshape(heat["boxes_over"], (heat["rows"], heat["columns"]))
    areas = [a["bbox"][2] * a["bbox"][3] for a in veldt.read("out/annotations.json")["annotations"]]
    cell_px = 24 / heat["columns"] * 16 / heat["rows"]
    assert boxes.sum() * cell_px == pytest.approx(
        sum(areas) / 6, abs=boxes.size * cell_px * 5e-6
    )  # as rounded
    # The elephant's box, x 0 to 5 and y 10 to 14, is there in every frame.
    row, column = int(12 / 16 * heat["rows"]), int(2.5 / 24 * heat["columns"])
    assert boxes[row, column] == 1
    assert boxes[:3].max() == 0


def test_frames_shown_stand_for_each_clip(veldt, dataset):
    """Frame 2 of `down` loses its labels, frame 1 all but one: most in 0, none in 2; all frames of `side` are equal."""

    def thin(document):
        document["annotations"] = [
            a
            for a in document["annotations"]
            if not (a["image_id"] == 3 or (a["image_id"] == 2 and a["track_id"] == 7))
        ]

    change(dataset / "annotations.json", thin)
    figures = _report(veldt, "out").figures
    shown = [(f["video"], f["frame"], f["why"], len(f["boxes"])) for f in figures["samples"]["frames"]]
    assert shown == [
        ("down", 0, "most labels", 2),
        ("down", 2, "no labels", 0),
        ("side", 0, "most labels", 2),
        ("side", 1, "median", 2),
    ]
    boxes = figures["samples"]["frames"][0]["boxes"]
    assert {(b["track"], *b["box"]) for b in boxes} == {(7, 8, 5, 2, 4), (9, 0, 10, 5, 4)}


def test_pictures_are_the_clips_own(veldt, dataset):
    frame = _report(veldt, "out").figures["samples"]["frames"][0]
    shown = _shown(veldt, frame)
    own = read_grey(dataset / "clips" / "down" / "ir8" / "000000.png")
    assert shown.shape == own.shape
    # Quality 82 divides coefficients of 8 x 8 pixels by up to 44 grey values; noise of small pictures loses a few.
    assert np.abs(shown.astype(float) - own).mean() < 4


# --- what is not there ------------------------------------------------------------------------------------------------


def test_an_older_dataset_has_fewer_figures(veldt, dataset):
    """Made before labels had visibility, contrast and temperature, and before the budget was recorded."""

    def older(document):
        keys = (
            "visibility",
            "occluded",
            "contrast_k",
            "contrast_noise",
            "range_m",
            "temperature_k",
            "ignore",
            "noisy",
        )
        for annotation in document["annotations"]:
            for key in keys:
                annotation.pop(key, None)

    change(dataset / "annotations.json", older)
    change(
        dataset / "dataset.json", lambda record: (record.pop("physics"), record["config"].pop("labels", None))
    )
    figures = _report(veldt, "out").figures
    assert [entry["occluded"] for entry in figures["labels"]["counts"]] == [None, None]
    known = {key: histogram["known"] for key, histogram in figures["labels"]["histograms"].items()}
    assert known == {
        "area_px": 12,
        "visibility": 0,
        "contrast_k": 0,
        "contrast_noise": 0,
        "range_m": 0,
        "temperature_k": 0,
    }


def test_a_dataset_without_labels_has_a_page(veldt, dataset):
    change(dataset / "annotations.json", lambda document: document.update(annotations=[]))
    figures = _report(veldt, "out").figures
    assert figures["labels"]["categories"] == [] and figures["labels"]["unused_categories"] == [
        "human",
        "elephant",
    ]
    assert [f["why"] for f in figures["samples"]["frames"]] == ["no labels", "no labels"]


def _lose_side(dataset):
    """The dataset as it is when a clip has failed."""

    def forget(document):
        document["videos"] = document["videos"][:1]
        document["images"] = [image for image in document["images"] if image["video_id"] == 1]
        ids = {image["id"] for image in document["images"]}
        document["annotations"] = [a for a in document["annotations"] if a["image_id"] in ids]

    def fail(record):
        record["clips"][1] = {"id": "side", "status": "failed", "reason": "Blender was killed"}
        record["status"] = "unfinished"

    change(dataset / "annotations.json", forget)
    change(dataset / "dataset.json", fail)
    shutil.rmtree(dataset / "clips" / "side")


def test_an_unfinished_dataset_is_refused_unless_asked_for(veldt, dataset):
    _lose_side(dataset)
    done = veldt("report", "out")
    assert (done.code, done.out) == (1, "")
    assert done.err == (
        "veldt: out is unfinished: 1 of 2 clips are missing: side; expected all of them, or --unfinished to accept "
        "this\n"
    )
    assert not (dataset / "report.html").exists()
    done = veldt("report", "out", "--unfinished")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("out/report.html: 1 clip, 3 frames, 6 labels, ")
    record = Page(dataset / "report.html").figures["record"]
    assert record["clips"][1]["reason"] == "Blender was killed"


# --- labels of others -------------------------------------------------------------------------------------------------


def test_a_coco_file_has_a_page_beside_it(veldt, dataset):
    (veldt.folder / "mine").mkdir()
    shutil.copy(dataset / "annotations.json", veldt.folder / "mine" / "labels.json")
    done = veldt("report", "mine/labels.json")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("mine/report.html: 2 clips, 6 frames, 12 labels, ")
    figures = Page(veldt.folder / "mine" / "report.html").figures
    assert "record" not in figures and "flights" not in figures
    assert figures["samples"]["frames"] == [] and len(figures["samples"]["missing"]) == 4  # no pictures there


def test_pictures_of_temperatures_fill_the_grey_scale(veldt, dataset):
    done = veldt("export", dataset.name, "--format", "tiff", "--out", "tiffs")
    assert done.code == 0
    labels = json.loads((dataset / "annotations.json").read_text(encoding="utf-8"))
    for image in labels["images"]:
        clip, frame = Path(image["file_name"]).parts[1], Path(image["file_name"]).stem
        image["file_name"] = f"{clip}/images/{clip}_{frame}.tif"
    (veldt.folder / "tiffs" / "labels.json").write_text(json.dumps(labels), encoding="utf-8")
    figures = _report(veldt, "tiffs/labels.json", "--out", "kelvin.html").figures
    assert len(figures["samples"]["frames"]) == 4 and figures["samples"]["missing"] == []
    for sample in figures["samples"]["frames"]:
        assert np.ptp(_shown(veldt, sample)) > 200


def test_a_birdsai_folder_has_a_page(veldt, dataset):
    folder = veldt.folder / "birds"
    (folder / "annotations").mkdir(parents=True)
    (folder / "images" / "one").mkdir(parents=True)
    shutil.copy(
        dataset / "clips" / "down" / "ir8" / "000000.png", folder / "images" / "one" / "one_0000000000.png"
    )
    (folder / "annotations" / "one.csv").write_text(
        "0,7,8,5,2,4,1,0,0,0\n0,9,0,10,5,4,0,1,1,0\n", encoding="utf-8"
    )
    figures = _report(veldt, "birds").figures
    assert figures["labels"]["categories"] == ["elephant", "human"]
    assert [len(f["boxes"]) for f in figures["samples"]["frames"]] == [2]


# --- faults -----------------------------------------------------------------------------------------------------------


def test_there_must_be_a_dataset(veldt):
    done = veldt("report", "none")
    assert (done.code, done.out, done.err) == (1, "", "veldt: none does not exist\n")
    assert not files_below(veldt.folder)


def test_a_damaged_frame_is_a_fault(veldt, dataset):
    picture = dataset / "clips" / "down" / "ir8" / "000000.png"
    picture.write_bytes(b"not a picture")
    done = veldt("report", "out")
    assert (done.code, done.out) == (1, "")
    begins = "it begins as no PNG, JPEG or TIFF does"
    assert done.err == f"veldt: out/clips/down/ir8/000000.png: {begins}\n"
    picture.unlink()
    done = veldt("report", "out")
    assert done.err == "veldt: cannot read out/clips/down/ir8/000000.png: no such file\n"
    assert done.code == 1 and not (dataset / "report.html").exists()


def test_damaged_poses_are_a_fault(veldt, dataset):
    frames = dataset / "clips" / "side" / "frames.jsonl"
    lines = frames.read_text(encoding="utf-8").splitlines()
    frames.write_text("\n".join([lines[0], lines[1][:40], lines[2]]), encoding="utf-8")
    done = veldt("report", "out")
    assert (done.code, done.out) == (1, "")
    assert done.err.startswith("veldt: out/clips/side/frames.jsonl:2: not a frame of a clip: ")


@pytest.mark.usefixtures("dataset")
def test_a_page_that_cannot_be_written_leaves_nothing(veldt):
    before = files_below(veldt.folder)
    done = veldt("report", "out", "--out", "nowhere/page.html")
    assert done.code == 1 and "nowhere/page.html" in done.err
    assert files_below(veldt.folder) == before
