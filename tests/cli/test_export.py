"""`export` writes formats of other programs: correct files and numbers, linked pictures, complete or not at all."""

import json
import os
import shutil
import signal
from pathlib import Path

import numpy as np
import pytest

import passes
from exports import CLIPS, export, export_whole, with_three_clips
from pictures import read_grey
from processes import PATIENCE_S, interrupt
from program import Veldt, files_below

FRAMES = passes.FRAMES
TABLE = "  split          clips  pictures  labels   human  elephant\n"


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    return with_three_clips(tmp_path_factory.mktemp("export"))


def _boxes(document: dict) -> list:
    """Every label of a COCO file, without ids: clip, frame, category, track, box."""
    videos = {video["id"]: video["name"] for video in document["videos"]}
    images = {i["id"]: (videos[i["video_id"]], i["frame_index"]) for i in document["images"]}
    names = {category["id"]: category["name"] for category in document["categories"]}
    return sorted(
        (*images[a["image_id"]], names[a["category_id"]], a["track_id"], a["bbox"])
        for a in document["annotations"]
    )


# --- formats ----------------------------------------------------------------------------------------------------------


def test_coco_is_the_dataset_s_own_file_with_its_pictures(place, tmp_path):
    done = export(place, tmp_path / "x", "--format", "coco")
    assert (done.code, done.err) == (0, "")
    row = "  all                3         9      16       8         8\n"
    assert done.out == f"{tmp_path}/x: 9 pictures and 16 labels as coco\n{TABLE}{row}"
    pictures = [f"clips/{clip}/ir8/{k:06d}.png" for clip in CLIPS for k in range(FRAMES)]
    assert files_below(tmp_path / "x") == sorted(["annotations.json", "export.json", *pictures])
    for name in ["annotations.json", *pictures]:
        assert (tmp_path / "x" / name).read_bytes() == (place.folder / "data" / name).read_bytes()


def test_yolo(place, tmp_path):
    done = export(place, tmp_path / "x", "--format", "yolo")
    assert (done.code, done.err) == (0, "")
    row = "  train              3         9      16       8         8\n"
    assert done.out == f"{tmp_path}/x: 9 pictures and 16 labels as yolo\n{TABLE}{row}"
    names = [f"{clip}_{k:06d}" for clip in CLIPS for k in range(FRAMES)]
    files = [f"{kind}/train/{n}.{end}" for n in names for kind, end in (("images", "png"), ("labels", "txt"))]
    assert files_below(tmp_path / "x") == sorted(["data.yaml", "export.json", *files])
    # The walker is at (8, 5), 2 x 4 px, the elephant at (0, 10), 5 x 4 px, of 24 x 16 px.
    lines = (tmp_path / "x" / "labels" / "train" / "one_000000.txt").read_text().splitlines()
    assert sorted(lines) == [
        "0 0.37500000 0.43750000 0.08333333 0.25000000",
        "1 0.10416667 0.75000000 0.20833333 0.25000000",
    ]
    assert (tmp_path / "x" / "labels" / "train" / "three_000002.txt").read_text() == ""
    assert f'path: "{tmp_path}/x"' in (tmp_path / "x" / "data.yaml").read_text()


def test_mot(place, tmp_path):
    out = export_whole(place, tmp_path / "x", "--format", "mot")
    of_a_clip = ["gt/gt.txt", "seqinfo.ini", *(f"img1/{k + 1:06d}.png" for k in range(FRAMES))]
    files = [f"train/{clip}/{name}" for clip in CLIPS for name in of_a_clip]
    assert files_below(out) == sorted(["classes.txt", "export.json", "seqmaps/made_up-train.txt", *files])
    rows = [row.split(",") for row in (out / "train/one/gt/gt.txt").read_text().splitlines()]
    assert [row[:8] for row in rows[:2]] == [
        ["1", "7", "9", "6", "2", "4", "1", "1"],
        ["1", "9", "1", "11", "5", "4", "1", "2"],
    ]
    assert [row[0] for row in rows] == ["1", "1", "2", "2", "3", "3"]
    seqinfo = (out / "train/one/seqinfo.ini").read_text()
    assert seqinfo.endswith("frameRate=9\nseqLength=3\nimWidth=24\nimHeight=16\nimExt=.png\n")
    assert (out / "train/three/img1/000003.png").samefile(place.folder / "data/clips/three/ir8/000002.png")


