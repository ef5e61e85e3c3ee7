"""`export` of COCO files of other programs: their order of time, ids, polygons, and names with backslashes."""

import json

import pytest

from program import Veldt, check_fault, files_below

WIDTH, HEIGHT = 64, 48
SQUARE = [10, 8, 30, 8, 30, 38, 10, 38]


def _write(veldt: Veldt, files: list[str], images: list[dict], annotations: list[dict]) -> None:
    """Write labels.json, beside pictures that nothing opens."""
    for file in files:
        (veldt.folder / file).parent.mkdir(parents=True, exist_ok=True)
        (veldt.folder / file).write_bytes(b"a picture")
    size = {"width": WIDTH, "height": HEIGHT}
    label = {"category_id": 1, "bbox": [10, 8, 20, 30], "area": 600, "iscrowd": 0, "track_id": 7}
    document = {
        "images": [size | image for image in images],
        "annotations": [label | {"id": k + 1} | annotation for k, annotation in enumerate(annotations)],
        "categories": [{"id": 1, "name": "human"}],
        "videos": [{"id": 1, "name": "vid"}],
    }
    veldt.write("labels.json", document)


def _export(veldt: Veldt, *options):
    return veldt("export", "labels.json", "--out", "x", "--progress", "none", *options)


def _done(veldt: Veldt, *options):
    done = _export(veldt, *options)
    assert (done.code, done.err) == (0, "")


@pytest.mark.parametrize("key", ["frame_id", None])
def test_frames_are_in_the_order_of_time(veldt, key):
    numbers = (2, 0, 3, 1)
    files = [f"vid/{number + 1:04d}.png" for number in numbers]
    images = [
        {"id": 100 + number, "file_name": file, "video_id": 1} | ({key: number} if key else {})
        for number, file in zip(numbers, files)
    ]
    boxes = [{"image_id": 100 + number, "bbox": [10 * (number + 1), 5, 6, 8]} for number in numbers]
    _write(veldt, files, images, boxes)
    _done(veldt, "--format", "mot")
    rows = (veldt.folder / "x/train/vid/gt/gt.txt").read_text().splitlines()
    assert [row.split(",")[:3] for row in rows] == [[str(k + 1), "7", str(10 * k + 11)] for k in range(4)]


def test_names_without_numbers_have_no_order(veldt):
    images = [{"id": 1, "file_name": "left.png"}, {"id": 2, "file_name": "right.png"}]
    _write(veldt, ["left.png", "right.png"], images, [])
    rule = (
        "labels: nothing says in which order its pictures were taken; expected frame_index or frame_id of images, or "
        "names that differ in a number, as --format mot requires"
    )
    check_fault(_export(veldt, "--format", "mot"), 1, rule)
    _done(veldt, "--format", "yolo")


def test_polygons_become_outlines_of_yolo(veldt):
    _write(
        veldt, ["a/1.png"], [{"id": 1, "file_name": "a/1.png"}], [{"image_id": 1, "segmentation": [SQUARE]}]
    )
    _done(veldt, "--format", "yolo", "--segmentation", "polygon")
    assert (veldt.folder / "x/labels/train/a_1.txt").read_text() == (
        "0 0.1562500 0.1666667 0.4687500 0.1666667 0.4687500 0.7916667 0.1562500 0.7916667\n"
    )


def test_polygons_become_run_lengths(veldt):
    _write(
        veldt, ["a/1.png"], [{"id": 1, "file_name": "a/1.png"}], [{"image_id": 1, "segmentation": [SQUARE]}]
    )
    _done(veldt, "--format", "coco", "--segmentation", "rle")
    (made,) = json.loads((veldt.folder / "x/annotations.json").read_text())["annotations"]
    # pycocotools 2.0.11: merge(frPyObjects([SQUARE], 48, 64))
    counts = "X?n0b00000000000000000000000000000000000000hb1"
    assert made["segmentation"] == {"size": [HEIGHT, WIDTH], "counts": counts}
    assert json.loads((veldt.folder / "x/export.json").read_text())["request"]["segmentation"] == "rle"


def test_masks_stay_as_they_are_unless_asked(veldt):
    _write(
        veldt, ["a/1.png"], [{"id": 1, "file_name": "a/1.png"}], [{"image_id": 1, "segmentation": [SQUARE]}]
    )
    _done(veldt, "--format", "coco")
    assert (veldt.folder / "x/annotations.json").read_bytes() == (veldt.folder / "labels.json").read_bytes()


def test_names_of_windows_are_names_in_folders(veldt):
    images = [{"id": 1, "file_name": "a\\1.png"}, {"id": 2, "file_name": "b\\c\\1.png"}]
    _write(veldt, ["a/1.png", "b/c/1.png"], images, [{"image_id": 1}, {"image_id": 2}])
    _done(veldt, "--format", "coco")
    made = json.loads((veldt.folder / "x/annotations.json").read_text())
    assert [image["file_name"] for image in made["images"]] == ["a/1.png", "b/c/1.png"]
    assert files_below(veldt.folder / "x") == ["a/1.png", "annotations.json", "b/c/1.png", "export.json"]


def test_folders_of_windows_go_to_splits_as_a_whole(veldt):
    names = [f"{folder}\\{number}.png" for number in (1, 2, 3) for folder in "ab"]
    images = [{"id": k + 1, "file_name": name} for k, name in enumerate(names)]
    _write(
        veldt, [name.replace("\\", "/") for name in names], images, [{"image_id": k + 1} for k in range(6)]
    )
    _done(veldt, "--format", "yolo", "--split", "train:0.5,val:0.5")
    for split in ("train", "val"):
        made = sorted(file.name for file in (veldt.folder / "x/images" / split).iterdir())
        assert made in ([f"{folder}_{number}.png" for number in (1, 2, 3)] for folder in "ab")


OUTSIDE = 'expected a relative path without "..", control characters, or parts that begin with "-" or exceed 200 bytes'


@pytest.mark.parametrize(
    "name, read",
    [
        ("..\\secret.png", "../secret.png"),
        ("a\\..\\..\\secret.png", "a/../../secret.png"),
        ("C:\\secret.png", "C:/secret.png"),
        ("\\\\host\\secret.png", "//host/secret.png"),
    ],
)
def test_names_of_windows_lead_nowhere_else(veldt, name, read):
    (veldt.folder / "in").mkdir()
    (veldt.folder / "secret.png").write_bytes(b"mine")
    inside = Veldt(veldt.folder / "in")
    _write(inside, ["C:/secret.png"], [{"id": 1, "file_name": name}], [])
    done = _export(inside, "--format", "yolo")
    check_fault(done, 1, f'labels: file_name of image 1 = "{read}"; {OUTSIDE}')
    assert not (veldt.folder / "in/x").exists()


def test_pictures_of_one_name_are_both_named(veldt):
    images = [{"id": 1, "file_name": "a/b/1.png"}, {"id": 2, "file_name": "a_b/1.png"}]
    _write(veldt, ["a/b/1.png", "a_b/1.png"], images, [{"image_id": 1}])
    rule = '"a/b/1.png" and "a_b/1.png" would both become labels/train/a_b_1.txt; expected names that differ'
    check_fault(_export(veldt, "--format", "yolo"), 1, rule)
