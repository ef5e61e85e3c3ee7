"""Frames that `convert` skips: reports, repeated runs, and other commands on such a dataset."""

import json

import pytest

import passes
from opened import Opened
from raw_exr import exr_bytes

MISSING = "no such file"
UNKNOWN = (
    "object index at pixel (3, 2) = 103 (1 pixels);"
    " expected an index of the manifest's objects: 0, 1, 4, 101, 102"
)


def _clip(veldt, frames, missing=(), clip="one"):
    """Passes without some frames."""
    folder = passes.write_clip(veldt.folder / clip, clip, frames)
    for frame in missing:
        (folder / f"{frame:06d}.exr").unlink()
    return folder


def _messages(done):
    """The messages about skipped frames, without their common prefix."""
    begin = "veldt: clip one: "
    lines = done.err.splitlines()
    assert all(line.startswith(begin) for line in lines)
    return [line[len(begin) :] for line in lines]


def test_consecutive_missing_frames_are_reported_in_one_line(veldt):
    _clip(veldt, 10, (0, 3, 4, 5, 7, 9))
    passes.change_index(veldt.folder / "one", 8, 103)
    done = veldt("convert", "one", "--out", "out", "--progress", "none")
    assert (done.code, done.out) == (3, "out: 1 clip made, 3 frames; 7 frames skipped\n")
    assert _messages(done) == [
        f"frame 0 skipped: one/000000.exr: {MISSING}",
        f"frames 3 to 5 skipped: one/000003.exr to 000005.exr: {MISSING}",
        f"frame 7 skipped: one/000007.exr: {MISSING}",
        f"frame 8 skipped: one/000008.exr: {UNKNOWN}",
        f"frame 9 skipped: one/000009.exr: {MISSING}",
    ]
    again = veldt("convert", "one", "--out", "out", "--progress", "none")
    assert again.out == "out: nothing to do, 1 clip already existed; 7 frames skipped\n"
    assert (again.code, again.err) == (3, done.err)


@pytest.mark.parametrize(
    "missing, more", [(20, None), (21, "1 more frame skipped"), (25, "5 more frames skipped")]
)
def test_at_most_twenty_lines_a_clip(veldt, missing, more):
    _clip(veldt, 2 * missing, range(1, 2 * missing, 2))
    messages = _messages(veldt("convert", "one", "--out", "out", "--quiet"))
    assert messages[:20] == [f"frame {k} skipped: one/{k:06d}.exr: {MISSING}" for k in range(1, 40, 2)]
    assert messages[20:] == ([more] if more else [])
    assert len(veldt.read("out/clips/one/clip.json")["skipped"]) == missing


def test_a_single_skipped_frame_is_reported_in_the_singular(veldt):
    _clip(veldt, 3, (1,))
    done = veldt("convert", "one", "--out", "out", "--progress", "none")
    assert done.out == "out: 1 clip made, 2 frames; 1 frame skipped\n"


def test_a_clip_without_any_good_frame_is_rejected(veldt):
    _clip(veldt, 3, range(3))
    _clip(veldt, 3, clip="two")
    done = veldt("convert", "one", "two", "--out", "out", "--progress", "none")
    why = f"cannot read one/000000.exr: {MISSING}; its 2 other frames cannot be converted either"
    assert (done.code, done.err) == (3, f"veldt: clip one rejected: {why}\n")
    assert done.out == "out: 1 clip made, 3 frames; the dataset is not complete yet\n"
    assert [file.name for file in (veldt.folder / "out" / "clips").iterdir()] == ["two"]
    assert veldt.read("out/dataset.json")["clips"][0] == {"id": "one", "status": "failed", "reason": why}
    alone = veldt("convert", "one", "--out", "alone", "--quiet")
    assert (alone.code, alone.err) == (1, done.err)


def test_json_progress_reports_a_skipped_frame_at_once(veldt):
    _clip(veldt, 3, (1,))
    done = veldt("convert", "one", "--out", "out", "--progress", "json", "--threads", "1")
    lines = [json.loads(line) for line in done.err.splitlines()[:-1]]
    assert lines[2] == {
        "event": "skipped",
        "clip": "one",
        "frame_index": 1,
        "file": "000001.exr",
        "reason": MISSING,
    }
    assert [line["frames_done"] for line in lines if "frames_done" in line] == [0, 1, 2, 3]
    assert done.err.splitlines()[-1] == f"veldt: clip one: frame 1 skipped: one/000001.exr: {MISSING}"