def test_birdsai_comes_back_as_it_was(place, tmp_path):
    out = export_whole(place, tmp_path / "x", "--format", "birdsai")
    pictures = [f"images/{clip}/{clip}_{k:010d}.png" for clip in CLIPS for k in range(FRAMES)]
    tables = [f"annotations/{clip}.csv" for clip in CLIPS]
    assert files_below(out) == sorted(["export.json", *tables, *pictures])
    rows = (out / "annotations/one.csv").read_text().splitlines()
    assert rows[:2] == ["0,7,8,5,2,4,1,0,0,0", "0,9,0,10,5,4,0,1,0,0"]
    back = export_whole(place, tmp_path / "back", "--format", "coco", source=out)
    document = json.loads((back / "annotations.json").read_text())
    assert len(document["images"]) == 9
    assert _boxes(document) == _boxes(place.read("data/annotations.json"))


def test_vehicles_are_left_out_of_birdsai_and_counted(place, tmp_path):
    document = place.read("data/annotations.json")
    for category in document["categories"]:
        if category["name"] == "elephant":
            category["name"] = "vehicle"
    file = place.folder / "data" / "vehicles.json"
    file.write_text(json.dumps(document))
    done = export(place, tmp_path / "x", "--format", "birdsai", source=file)
    assert (done.code, done.err) == (0, "")
    assert done.out.splitlines()[0] == f"{tmp_path}/x: 9 pictures and 8 labels as birdsai"
    assert done.out.splitlines()[-1] == "left out: 8 labels of vehicles, which BIRDSAI has no class for"
    assert json.loads((tmp_path / "x" / "export.json").read_text())["left_out"] == {
        "of vehicles, which BIRDSAI has no class for": 8
    }


def test_pictures_of_sixteen_bits(place, tmp_path):
    out = export_whole(place, tmp_path / "x", "--format", "yolo", "--images", "ir16")
    picture = out / "images/train/two_000001.png"
    assert picture.samefile(place.folder / "data/clips/two/ir16/000001.png")
    assert read_grey(picture).dtype == np.uint16
    out = export_whole(place, tmp_path / "y", "--format", "coco", "--images", "ir16")
    document = json.loads((out / "annotations.json").read_text())
    assert document["images"][4]["file_name"] == "clips/two/ir16/000001.png"
    assert (out / "clips/two/ir16/000001.png").exists()
    assert document["annotations"] == place.read("data/annotations.json")["annotations"]


# --- links ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("link", ["hard", "symlink", "copy"])
def test_ways_to_link(place, tmp_path, link):
    out = export_whole(place, tmp_path / "x", "--format", "yolo", "--link", link)
    made, source = out / "images/train/one_000000.png", place.folder / "data/clips/one/ir8/000000.png"
    assert made.read_bytes() == source.read_bytes()
    assert made.is_symlink() == (link == "symlink")
    assert made.samefile(source) == (link != "copy")
    if link == "symlink":
        assert os.readlink(made) == str(source.resolve())
    # What is written beside the pictures is the export's own, whatever is done with it.
    assert not (out / "labels/train/one_000000.txt").is_symlink()


