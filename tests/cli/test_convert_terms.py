"""Physical terms on passes that lack their inputs: automatic terms are dropped and reported, others are faults."""

import json

import numpy as np
import pytest

import passes
from pictures import write_exr
from program import files_below

PHYSICAL = ["--set", "sensor.model=physical"]
STRAIGHT_DOWN = [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 50, 0, 0, 0, 1]
LOOKING = {"variation", "sky", "angular", "path"}  # terms that draw on planes


def _write_clip(folder, *, depth=True, normals=True, poses=True, height=True):
    """Passes of a clip seen from 50 m above level ground, with some of the inputs of physical terms."""
    folder.mkdir()
    document = passes.manifest(folder.name)
    even = np.ones((passes.HEIGHT, passes.WIDTH))
    for k, frame in enumerate(document["frames"]):
        planes = {passes.OBJECTS: passes.object_index(k)}
        if depth:
            planes[passes.DEPTH] = 50 * even
        if normals:
            planes |= {f"Scene.Normal.{axis}": even * (axis == "Z") for axis in "XYZ"}
        if poses:
            frame["camera_to_world"] = STRAIGHT_DOWN
        if height:
            frame["agl_m"] = 50
        write_exr(folder / f"{k:06d}.exr", planes)
    passes.write_manifest(folder, document)


def _terms(veldt, dataset="out") -> dict:
    return {term["term"]: term for term in veldt.read(f"{dataset}/dataset.json")["physics"]["terms"]}


def _kept(veldt, dataset="out") -> set:
    return {name for name, term in _terms(veldt, dataset).items() if term["kept"]}


LACKING = {
    "depth": ({"depth": False}, {"variation", "path"}, "no depth"),
    "normals": ({"normals": False}, {"facing", "sky", "angular"}, "no normals"),
    "poses": (
        {"poses": False},
        {"facing", "variation", "sky", "angular"},
        "frames[0] has no camera_to_world",
    ),
}
# Maps of the ground come with plans alone.
NO_MAPS = {"place": "clip one: no maps of the ground"}


@pytest.mark.parametrize("what", LACKING)
def test_automatic_terms_are_dropped_and_reported(veldt, what):
    without, dropped, lacking = LACKING[what]
    _write_clip(veldt.folder / "one", **without)
    done = veldt("convert", "one", "--out", "out", "--progress", "none", *PHYSICAL)
    assert (done.code, done.err) == (0, "")
    reasons = {name: term["impossible"] for name, term in _terms(veldt).items() if "impossible" in term}
    assert reasons == NO_MAPS | {name: f"clip one: {lacking}" for name in dropped}
    assert not _kept(veldt) & dropped
    for name in sorted(dropped, key=list(_terms(veldt)).index):
        assert f"out: without the term {name} (clip one: {lacking})\n" in done.out


@pytest.mark.parametrize("what", LACKING)
def test_a_term_asked_for_is_a_fault(veldt, what):
    without, dropped, lacking = LACKING[what]
    _write_clip(veldt.folder / "one", **without)
    for name in dropped:
        done = veldt("convert", "one", "--out", "out", *PHYSICAL, f"terms.{name}=on")
        assert done.err == f"veldt: terms.{name} = on; expected off or auto, because clip one: {lacking}\n"
        assert (done.code, done.out) == (2, "")
        assert not (veldt.folder / "out").exists()


def test_whole_passes_lack_maps_alone(veldt):
    _write_clip(veldt.folder / "one")
    done = veldt("convert", "one", "--out", "out", "--progress", "none", *PHYSICAL)
    lacking = f"out: without the term place ({NO_MAPS['place']})\n"
    assert (done.code, done.out) == (0, "out: 1 clip made, 3 frames\n" + lacking)
    assert {name for name, term in _terms(veldt).items() if "impossible" in term} == set(NO_MAPS)


def test_table_1_needs_no_maps(veldt):
    _write_clip(veldt.folder / "one")
    done = veldt("convert", "one", "--out", "out", *PHYSICAL, "scene.temperatures=table_1")
    assert (done.code, done.out.splitlines()[-1]) == (0, "out: 1 clip made, 3 frames")
    assert not any("impossible" in term for term in _terms(veldt).values())


def test_the_published_model_asks_for_nothing(veldt):
    _write_clip(veldt.folder / "one", depth=False, normals=False, poses=False, height=False)
    done = veldt("convert", "one", "--out", "out", "--progress", "none")
    assert (done.code, done.out) == (0, "out: 1 clip made, 3 frames\n")


