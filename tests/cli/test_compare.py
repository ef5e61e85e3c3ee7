"""`compare` reports how far frames are from real ones."""

import numpy as np
import OpenImageIO
import pytest

from pictures import write_grey
from program import check_fault
from reports import Page, make_dataset

HEIGHT, WIDTH = 96, 128
BOX = [40, 30, 12, 18]


def _frame(seed: int, noise: float = 4.0, warm: int = 60) -> np.ndarray:
    """Ground with noise, a warm square, and a target in BOX."""
    frame = np.random.default_rng(seed).normal(90, noise, (HEIGHT, WIDTH))
    frame[60:90, 80:120] += 50
    x, y, width, height = BOX
    frame[y + 2 : y + height - 3, x + 1 : x + width - 1] += warm
    return np.clip(np.round(frame), 0, 255)


def _labels(names, category: str = "Person") -> dict:
    return {
        "categories": [{"id": 0, "name": category}],
        "images": [
            {"id": k, "file_name": name, "width": WIDTH, "height": HEIGHT} for k, name in enumerate(names)
        ],
        "annotations": [
            {"id": k, "image_id": k, "category_id": 0, "bbox": BOX, "iscrowd": 0} for k in range(len(names))
        ],
    }


def _write(
    veldt,
    folder: str,
    count: int = 8,
    first: int = 0,
    ending: str = "png",
    labels=True,
    dtype=np.uint8,
    category="Person",
    channels=1,
    **look,
):
    """Frames with labels beside them; returns their names."""
    (veldt.folder / folder).mkdir()
    names = [f"f_{60 + 10 * k}_{k}.{ending}" for k in range(count)]
    for k, name in enumerate(names):
        write_grey(
            veldt.folder / folder / name,
            (_frame(first + k, **look) * (np.iinfo(dtype).max / 255)).astype(dtype),
            channels,
        )
    if labels:
        veldt.write(f"{folder}/annotations.json", _labels(names, category))
    return names


@pytest.fixture(name="pair")
def _pair(veldt):
    """Frames of two seeds, alike otherwise."""
    _write(veldt, "real")
    _write(veldt, "made", first=100)
    return veldt


def _compare(veldt, *arguments, code=0):
    done = veldt("compare", *arguments, "--progress", "none")
    assert (done.code, done.err) == (code, ""), done
    return done


def _check_fault(veldt, arguments, code, message):
    check_fault(veldt("compare", *arguments, "--progress", "none"), code, message)


def _row(document: dict, name: str) -> dict:
    (row,) = (row for row in document["measures"] if row["name"] == name)
    return row


# --- what is found ----------------------------------------------------------------------------------------------------


def test_frames_that_are_alike(pair):
    found = _compare(pair, "real", "made", "--json").json()
    assert found["real"]["frames"] == found["dataset"]["frames"] == 8
    assert found["real"]["targets"] == found["dataset"]["targets"] == 8
    for name in ("mean", "contrast", "in flat blocks"):
        row = _row(found, name)
        assert row["ratio"] == pytest.approx(abs(row["difference"]) / row["real_difference"])
        assert row["good"] == (row["ratio"] <= 2)
    assert _row(found, "mean")["real"] == pytest.approx(_frame(0).mean(), abs=0.3)
    assert found["frames_told_apart"]["auc"] == pytest.approx(0.5, abs=0.45)


def test_noise_that_differs_is_told(veldt):
    _write(veldt, "real")
    _write(veldt, "made", first=100, noise=10)
    found = _compare(veldt, "real", "made", "--json").json()
    row = _row(found, "in flat blocks")
    assert row["dataset"] == pytest.approx(2.5 * row["real"], rel=0.1)
    assert not row["good"]
    classified = found["frames_told_apart"]
    assert classified["auc"] == 1
    alone = {one["feature"]: one["alone"] for one in classified["importances"]}
    assert alone["noise in flat blocks"] == 1
    assert classified["real_halves"]["auc"] == pytest.approx(0.5, abs=0.45)


def test_boxes_are_compared_with_what_is_warm_in_them(pair):
    found = _compare(pair, "real", "made", "--json", "--real-names", "f_{altitude_m}_{_}").json()
    (row,) = found["real"]["margins_by_blob_size"]
    assert row["targets"] == 8
    means = [row[side]["mean"] for side in ("left_px", "right_px", "top_px", "bottom_px")]
    assert means == [1, 1, 2, 3]
    assert _row(found, "blob width / box width")["real"] == pytest.approx(10 / 12)
    assert [row["from_m"] for row in found["real"]["targets_by_altitude"]] == [50, 70, 90, 110, 130]
    assert found["dataset"]["targets_by_altitude"] == []


