"""`convert` into an existing dataset: clips whose manifest or passes have changed are made again, others are kept."""

import json
import os

import pytest

import passes
from pictures import write_exr
from program import files_below

REMADE = "clip one: its manifest or its passes have changed; making it again\n"


@pytest.fixture(name="dataset")
def _dataset(veldt):
    """Two clips, converted into `out`."""
    for clip in ("one", "two"):
        passes.write_clip(veldt.folder / clip, clip)
    assert _convert(veldt).code == 0
    return veldt.folder / "out"


def _convert(veldt, *options):
    return veldt("convert", "one", "two", "--out", "out", *options)


def _notes(done) -> str:
    return "".join(line + "\n" for line in done.err.splitlines() if "frames/s" not in line)


def _categories(dataset) -> set[str]:
    return {
        category["name"] for category in json.loads((dataset / "annotations.json").read_text())["categories"]
    }


def _change_manifest(folder, change) -> None:
    document = json.loads((folder / "manifest.json").read_text())
    change(document)
    passes.write_manifest(folder, document)


def _call_poachers(document) -> None:
    document["objects"][2]["category"] = "poacher"


def _halve_focal_length(document) -> None:
    document["camera"] |= {"fx_px": 15, "fy_px": 15}


def test_a_mended_manifest_gives_new_labels(veldt, dataset):
    assert _categories(dataset) == {"human", "elephant"}
    two = (dataset / "clips/two/clip.json").stat().st_mtime_ns
    for clip in ("one", "two"):
        _change_manifest(veldt.folder / clip, _call_poachers)
    done = _convert(veldt)
    assert (done.code, done.out) == (0, "out: 2 clips made, 6 frames\n")
    assert _notes(done) == REMADE + REMADE.replace("one", "two")
    assert _categories(dataset) == {"poacher", "elephant"}
    assert (dataset / "clips/two/clip.json").stat().st_mtime_ns > two
    assert veldt("validate", "out").code == 0


def test_only_the_clip_that_changed_is_made_again(veldt, dataset):
    before = {
        name: (dataset / name).stat().st_mtime_ns for name in files_below(dataset) if "clips/two" in name
    }
    _change_manifest(veldt.folder / "one", _halve_focal_length)
    done = _convert(veldt)
    assert (done.code, done.out, _notes(done)) == (
        0,
        "out: 1 clip made, 3 frames; 1 already existed\n",
        REMADE,
    )
    assert before == {name: (dataset / name).stat().st_mtime_ns for name in before}
    camera = json.loads((dataset / "clips/one/labels.json").read_text())["videos"][0]["camera"]
    assert camera["fx_px"] == 15


def test_new_passes_are_converted(veldt, dataset):
    depth = passes.object_index(1) * 0 + 40.0
    write_exr(veldt.folder / "one/000000.exr", {passes.OBJECTS: passes.object_index(1), passes.DEPTH: depth})
    before = (dataset / "clips/one/ir8/000000.png").read_bytes()
    assert _notes(_convert(veldt)) == REMADE
    assert (dataset / "clips/one/ir8/000000.png").read_bytes() != before


@pytest.mark.usefixtures("dataset")
def test_a_file_as_large_as_before_counts_by_its_time(veldt):
    file = veldt.folder / "one/000001.exr"
    os.utime(file)
    assert _notes(_convert(veldt)) == REMADE
    assert _convert(veldt).out == "out: nothing to do, 2 clips already existed\n"
    os.utime(file, ns=(0, 0))
    assert _convert(veldt).out == "out: nothing to do, 2 clips already existed\n"


@pytest.mark.usefixtures("dataset")
def test_the_layout_of_a_manifest_does_not_count(veldt):
    file = veldt.folder / "one/manifest.json"
    file.write_text(json.dumps(json.loads(file.read_text())))
    done = _convert(veldt)
    assert (done.out, done.err) == ("out: nothing to do, 2 clips already existed\n", "")


@pytest.mark.usefixtures("dataset")
def test_json_progress_reports_it(veldt):
    _change_manifest(veldt.folder / "one", _call_poachers)
    lines = [json.loads(line) for line in _convert(veldt, "--progress", "json").err.splitlines()]
    assert lines[0] == {"event": "remade", "clip": "one"}


def test_a_record_without_what_it_was_made_from_is_made_again(veldt, dataset):
    file = dataset / "clips/one/clip.json"
    record = json.loads(file.read_text())
    assert len(record.pop("made_from_sha256")) == 64
    file.write_text(json.dumps(record))
    assert _notes(_convert(veldt)) == REMADE