def test_copies_where_a_file_system_ends(place):
    other = Path("/dev/shm")
    if not other.is_dir() or other.stat().st_dev == place.folder.stat().st_dev:
        pytest.skip("one file system is all there is")
    out = other / f"veldt_export_{os.getpid()}"
    try:
        done = export(place, out, "--format", "yolo")
        assert (done.code, done.err) == (0, "")
        assert done.out.splitlines()[-1] == "9 pictures copied: the file system cannot link them"
        made = out / "images/train/one_000000.png"
        assert made.read_bytes() == (place.folder / "data/clips/one/ir8/000000.png").read_bytes()
    finally:
        shutil.rmtree(out)


# --- splits and selections --------------------------------------------------------------------------------------------


def test_clips_go_whole_to_one_split(place, tmp_path):
    done = export(place, tmp_path / "x", "--format", "yolo", "--split", "train:0.67,val:0.33")
    assert (done.code, done.err) == (0, "")
    splits = {s: {f.stem[:-7] for f in (tmp_path / "x/images" / s).iterdir()} for s in ("train", "val")}
    assert (len(splits["train"]), len(splits["val"])) == (2, 1)
    assert splits["train"] | splits["val"] == set(CLIPS)
    record = json.loads((tmp_path / "x" / "export.json").read_text())
    assert record["request"]["split"] == {"train": 0.67, "val": 0.33}
    assert record["request"]["seed"] == 5  # the dataset's
    assert {name: split["clips"] for name, split in record["splits"].items()} == {"train": 2, "val": 1}


def test_splits_of_coco_are_files_of_their_own(place, tmp_path):
    out = export_whole(
        place, tmp_path / "x", "--format", "coco", "--split", "a:0.3,b:0.3,c:0.4", "--seed", "3"
    )
    whole = place.read("data/annotations.json")
    parts = [json.loads((out / "annotations" / f"{name}.json").read_text()) for name in "abc"]
    for key in ("videos", "images", "annotations"):
        joined = [entry for part in parts for entry in part[key]]
        assert sorted(joined, key=lambda entry: entry["id"]) == whole[key]
    for part in parts:
        assert part["categories"] == whole["categories"]
        assert {image["video_id"] for image in part["images"]} == {part["videos"][0]["id"]}
        ids = {image["id"] for image in part["images"]}
        assert {a["image_id"] for a in part["annotations"]} <= ids
    again = export_whole(place, tmp_path / "y", "--format", "birdsai", source=out / "annotations" / "a.json")
    assert len(list((again / "annotations").iterdir())) == 1  # pictures are found beside annotations/


def test_a_seed_decides(place, tmp_path):
    def clips_in_a(name, *seed):
        out = export_whole(place, tmp_path / name, "--format", "mot", "--split", "a:0.34,b:0.66", *seed)
        return sorted(path.name for path in (out / "a").iterdir())

    found = {seed: clips_in_a(f"x{seed}", "--seed", seed) for seed in range(1, 9)}
    assert clips_in_a("again", "--seed", 4) == found[4]
    assert clips_in_a("own") == found[5]
    assert len({tuple(clips) for clips in found.values()}) > 1


def _select(place, frames: dict, **changes) -> Path:
    videos = [{"name": clip, "frames": list(indices)} for clip, indices in frames.items()]
    dataset = {"path": "data", "name": "made_up", "videos": videos} | changes
    return place.write("selection.json", {"format": "veldt-selection", "version": 1, "datasets": [dataset]})


def test_selected_frames(place, tmp_path):
    selection = _select(place, {"one": [1], "three": [0, 2]})
    out = export_whole(place, tmp_path / "x", "--format", "yolo", "--selection", selection)
    names = ["one_000001", "three_000000", "three_000002"]
    assert sorted(file.stem for file in (out / "images/train").iterdir()) == names
    assert sorted(file.stem for file in (out / "labels/train").iterdir()) == names
    out = export_whole(place, tmp_path / "y", "--format", "coco", "--selection", selection)
    document, whole = json.loads((out / "annotations.json").read_text()), place.read("data/annotations.json")
    assert document["images"] == [whole["images"][k] for k in (1, 6, 8)]
    assert len(document["annotations"]) == 4
    assert all(annotation in whole["annotations"] for annotation in document["annotations"])
    assert files_below(out) == sorted(
        ["annotations.json", "export.json", *(image["file_name"] for image in document["images"])]
    )