def test_the_table(pair):
    lines = _compare(pair, "real", "made").out.splitlines()
    assert lines[:4] == [
        "real     real: 8 of 8 frames, 8 boxes, 8 targets",
        "         noise: temporal components by the 3-D noise model from 1 run of 8 frames of a still scene",
        "dataset  made: 8 of 8 frames, 8 boxes, 8 targets",
        "         noise: temporal components by the 3-D noise model from 1 run of 8 frames of a still scene",
    ]
    assert any(line.startswith("classifier of targets: AUC ") for line in lines)


def test_the_result_does_not_depend_on_threads(pair):
    arguments = ("real", "made", "--json", "--html")
    one = _compare(pair, *arguments, "one.html", "--threads", "1")
    assert one.out == _compare(pair, *arguments, "three.html", "--threads", "3").out
    assert (pair.folder / "one.html").read_bytes() == (pair.folder / "three.html").read_bytes()


def test_the_page_holds_all_it_shows(pair):
    found = _compare(pair, "real", "made", "--html", "page.html", "--json").json()
    page = Page(pair.folder / "page.html")
    assert [text for _, text in page.all("title")] == ["made \u00b7 Veldt comparison"]
    assert not page.all("link") and all("src" not in attributes for attributes, _ in page.all("script"))
    figures = page.figures
    assert figures["measures"] == found["measures"]
    for key in ("real", "dataset"):
        assert len(figures[key]["shown_frames"]) == 6
        assert len(figures[key]["shown_crops"]) == 8
        assert figures[key]["shown_crops"][0]["box"] == [6, 6, *BOX[2:]]
        assert "each_frame" not in figures[key]


def test_16_bits_are_256_levels_as_well(veldt):
    _write(veldt, "real")
    _write(veldt, "deep", ending="tif", dtype=np.uint16)
    for row in _compare(veldt, "real", "deep", "--json").json()["measures"]:
        assert row["difference"] == pytest.approx(0, abs=1e-4) or row["real"] is None, row


def test_grey_that_is_stored_as_colours(veldt):
    _write(veldt, "grey", ending="jpg")
    _write(veldt, "colours", ending="JPEG", channels=3)
    found = _compare(veldt, "grey", "colours", "--json").json()
    assert abs(_row(found, "mean")["difference"]) < 0.1


def test_sizes_may_differ(veldt):
    _write(veldt, "real")
    _write(veldt, "made", first=100)
    write_grey(veldt.folder / "made" / "small.png", _frame(3)[:64, :80].astype(np.uint8))
    assert _compare(veldt, "real", "made", "--json").json()["dataset"]["sizes"] == [
        {"width_px": 80, "height_px": 64, "frames": 1},
        {"width_px": WIDTH, "height_px": HEIGHT, "frames": 8},
    ]


def test_a_dataset_of_veldt_brings_its_labels(veldt):
    _write(veldt, "real", count=4, category="human")
    dataset = make_dataset(veldt)
    found = _compare(veldt, "real", dataset.name, "--json").json()
    assert found["dataset"]["veldt_dataset"]
    assert found["dataset"]["frames"] == 6
    assert found["dataset"]["boxes"] > 0
    _check_fault(
        veldt,
        ["real", "out", "--labels", "real/annotations.json"],
        2,
        "out is a Veldt dataset, which has labels and heights; expected a folder of pictures with labels or a pattern "
        "of names of your own",
    )


def test_boxes_of_a_dataset_as_people_draw_them(veldt):
    _write(veldt, "real")
    dataset = make_dataset(veldt)
    visible, drawn = (
        _row(_compare(veldt, "real", dataset.name, "--json", "--box-style", style).json(), "box width")
        for style in ("visible", "drawn")
    )
    assert visible["dataset"] is None  # targets of 2 x 2 px are below the 3 x 3 px that are measured
    assert drawn["dataset"] == pytest.approx(2 + 2 * (0.7 + 0.1 * 2))
    _check_fault(
        veldt,
        ["real", "real", "--box-style", "drawn"],
        2,
        "real is a folder, whose labels have the boxes as they are; expected a Veldt dataset to draw boxes for",
    )


def test_fewer_frames_evenly_spaced(pair):
    found = _compare(pair, "real", "made", "--frames", "4", "--json").json()
    assert [frame["file"] for frame in found["real"]["each_frame"]] == [
        f"f_{60 + 10 * k}_{k}.png" for k in (4, 6, 0, 2)  # by name
    ]
    assert found["real"]["frames_listed"] == 8
    _check_fault(pair, ["real", "made", "--frames", "3"], 2, "--frames = 3; expected at least 4")


