"""Faults in requests, labels and files for `export`: exact messages, and no output is written."""

import json
import shutil

import pytest

import passes
from program import Veldt, files_below


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A place with a dataset of two clips, in `data`."""
    veldt = Veldt(tmp_path_factory.mktemp("faults"))
    clips = [passes.write_clip(veldt.folder / clip, clip) for clip in ("one", "two")]
    done = veldt("convert", *clips, "--out", "data", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt


def _export(place, *options, source="data", out="x"):
    return place("export", source, "--out", out, "--progress", "none", *options)


def _check(place, done, code: int, message: str, out="x") -> None:
    assert (done.code, done.out, done.err) == (code, "", f"veldt: {message}\n")
    assert not (place.folder / out).exists() and not (place.folder / f"{out}.part").exists()


# --- requests ---------------------------------------------------------------------------------------------------------

SPLITS = (
    "NAME:SHARE,NAME:SHARE…, names that differ and shares above 0 that add up to 1, e.g. train:0.8,val:0.2"
)
USAGE = {
    "no format": ([], "--format is required; see veldt export --help"),
    "a format that there is not": (
        ["--format", "voc"],
        "--format: voc not in {coco,yolo,mot,birdsai,webdataset,tiff}; see veldt export --help",
    ),
    "a way to link that there is not": (
        ["--format", "yolo", "--link", "soft"],
        "--link: soft not in {hard,symlink,copy}; see veldt export --help",
    ),
    "pictures that there are not": (
        ["--format", "yolo", "--images", "ir32"],
        "--images: ir32 not in {ir8,ir16}; see veldt export --help",
    ),
    "a seed of nothing": (
        ["--format", "yolo", "--seed", "3"],
        "--seed requires --split; see veldt export --help",
    ),
    "a seed that is none": (
        ["--format", "yolo", "--split", "a:1", "--seed", "-3"],
        "Could not convert: --seed = -3; see veldt export --help",
    ),
    "shares of more than all": (
        ["--format", "yolo", "--split", "train:0.8,val:0.3"],
        f"--split = train:0.8,val:0.3; expected {SPLITS}",
    ),
    "a split outside": (
        ["--format", "yolo", "--split", "../train:0.8,val:0.2"],
        f"--split = ../train:0.8,val:0.2; expected {SPLITS}",
    ),
    "more splits than clips": (
        ["--format", "coco", "--split", "a:0.5,b:0.3,c:0.2"],
        "--split = 3 splits; expected no more than there are clips with pictures, 2: frames of one clip never go to "
        "several splits",
    ),
    "no sample in a shard": (
        ["--format", "webdataset", "--samples-per-shard", "0"],
        "--samples-per-shard = 0; expected 1 to 1000000",
    ),
    "too many samples in a shard": (
        ["--format", "webdataset", "--samples-per-shard", "1000001"],
        "--samples-per-shard = 1000001; expected 1 to 1000000",
    ),
    "samples that are no number": (
        ["--format", "webdataset", "--samples-per-shard", "many"],
        "Could not convert: --samples-per-shard = many; see veldt export --help",
    ),
    "samples of another format": (
        ["--format", "yolo", "--samples-per-shard", "10"],
        "--samples-per-shard = 10; expected none with --format yolo: only webdataset has tar files",
    ),
    "a scratch folder of another format": (
        ["--format", "coco", "--scratch", "s"],
        "--scratch = s; expected none with --format coco: only webdataset has tar files",
    ),
    "links into a tar file": (
        ["--format", "webdataset", "--link", "hard"],
        "--link = hard; expected none with --format webdataset: pictures are copied into tar files",
    ),
    "a selection for trackers": (
        ["--format", "mot", "--selection", "s.json"],
        "--selection = s.json; expected none with --format mot: trackers are trained and judged on whole clips",
    ),
}


@pytest.mark.parametrize("name", USAGE)
def test_request_that_cannot_be_meant(place, name):
    options, message = USAGE[name]
    _check(place, _export(place, *options), 2, message)


def test_no_folder_for_it(place):
    done = place("export", "data", "--format", "yolo")
    assert (done.code, done.err) == (2, "veldt: --out is required; see veldt export --help\n")


# --- where it is to go ------------------------------------------------------------------------------------------------


def _bytes_of(folder) -> dict:
    return {name: (folder / name).read_bytes() for name in files_below(folder)}


def test_a_folder_that_holds_something(place, veldt):
    shutil.copytree(place.folder / "data", veldt.folder / "data")
    (veldt.folder / "file").write_text("mine")
    before = _bytes_of(veldt.folder)
    for out in ("data", "data/clips", "file", "."):
        done = _export(veldt, "--format", "coco", out=out)
        named = veldt.folder if out == "." else out
        message = f"veldt: --out = {named}; expected an empty or new folder\n"
        assert (done.code, done.out, done.err) == (2, "", message)
    assert _bytes_of(veldt.folder) == before


def test_a_folder_that_holds_another_export(place, tmp_path):
    out = tmp_path / "x"
    assert _export(place, "--format", "yolo", out=out).code == 0
    before = _bytes_of(out)
    rule = "expected the same request, or an empty or new folder"
    for options, what in {
        ("--format", "mot"): 'format is "mot" here and "yolo" there',
        ("--format", "yolo", "--link", "copy"): 'link is "copy" here and "hard" there',
        ("--format", "yolo", "--split", "a:1"): "split is only here, seed is only here",
    }.items():
        done = _export(place, *options, out=out)
        assert (done.code, done.out, done.err) == (
            2,
            "",
            f"veldt: {out} holds another export: {what}; {rule}\n",
        )
    assert _bytes_of(out) == before


def test_an_existing_folder_at_the_temporary_place(place, veldt):
    (veldt.folder / "x.part").mkdir()
    (veldt.folder / "x.part" / "thesis.txt").write_text("mine")
    done = _export(veldt, "--format", "yolo", source=place.folder / "data")
    message = "x.part is in the way; expected to make the result there before it becomes x"
    assert (done.code, done.out, done.err) == (2, "", f"veldt: {message}\n")
    assert files_below(veldt.folder) == ["x.part/thesis.txt"]


# --- the labels to export ---------------------------------------------------------------------------------------------


def test_an_unfinished_dataset(place, veldt):
    shutil.copytree(place.folder / "data", veldt.folder / "data")
    index = veldt.read("data/dataset.json")
    index["clips"][1] = {"id": "two", "status": "pending"}
    index["status"] = "unfinished"
    veldt.write("data/dataset.json", index)
    document = veldt.read("data/annotations.json")
    document["images"] = document["images"][: passes.FRAMES]
    document["videos"] = document["videos"][:1]
    ids = {image["id"] for image in document["images"]}
    document["annotations"] = [a for a in document["annotations"] if a["image_id"] in ids]
    veldt.write("data/annotations.json", document)
    message = "data is unfinished: 1 of 2 clips are missing: two; expected all of them, or --unfinished to accept this"
    _check(veldt, _export(veldt, "--format", "yolo"), 1, message)
    done = _export(veldt, "--format", "yolo", "--unfinished")
    assert (done.code, done.err) == (0, "")
    assert done.out.splitlines()[0] == "x: 3 pictures and 6 labels as yolo"


def test_a_missing_picture(place, veldt):
    shutil.copytree(place.folder / "data", veldt.folder / "data")
    for k in range(3):
        (veldt.folder / "data" / "clips" / "two" / "ir8" / f"{k:06d}.png").unlink()
    (veldt.folder / "data" / "clips" / "one" / "ir8" / "000002.png").unlink()
    message = (
        "data: no picture clips/one/ir8/000002.png, clips/two/ir8/000000.png, clips/two/ir8/000001.png, … "
        "(4 in all); expected all 6 that the labels refer to"
    )
    for kind in ("coco", "yolo", "mot", "birdsai", "webdataset"):
        _check(veldt, _export(veldt, "--format", kind), 1, message)


def test_pictures_of_sixteen_bits_that_only_datasets_have(place):
    done = _export(place, "--format", "yolo", "--images", "ir16", source="data/annotations.json")
    _check(place, done, 2, "--images = ir16; expected ir8; only Veldt datasets have 16-bit pictures")


# --- selections -------------------------------------------------------------------------------------------------------

ONE = {"name": "one", "frames": [0]}
SELECTIONS = {
    "a clip that there is not": (
        {"videos": [ONE, {"name": "tow", "frames": [0]}]},
        'video "tow" is not in made_up; expected one of one, two; did you mean "two"?',
    ),
    "a frame that there is not": (
        {"videos": [{"name": "one", "frames": [2, 3]}]},
        'video "one" of made_up has no frame 3; expected a frame_index of its pictures',
    ),
    "no frame": (
        {"videos": [{"name": "one", "frames": []}]},
        "no frame of made_up; expected at least one",
    ),
    "another dataset": (
        {"path": "date", "name": "other", "videos": [ONE]},
        'no entry for data; expected one of date; did you mean "date"?',
    ),
}


@pytest.mark.parametrize("name", SELECTIONS)
def test_selection_that_does_not_fit(place, name):
    changes, message = SELECTIONS[name]
    dataset = {"path": "data", "name": "made_up"} | changes
    place.write("s.json", {"format": "veldt-selection", "version": 1, "datasets": [dataset]})
    _check(place, _export(place, "--format", "yolo", "--selection", "s.json"), 1, f"s.json: {message}")


def test_selection_that_is_no_file(place):
    done = _export(place, "--format", "yolo", "--selection", "none.json")
    _check(place, done, 1, "cannot read none.json: No such file or directory")


# --- other people's COCO files ----------------------------------------------------------------------------------------


def _coco(veldt, images: list[dict], annotations: list[dict]) -> None:
    """Write labels.json beside a picture `a.png`; keys missing from its entries are filled in."""
    (veldt.folder / "a.png").write_bytes(b"a picture")
    filled = [{"id": k + 1, "width": 9, "height": 9, "file_name": "a.png"} | i for k, i in enumerate(images)]
    labels = [
        {"id": k + 1, "image_id": 1, "category_id": 1, "bbox": [1, 1, 2, 2], "track_id": k} | a
        for k, a in enumerate(annotations)
    ]
    categories = [{"id": 1, "name": "lion"}]
    veldt.write("labels.json", {"images": filled, "annotations": labels, "categories": categories})


@pytest.mark.parametrize("kind", ["coco", "yolo", "mot", "birdsai", "webdataset"])
def test_names_that_lead_out_of_the_folder(veldt, kind):
    (veldt.folder / "in").mkdir()
    (veldt.folder / "secret.png").write_bytes(b"mine")
    inside = Veldt(veldt.folder / "in")
    for name in ("../secret.png", "b/../../secret.png", str(veldt.folder / "secret.png"), "b/.."):
        _coco(inside, [{"file_name": name}], [])
        done = _export(inside, "--format", kind, source="labels.json")
        rule = (
            'expected a relative path without "..", control characters, or parts that begin with "-" or exceed'
            " 200 bytes"
        )
        _check(inside, done, 1, f'labels: file_name of image 1 = "{name}"; {rule}')
    assert files_below(veldt.folder) == ["in/a.png", "in/labels.json", "secret.png"]


LABELS = {
    "a label without a track": (
        "mot",
        [{}],
        [{}, {"track_id": None}],
        "annotation 2 of a.png has no track_id; expected one, as --format mot requires",
    ),
    "a track twice in a picture": (
        "birdsai",
        [{}],
        [{"track_id": 4}, {}, {"track_id": 4}],
        "annotations 1 and 3 of a.png both have track_id 4; expected one annotation per track",
    ),
    "a picture twice": (
        "coco",
        [{}, {}],
        [],
        '"a.png" and "a.png" would both become a.png; expected names that differ',
    ),
    "a picture in the place of the labels": (
        "coco",
        [{"file_name": "annotations.json"}],
        [],
        '"annotations.json" and "annotations.json" would both become annotations.json; expected names that differ',
    ),
    "samples of one key": (
        "webdataset",
        [{"file_name": "d/e.f.png"}, {"file_name": "d/e_f.jpg"}],
        [],
        '"d/e.f.png" and "d/e_f.jpg" would both become d_e_f.jpg; expected names that differ',
    ),
    "a picture without an extension": (
        "webdataset",
        [{"file_name": "picture"}],
        [],
        'file_name of image 1 = "picture"; expected the extension of a picture, such as .png, as --format webdataset '
        "requires",
    ),
    "a picture with the extension of the labels": (
        "webdataset",
        [{"file_name": "annotations.json"}],
        [],
        'file_name of image 1 = "annotations.json"; expected the extension of a picture, such as .png, as --format '
        "webdataset requires",
    ),
    "sizes that differ in a clip": (
        "mot",
        [{}, {"file_name": "b.png", "width": 8}],
        [],
        "a.png is 9 x 9 px and b.png is 8 x 9 px; expected all pictures of a clip to have one kind and size, "
        "as --format mot requires",
    ),
    "no picture at all": ("yolo", [], [], "labels.json has no pictures; expected at least one"),
    "a picture of unknown size": (
        "yolo",
        [{"width": None}],
        [{}],
        None,  # the library's words follow
    ),
}


@pytest.mark.parametrize("name", LABELS)
def test_labels_that_a_format_cannot_hold(veldt, name):
    kind, images, annotations, message = LABELS[name]
    (veldt.folder / "d").mkdir()
    for other in ("annotations.json", "b.png", "picture", "d/e.f.png", "d/e_f.jpg"):
        (veldt.folder / other).write_bytes(b"a picture")
    _coco(veldt, images, annotations)
    done = _export(veldt, "--format", kind, source="labels.json")
    if message is None:
        assert (done.code, done.err) == (1, "veldt: a.png: it begins as no PNG, JPEG or TIFF does\n")
        assert not list(veldt.folder.glob("x*"))
    else:
        _check(veldt, done, 1, message)


def test_a_picture_that_there_is_not(veldt):
    _coco(veldt, [{"file_name": "b.png"}], [])
    done = _export(veldt, "--format", "coco", source="labels.json")
    _check(veldt, done, 1, ".: no picture b.png; expected all 1 that the labels refer to")


def test_roundabout_names_are_names(veldt):
    (veldt.folder / "b").mkdir()
    (veldt.folder / "b" / "c.png").write_bytes(b"a picture")
    _coco(veldt, [{"file_name": "./a.png"}, {"file_name": ".//b/./c.png", "width": None}], [])
    done = _export(veldt, "--format", "coco", source="labels.json")
    assert (done.code, done.err) == (0, "")
    assert files_below(veldt.folder / "x") == ["a.png", "annotations.json", "b/c.png", "export.json"]


def test_pictures_in_folders_need_no_video(veldt):
    for folder in ("day", "night"):
        (veldt.folder / folder).mkdir()
        (veldt.folder / folder / "1.jpg").write_bytes(b"a picture")
    _coco(veldt, [{"file_name": "day/1.jpg"}, {"file_name": "night/1.jpg"}], [{"iscrowd": 1}, {"ignore": 1}])
    done = _export(veldt, "--format", "yolo", source="labels.json")
    assert (done.code, done.err) == (0, "")
    assert done.out.splitlines()[-2:] == [
        "left out: 1 label marked as ignored, which YOLO cannot mark",
        "left out: 1 label of crowds, which YOLO cannot mark",
    ]
    assert sorted(file.name for file in (veldt.folder / "x/images/train").iterdir()) == [
        "day_1.jpg",
        "night_1.jpg",
    ]
    assert json.loads((veldt.folder / "x/export.json").read_text())["splits"]["train"]["pictures"] == 2