def test_what_a_name_or_a_channel_says_is_shown_and_kept_as_one_line(veldt):
    """Names come from untrusted files: they must neither control a terminal nor break the record's JSON."""
    folder = _clip(veldt, 3)
    document = passes.manifest()
    document["frames"][1]["file"] = "\x1b[2J\n.exr"
    passes.write_manifest(folder, document)
    index = passes.object_index(2)
    (folder / "000002.exr").write_bytes(
        exr_bytes({"Aaaaaaa.X": index}).replace(b"Aaaaaaa", b"\xff\x1b[2J\n\x80")
    )
    done = veldt("convert", "one", "--out", "out", "--quiet")
    assert done.code == 3
    rule = "no object index channel; expected one such as Scene.IndexOB.X; the file has: "
    assert _messages(done) == [
        f"frame 1 skipped: one/\\x1b[2J; .exr: {MISSING}",
        f"frame 2 skipped: one/000002.exr: {rule}\\xff\\x1b[2J; \\x80.X",
    ]
    assert [frame["file"] for frame in veldt.read("out/clips/one/clip.json")["skipped"]] == [
        "\\x1b[2J; .exr",
        "000002.exr",
    ]
    assert veldt("validate", "out").code == 0


# --- again ------------------------------------------------------------------------------------------------------------


def test_the_next_run_reads_the_skipped_frames_alone(veldt):
    folder = _clip(veldt, 6, (1,))
    passes.change_index(folder, 4, 103)
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 3
    before = (veldt.folder / "out" / "dataset.json").stat().st_mtime_ns
    with Opened(folder) as opened:
        done = veldt("convert", "one", "--out", "out", "--quiet")
        read = opened.counts(".exr")
    assert (done.code, set(read)) == (3, {folder / "000004.exr"})  # the other is not there to be opened
    assert (veldt.folder / "out" / "dataset.json").stat().st_mtime_ns == before


def test_a_clip_is_made_again_when_one_of_several_frames_is_repaired(veldt):
    folder = _clip(veldt, 5, (1, 3))
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 3
    (folder / "000001.exr").write_bytes((folder / "000002.exr").read_bytes())
    done = veldt("convert", "one", "--out", "out", "--progress", "none")
    assert (done.code, done.out) == (3, "out: 1 clip made, 4 frames; 1 frame skipped\n")
    assert _messages(done) == [f"frame 3 skipped: one/000003.exr: {MISSING}"]
    assert veldt("validate", "out").code == 0
    assert len(veldt.read("out/annotations.json")["images"]) == 4


def test_strict_after_a_run_that_was_not_names_the_first_and_leaves_the_clip(veldt):
    _clip(veldt, 5, (1, 3))
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 3
    before = veldt.pixels("out")
    done = veldt("convert", "one", "--out", "out", "--strict", "--quiet")
    assert (done.code, done.err) == (1, f"veldt: cannot read one/000001.exr: {MISSING}\n")
    assert veldt.pixels("out") == before
    assert veldt("validate", "out").code == 0
    assert [file.name for file in (veldt.folder / "out" / "clips").iterdir()] == ["one"]


def test_a_strict_run_over_good_frames_is_as_any(veldt):
    _clip(veldt, 3)
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    done = veldt("convert", "one", "--out", "strict", "--strict", "--quiet")
    assert (done.code, done.err) == (0, "")
    assert veldt.pixels("strict") == veldt.pixels("out")


def test_variants_skip_the_same_frames_which_are_reported_once(veldt):
    folder = _clip(veldt, 4, (2,))
    veldt.write(
        "variants.json",
        {"variants": [{"name": "dry", "season": "winter"}, {"name": "wet", "season": "summer"}]},
    )
    run = ("convert", "one", "--out", "out", "--variants", "variants.json", "--progress", "none")
    done = veldt(*run)
    assert (done.code, _messages(done)) == (3, [f"frame 2 skipped: one/000002.exr: {MISSING}"])
    assert done.out == "".join(
        f"out/{name}: 1 clip made, 3 frames; 1 frame skipped\n" for name in ("dry", "wet")
    )
    (folder / "000002.exr").write_bytes((folder / "000001.exr").read_bytes())
    done = veldt(*run)
    assert (done.code, done.err) == (0, "")
    assert done.out == "".join(f"out/{name}: 1 clip made, 4 frames\n" for name in ("dry", "wet"))


# --- what others make of it -------------------------------------------------------------------------------------------


@pytest.fixture(name="holes")
def _holes(veldt):
    """A dataset of two clips that lack frames: the first its middle and its last, the second its first."""
    _clip(veldt, 5, (2, 4))
    _clip(veldt, 4, (0,), "two")
    assert veldt("convert", "one", "two", "--out", "out", "--quiet").code == 3
    return veldt.folder / "out"


FRAMES = {"one": (0, 1, 3), "two": (1, 2, 3)}


