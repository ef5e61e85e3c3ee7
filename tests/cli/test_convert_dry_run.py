"""`convert --dry-run` says what a run would do, and writes nothing."""

import json

import pytest

import passes
from program import check_fault, files_below


@pytest.fixture(name="place")
def _place(veldt):
    for clip in ("one", "two"):
        passes.write_clip(veldt.folder / clip, clip)
    return veldt


def _dry(veldt, *options):
    """Its steps, without the spaces between columns; checks that nothing was written."""
    before = {name: (veldt.folder / name).stat().st_mtime_ns for name in files_below(veldt.folder)}
    done = veldt("convert", "one", "two", "--out", "out", "--dry-run", *options)
    assert {name: (veldt.folder / name).stat().st_mtime_ns for name in files_below(veldt.folder)} == before
    assert (done.code, done.err) == (0, "")
    return [" ".join(line.split()) for line in done.out.splitlines()]


def test_a_new_dataset(place):
    assert _dry(place) == [
        "out: clip frames what to do",
        "one 3 make",
        "two 3 make",
        "2 of 2 clips to make, 6 frames",
    ]
    assert not (place.folder / "out").exists()


def test_a_dataset_that_is_there(place):
    assert place("convert", "one", "two", "--out", "out", "--quiet").code == 0
    assert _dry(place)[1:] == ["one 3 keep", "two 3 keep", "0 of 2 clips to make, 0 frames"]
    manifest = json.loads((place.folder / "two" / "manifest.json").read_text())
    manifest["camera"]["fx_px"] *= 2
    (place.folder / "two" / "manifest.json").write_text(json.dumps(manifest))
    assert _dry(place)[1:] == ["one 3 keep", "two 3 make again", "1 of 2 clips to make, 3 frames"]


def test_terms_that_passes_lack_something_for(place):
    lines = _dry(place, "--set", "sensor.preset=boson_640_14mm")
    assert "without the term sky (clip one: no normals)" in lines


def test_each_variant(place):
    place.write("v.json", {"variants": [{"name": "cold"}, {"name": "warm", "season": "summer"}]})
    lines = _dry(place, "--variants", "v.json")
    assert [line for line in lines if line.startswith("out")] == [
        "out/cold: clip frames what to do",
        "out/warm: clip frames what to do",
    ]


def test_a_fault_of_the_request(place):
    done = place("convert", "one", "--out", "out", "--dry-run", "--set", "sensor.preset=x")
    assert done.code == 2 and done.err.startswith("veldt: ")
    (place.folder / "one" / "manifest.json").write_text("{")
    done = place("convert", "one", "--out", "out", "--dry-run")
    assert done.code == 1
    check_fault(done, 1, done.err.removeprefix("veldt: ").removesuffix("\n"))
    assert not (place.folder / "out").exists()
