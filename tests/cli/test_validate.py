"""`validate` finds all changes to a dataset since it was made, and names the file."""

import json

import pytest

import passes
from datasets import flip_bit


@pytest.fixture(name="dataset")
def _dataset(veldt):
    """A dataset of two clips, in the folder out."""
    folders = [passes.write_clip(veldt.folder / clip, clip) for clip in ("one", "two")]
    assert veldt("convert", *folders, "--out", "out", "--quiet").code == 0
    return veldt.folder / "out"


FRAME8, FRAME16 = "clips/two/ir8/000001.png", "clips/one/ir16/000002.png"
HEADER, MIDDLE, LAST = 18, 90, -1  # of a PNG: its width, its pixels, its closing checksum

CHANGED = "changed since it was written"

DAMAGE = {
    "frame deleted": (FRAME8, lambda f: f.unlink(), "missing"),
    "bit of the first byte flipped": (FRAME8, lambda f: flip_bit(f, 0), CHANGED),
    "bit of the header flipped": (FRAME8, lambda f: flip_bit(f, HEADER), CHANGED),
    "bit of the pixels flipped": (FRAME8, lambda f: flip_bit(f, MIDDLE), CHANGED),
    "bit of the last byte flipped": (FRAME8, lambda f: flip_bit(f, LAST), CHANGED),
    "16-bit frame cut short": (FRAME16, lambda f: f.write_bytes(f.read_bytes()[:-80]), CHANGED),
    "16-bit frame emptied": (FRAME16, lambda f: f.write_bytes(b""), CHANGED),
    "clip's record deleted": ("clips/one/clip.json", lambda f: f.unlink(), "missing"),
    "clip's record changed": (
        "clips/one/clip.json",
        lambda f: f.write_text(f.read_text().replace("winter", "summer")),
        CHANGED,
    ),
    "labels changed": (
        "clips/one/labels.json",
        lambda f: f.write_text(f.read_text().replace('"area": 6', '"area": 7')),
        CHANGED,
    ),
    "preview changed": ("clips/two/preview.mp4", lambda f: flip_bit(f, -1), CHANGED),
    "frame list changed": ("clips/two/frames.jsonl", lambda f: f.write_text(""), CHANGED),
    "annotations deleted": ("annotations.json", lambda f: f.unlink(), "missing"),
    "annotations changed": (
        "annotations.json",
        lambda f: f.write_text(f.read_text().replace('"area":6', '"area":7')),
        CHANGED,
    ),
}


def test_settings_are_for_configs(veldt, dataset):
    done = veldt("validate", dataset, "--set", "season=summer")
    assert (done.code, done.out) == (2, "")
    assert done.err == "veldt: --set = season=summer; expected a config to check, not a dataset\n"


def test_a_whole_dataset_is_valid(veldt, dataset):
    done = veldt("validate", "out")
    # A clip's files: 3 frames of each kind, clip.json, labels.json, frames.jsonl, preview.mp4; then annotations.json.
    assert (done.code, done.out, done.err) == (0, "out: 2 clips, 21 files checked, all unchanged\n", "")
    assert veldt("validate", dataset, "--json").json() == {
        "dataset": str(dataset),
        "valid": True,
        "clips": 2,
        "files": 21,
        "faults": [],
    }


@pytest.mark.parametrize("name", DAMAGE)
def test_damage_is_found_and_named(veldt, dataset, name):
    file, damage, words = DAMAGE[name]
    before = (dataset / file).read_bytes()
    damage(dataset / file)
    assert not (dataset / file).exists() or (dataset / file).read_bytes() != before
    done = veldt("validate", "out")
    assert (done.code, done.err) == (1, "")
    fault, summary = done.out.splitlines()
    assert fault == f"out/{file}: {words}"
    assert summary.startswith("out: 2 clips, ") and summary.endswith(" files checked, 1 faults")
    assert veldt("validate", "out", "--json").json()["faults"] == [fault]


def test_truncated_annotations_are_placed(veldt, dataset):
    text = (dataset / "annotations.json").read_text()
    (dataset / "annotations.json").write_text(text[:100])
    done = veldt("validate", "out")
    assert (done.code, done.err) == (1, "")
    fault, _ = done.out.splitlines()
    assert fault.startswith("out/annotations.json:1:101: not JSON: syntax error while parsing ")


def test_every_fault_is_reported_at_once(veldt, dataset):
    for name in ("000000", "000002"):
        (dataset / "clips" / "one" / "ir8" / f"{name}.png").unlink()
    (dataset / "annotations.json").unlink()
    report = veldt("validate", "out", "--json")
    assert report.code == 1
    assert report.json()["valid"] is False
    assert sorted(report.json()["faults"]) == [
        "out/annotations.json: missing",
        "out/clips/one/ir8/000000.png: missing",
        "out/clips/one/ir8/000002.png: missing",
    ]


def test_a_clip_that_is_not_made_yet_is_named(veldt, dataset):
    for frame in range(passes.FRAMES):
        passes.change_index(veldt.folder / "two", frame, -1)
    assert veldt("convert", "one", "two", "--out", "unfinished", "--quiet").code == 3
    done = veldt("validate", "unfinished")
    assert (done.code, done.err) == (1, "")
    assert done.out.splitlines()[0] == "unfinished/clips/two: not made yet (status failed)"
    assert dataset.exists()


@pytest.mark.parametrize("command", ["validate", "report"])
def test_progress_is_of_clips(veldt, dataset, command):
    done = veldt(command, dataset, "--progress", "json")
    events = [json.loads(line) for line in done.err.splitlines()]
    counts = [(event["clip"], event["clips_done"], event["clips_total"]) for event in events]
    assert counts == [("one", 1, 2), ("two", 2, 2)]


NO_DATASETS = {
    "empty folder": ({}, "cannot read out/dataset.json: No such file or directory", 1),
    "of something else": ({"format": "coco"}, "out/dataset.json does not belong to a Veldt dataset", 1),
}


@pytest.mark.parametrize("name", NO_DATASETS)
def test_a_folder_that_is_no_dataset(veldt, name):
    content, message, code = NO_DATASETS[name]
    (veldt.folder / "out").mkdir()
    if content:
        veldt.write("out/dataset.json", content)
    done = veldt("validate", "out")
    assert (done.code, done.out, done.err) == (code, "", f"veldt: {message}\n")