def test_a_selection_is_shared_out_by_clips_that_have_frames(place, tmp_path):
    selection = _select(place, {"one": [1], "two": [], "three": [0, 2]})
    out = export_whole(
        place, tmp_path / "x", "--format", "birdsai", "--selection", selection, "--split", "a:0.5,b:0.5"
    )
    assert sorted(file.name for file in out.glob("*/annotations/*")) == ["one.csv", "three.csv"]


# --- once more, and stopped -------------------------------------------------------------------------------------------


def test_once_more_there_is_nothing_to_do(place, tmp_path):
    options = ("--format", "coco", "--split", "a:0.5,b:0.5")
    export_whole(place, tmp_path / "x", *options)
    times = {file: file.stat().st_mtime_ns for file in (tmp_path / "x").rglob("*")}
    done = export(place, f"{tmp_path}/x/", *options)
    assert (done.code, done.err) == (0, "")
    assert done.out == f"{tmp_path}/x/: nothing to do; this export already exists\n"
    assert {file: file.stat().st_mtime_ns for file in (tmp_path / "x").rglob("*")} == times
    assert not list(tmp_path.glob("*.part"))


def test_into_an_empty_folder_that_is_there(place, tmp_path):
    (tmp_path / "x").mkdir()
    export_whole(place, tmp_path / "x", "--format", "mot")
    assert (tmp_path / "x" / "classes.txt").read_text() == "1 human\n2 elephant\n"


@pytest.fixture(name="many")
def _many(veldt) -> Veldt:
    """A COCO file with so many pictures that their progress fills a pipe, which blocks the run until it is read."""
    (veldt.folder / "pictures").mkdir()
    images = [
        {"id": k, "file_name": f"pictures/{k:05d}.png", "width": 4, "height": 4} for k in range(1, 3001)
    ]
    for image in images:
        (veldt.folder / image["file_name"]).write_bytes(b"a picture")
    document = {"images": images, "annotations": [], "categories": [{"id": 1, "name": "lion"}]}
    veldt.write("many.json", document)
    return veldt


def _held(many):
    run = many.start("export", "many.json", "--format", "yolo", "--out", "x", "--progress", "json")
    run.stderr.readline()
    return run


def test_stopped_it_leaves_nothing(many):
    run = _held(many)
    assert (many.folder / "x.part").is_dir()
    interrupt(run.pid, signal.SIGINT)
    out, err = run.communicate(timeout=PATIENCE_S)
    assert (run.returncode, out) == (128 + signal.SIGINT, "")
    assert err.splitlines()[-1] == "veldt: stopped on request; run the same command again to resume"
    assert sorted(path.name for path in many.folder.iterdir()) == ["many.json", "pictures"]


def test_two_runs_at_once(many):
    run = _held(many)
    done = many("export", "many.json", "--format", "yolo", "--out", "x", "--progress", "none")
    message = "x.part is in use by another run of veldt; try again when that one has ended"
    assert (done.code, done.out, done.err) == (75, "", f"veldt: {message}\n")
    run.communicate(timeout=PATIENCE_S)
    assert run.returncode == 0
    assert len(list((many.folder / "x/images/train").iterdir())) == 3000


def test_killed_it_starts_again(many):
    run = _held(many)
    run.kill()
    run.communicate(timeout=PATIENCE_S)
    assert (many.folder / "x.part" / "images").is_dir()
    assert not (many.folder / "x").exists()
    (many.folder / "x.part" / "left.txt").write_text("by a run of before")
    done = many("export", "many.json", "--format", "yolo", "--out", "x", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    assert len(files_below(many.folder / "x")) == 6002
    assert not (many.folder / "x.part").exists()