# --- labels -----------------------------------------------------------------------------------------------------------


def test_labels_are_beside_the_frames_or_above_them(veldt):
    names = _write(veldt, "real", labels=False)
    _write(veldt, "made", first=100)
    assert _compare(veldt, "real", "made", "--json").json()["real"]["targets"] == 0
    veldt.write("annotations.json", _labels([f"images/{name}" for name in names]))
    assert _compare(veldt, "real", "made", "--json").json()["real"]["targets"] == 8


def test_without_labels_targets_are_left_out(veldt):
    _write(veldt, "real", labels=False)
    _write(veldt, "made", first=100)
    lines = _compare(veldt, "real", "made").out.splitlines()
    assert lines[2] == "         no labels for real; measures of targets are left out"
    assert "classifier of targets: left out; it needs targets in two parts or more of each set" in lines


def test_the_category(veldt):
    _write(veldt, "real", category="Elephant")
    _write(veldt, "made", first=100)
    found = _compare(veldt, "real", "made", "--json").json()
    assert found["real"]["no_boxes"] == "no boxes of people in real; its categories: Elephant"
    found = _compare(veldt, "real", "made", "--category", "elephant", "--json").json()
    assert found["real"]["targets"] == 8
    assert found["dataset"]["no_boxes"] == "no boxes of elephant in made; its categories: Person"


def test_labels_of_other_frames(pair):
    pair.write("others.json", _labels(["a.png", "b.png"]))
    _check_fault(
        pair,
        ["real", "made", "--real-labels", "others.json"],
        1,
        "others.json: names none of the 8 pictures in real; expected their names in images[].file_name",
    )


# --- what is refused --------------------------------------------------------------------------------------------------


def test_pictures_that_cannot_be_read_are_rejected_and_named(pair):
    (pair.folder / "real" / "broken.png").write_bytes(b"")
    (pair.folder / "real" / "broken.jpg").write_bytes(b"no picture")
    colours = np.zeros((32, 32, 3), np.uint8)
    colours[..., 0] = 90
    _write_colours(pair.folder / "real" / "colours.png", colours)
    _write_colours(pair.folder / "real" / "colours.tif", colours)
    write_grey(pair.folder / "real" / "tiny.png", np.zeros((8, 20), np.uint8))
    done = pair("compare", "real", "made", "--json", "--quiet")
    assert done.code == 3
    lines = done.err.splitlines()
    assert len(lines) == 5
    assert lines[0] == "rejected: real/broken.jpg: it begins as no PNG, JPEG or TIFF does"
    assert lines[1].startswith("rejected: real/broken.png: ")
    assert lines[2:] == [
        "rejected: real/colours.png: pixels = colours; expected grey levels",
        "rejected: real/colours.tif: pixels = colours; expected grey levels",
        "rejected: real/tiny.png: size = 20 x 8 px; expected at least 16 x 16 px",
    ]
    assert done.json()["real"]["frames"] == 8
    assert [f"rejected: {line}" for line in done.json()["real"]["rejected"]] == lines


def _write_colours(file, pixels: np.ndarray) -> None:
    spec = OpenImageIO.ImageSpec(pixels.shape[1], pixels.shape[0], 3, "uint8")
    out = OpenImageIO.ImageOutput.create(str(file))
    assert out.open(str(file), spec) and out.write_image(pixels)
    out.close()


def test_too_few_frames(veldt):
    _write(veldt, "real", count=3)
    _write(veldt, "made")
    _check_fault(veldt, ["real", "made"], 1, "real = 3 frames that can be read; expected at least 4")


def test_no_frames(veldt):
    _write(veldt, "made")
    (veldt.folder / "real").mkdir()
    _check_fault(
        veldt,
        ["real", "made"],
        1,
        "real = 0 pictures; expected a Veldt dataset, or a folder of .png, .jpg, .jpeg, .tif or .tiff",
    )
    _check_fault(veldt, ["made", "nowhere"], 1, "nowhere does not exist")


def test_a_page_in_no_folder(pair):
    _check_fault(
        pair,
        ["real", "made", "--html", "nowhere/page.html"],
        2,
        "--html = nowhere/page.html; expected a file in an existing folder",
    )


def test_names_of_frames(pair):
    _check_fault(
        pair,
        ["real", "made", "--real-names", "{height}"],
        2,
        "--real-names = {height}; expected text and the fields {altitude_m}, {look_angle_deg} and {_}, one of the "
        "first two among them, with text between fields",
    )
    _check_fault(
        pair,
        ["real", "made", "--names", "g_{altitude_m}"],
        1,
        "made/f_100_4.png: name = f_100_4; expected --names g_{altitude_m}",
    )