def test_labels_have_the_same_keys_whatever_the_terms(veldt):
    """Depth is there, poses of the actors are not: their range is that of their pixels."""
    _write_clip(veldt.folder / "one")
    off = [word for term in sorted(LOOKING) for word in ("--set", f"terms.{term}=off")]
    keys = {}
    for name, options in {"published": [], "physical": PHYSICAL, "off": PHYSICAL + off}.items():
        done = veldt("convert", "one", "--out", name, "--quiet", *options)
        assert (done.code, done.err) == (0, "")
        labels = veldt.read(f"{name}/annotations.json")["annotations"]
        assert all(label["range_m"] > 50 for label in labels)
        frames = (veldt.folder / name / "clips" / "one" / "frames.jsonl").read_text(encoding="utf-8")
        keys[name] = [set(label) for label in labels], [set(json.loads(line)) for line in frames.splitlines()]
    assert keys["published"] == keys["physical"] == keys["off"]


def test_of_several_clips_the_one_that_lacks_it_is_named(veldt):
    _write_clip(veldt.folder / "one")
    _write_clip(veldt.folder / "two", depth=False)
    assert veldt("convert", "one", "two", "--out", "out", "--quiet", *PHYSICAL).code == 0
    assert _terms(veldt)["path"]["impossible"] == "clip two: no depth"


def test_a_missing_height_is_computed_from_depth(veldt):
    """The same ground, 50 m below: from the manifest, or from the depth plane. The path term has the same spread, up to
    the difference between a grid of pixel centres and the corners of the picture."""
    _write_clip(veldt.folder / "one")
    assert veldt("convert", "one", "--out", "stated", "--quiet", *PHYSICAL).code == 0
    (veldt.folder / "one").rename(veldt.folder / "other")
    _write_clip(veldt.folder / "one", height=False)
    assert veldt("convert", "one", "--out", "seen", "--quiet", *PHYSICAL).code == 0
    stated, seen = (_terms(veldt, name) for name in ("stated", "seen"))
    assert _kept(veldt, "stated") == _kept(veldt, "seen")
    assert stated["path"]["spread_mk"] > 0
    assert seen["path"]["spread_mk"] == pytest.approx(stated["path"]["spread_mk"], rel=0.02)


def test_terms_that_need_no_plane_stay(veldt):
    _write_clip(veldt.folder / "one", depth=False, normals=False, poses=False)
    assert veldt("convert", "one", "--out", "out", "--quiet", *PHYSICAL).code == 0
    assert _kept(veldt) == {"parts", "falloff"} - LOOKING


def _fly(folder, step_m):
    """The camera of a clip's passes flies east by so much a frame."""
    document = json.loads((folder / "manifest.json").read_text())
    for k, frame in enumerate(document["frames"]):
        frame["camera_to_world"] = [*STRAIGHT_DOWN[:3], step_m * k, *STRAIGHT_DOWN[4:]]
    passes.write_manifest(folder, document)


SLOW = [*PHYSICAL, "sensor.time_constant_s=0.01"]


def _sharp_and_smeared(veldt):
    for name, choice in (("sharp", "off"), ("smeared", "auto")):
        done = veldt(
            "convert",
            "one",
            "--out",
            name,
            "--quiet",
            *SLOW,
            "sensor.noise.amount=0",
            f"terms.smear={choice}",
        )
        assert (done.code, done.err) == (0, "")
    return [(veldt.folder / name / "clips/one/ir16/000001.png").read_bytes() for name in ("sharp", "smeared")]


def test_a_moving_picture_is_smeared(veldt):
    _write_clip(veldt.folder / "one")
    _fly(veldt.folder / "one", 5)
    sharp, smeared = _sharp_and_smeared(veldt)
    assert sharp != smeared
    terms = [_terms(veldt, name)["smear"] for name in ("sharp", "smeared")]
    assert [term["kept"] for term in terms] == [False, True]
    assert terms[0]["spread_mk"] == terms[1]["spread_mk"] > 1000
    labels = [veldt.read(f"{name}/annotations.json")["annotations"] for name in ("sharp", "smeared")]
    assert [one["bbox"] for one in labels[0]] == [one["bbox"] for one in labels[1]]


def test_a_still_picture_is_not(veldt):
    _write_clip(veldt.folder / "one")
    sharp, smeared = _sharp_and_smeared(veldt)
    assert sharp == smeared
    assert not _terms(veldt, "smeared")["smear"]["kept"]


@pytest.mark.parametrize("what", ["depth", "poses"])
def test_smear_needs_depth_and_poses_where_pixels_take_time(veldt, what):
    without, _, lacking = LACKING[what]
    _write_clip(veldt.folder / "one", **without)
    assert veldt("convert", "one", "--out", "out", "--quiet", *SLOW).code == 0
    assert _terms(veldt)["smear"]["impossible"] == f"clip one: {lacking}"


def test_a_first_frame_that_cannot_be_read_is_passed_over(veldt):
    _write_clip(veldt.folder / "one", depth=False)
    (veldt.folder / "one" / "000000.exr").write_bytes(b"no picture")
    done = veldt("convert", "one", "--out", "out", "--quiet", *PHYSICAL)
    assert done.code == 3
    assert _terms(veldt)["path"]["impossible"] == "clip one: no depth"
    assert "clips/one/ir16/000002.png" in files_below(veldt.folder / "out")