def test_ids_of_images_are_unique_and_labels_point_at_theirs(veldt, holes):
    document = veldt.read(holes / "annotations.json")
    images = {image["id"]: image for image in document["images"]}
    assert len(images) == len(document["images"]) == 6
    assert [(i["file_name"], i["frame_index"]) for i in document["images"]] == [
        (f"clips/{clip}/ir8/{k:06d}.png", k) for clip, frames in FRAMES.items() for k in frames
    ]
    for annotation in document["annotations"]:
        image = images[annotation["image_id"]]
        if annotation["track_id"] == 7:  # the walker goes a pixel a frame
            assert annotation["bbox"][0] == 8 + image["frame_index"]
    assert len(document["annotations"]) == 12


def test_validate_and_report_and_merge_take_it(veldt, holes):
    assert (veldt("validate", "out").code, veldt("validate", "out").err) == (0, "")
    report = veldt("report", "out", "--quiet")
    assert (report.code, report.err) == (0, "")
    merged = veldt("merge", "out", "--out", "merged", "--quiet")
    assert (merged.code, merged.err) == (0, "")
    assert veldt.pixels("merged") == veldt.pixels(holes)
    assert [clip["skipped"] for clip in veldt.read("merged/dataset.json")["clips"]] == [2, 1]
    assert (veldt.folder / "merged" / "annotations.json").read_bytes() == (
        holes / "annotations.json"
    ).read_bytes()


@pytest.mark.parametrize("kind, pictures", [("coco", 6), ("yolo", 6), ("mot", 6), ("birdsai", 6)])
def test_exports_take_it(veldt, holes, kind, pictures):
    done = veldt("export", holes, "--format", kind, "--out", "exported", "--quiet")
    assert (done.code, done.err) == (0, "")
    assert len(list((veldt.folder / "exported").rglob("*.png"))) == pictures


def test_mot_numbers_the_frames_that_are_there(veldt, holes):
    """A tracker walks through img1 from 1 without holes, and gt.txt must count as it does."""
    assert veldt("export", holes, "--format", "mot", "--out", "mot", "--quiet").code == 0
    (folder,) = (veldt.folder / "mot").glob("*/one")
    assert sorted(file.name for file in (folder / "img1").iterdir()) == [f"{k:06d}.png" for k in (1, 2, 3)]
    rows = [line.split(",") for line in (folder / "gt" / "gt.txt").read_text().splitlines()]
    walker = {int(row[0]): float(row[2]) for row in rows if row[1] == "7"}
    assert walker == {1: 9.0, 2: 10.0, 3: 12.0}  # x from 1; the walker moves on during skipped frames


def test_balance_chooses_from_it(veldt, holes):
    done = veldt("balance", holes, "--per-class", "small_animal=1:99", "--out", "chosen.json", "--quiet")
    assert (done.code, done.err) == (0, "")
    chosen = veldt(
        "export", holes, "--selection", "chosen.json", "--format", "coco", "--out", "coco", "--quiet"
    )
    assert (chosen.code, chosen.err) == (0, "")


def test_evaluate_takes_it_as_truth(veldt, holes):
    document = veldt.read(holes / "annotations.json")
    veldt.write(
        "found.json",
        [
            {"image_id": a["image_id"], "category_id": a["category_id"], "bbox": a["bbox"], "score": 0.9}
            for a in document["annotations"]
        ],
    )
    done = veldt("evaluate", "--truth", holes, "--detections", "found.json", "--json")
    assert (done.code, done.err) == (0, "")


# --- limits -----------------------------------------------------------------------------------------------------------


def test_passes_over_the_limit_are_refused(veldt):
    _clip(veldt, 3)
    done = veldt("convert", "one", "--out", "out", "--max-megapixels", "0.000383", "--quiet")
    assert (done.code, done.err) == (
        1,
        "veldt: clip one rejected: one: size of the passes = 24 x 16 px;"
        " expected at most 383 pixels (--max-megapixels)\n",
    )
    assert veldt("convert", "one", "--out", "out", "--max-megapixels", "0.000384", "--quiet").code == 0


@pytest.mark.parametrize(
    "value, shown", [("0", "0"), ("-1", "-1"), ("nan", "nan"), ("1e7", "10000000"), ("9e-7", "9e-07")]
)
def test_a_limit_that_cannot_be_meant(veldt, value, shown):
    _clip(veldt, 1)
    done = veldt("convert", "one", "--out", "out", f"--max-megapixels={value}")
    rule = "expected at least 0.000001 (a pixel) and at most 1000000"
    assert (done.code, done.err) == (2, f"veldt: --max-megapixels = {shown}; {rule}\n")
    assert not (veldt.folder / "out").exists()
