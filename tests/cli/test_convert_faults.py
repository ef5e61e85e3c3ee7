"""Passes and requests that `convert` must reject: exact messages, exit codes, and no partial output."""

import shutil

import numpy as np
import pytest

import passes
from datasets import content_of
from pictures import write_exr
from program import ROOT, files_below

NAMES = sorted(file.stem for file in (ROOT / "assets" / "materials").glob("*.json"))
MATERIALS = ", ".join(NAMES[:40]) + f", … ({len(NAMES)} in all)"  # as messages list many names
INDEX = "expected a whole number from 0 to 32767"
FRAME = "one/000001.exr"


def _index(value):
    return lambda folder: passes.change_index(folder, 1, value)


def _frame(planes):
    return lambda folder: write_exr(folder / "000001.exr", planes)


def _bytes(content):
    return lambda folder: (folder / "000001.exr").write_bytes(content)


def _manifest(change):
    """Change the manifest of a clip."""

    def apply(folder):
        document = passes.manifest(folder.name)
        change(document)
        passes.write_manifest(folder, document)

    return apply


def _cut_short(folder):
    file = folder / "000001.exr"
    file.write_bytes(file.read_bytes()[:-40])


FLAT = np.full((passes.HEIGHT, passes.WIDTH), 30.0)
BAD_FRAMES = {
    "index that is not a number": (_index(np.nan), f"{passes.OBJECTS} at pixel (3, 2) = nan; {INDEX}"),
    "infinite index": (_index(np.inf), f"{passes.OBJECTS} at pixel (3, 2) = inf; {INDEX}"),
    "negative index": (_index(-1), f"{passes.OBJECTS} at pixel (3, 2) = -1; {INDEX}"),
    "half an index": (_index(1.5), f"{passes.OBJECTS} at pixel (3, 2) = 1.5; {INDEX}"),
    "index past the last": (_index(32768), f"{passes.OBJECTS} at pixel (3, 2) = 32768; {INDEX}"),
    "index the manifest lacks": (
        _index(103),
        "object index at pixel (3, 2) = 103 (1 pixels); expected an index of the manifest's objects: 0, 1, 4, 101, 102",
    ),
    "material index the manifest lacks": (
        _frame({passes.OBJECTS: passes.object_index(1), "Scene.IndexMA.X": FLAT}),
        "material index at pixel (0, 0) = 30 (384 pixels); expected an index of the manifest's materials: 0",
    ),
    "no object index": (
        _frame({"Scene.Depth.Z": FLAT, "Scene.Normal.X": FLAT, "RGBA": FLAT}),
        "no object index channel; expected one such as Scene.IndexOB.X; the file has: RGBA, Scene.Depth.Z,"
        " Scene.Normal.X",
    ),
    "two layers": (
        _frame({"A.IndexOB.X": passes.object_index(1), "B.IndexOB.X": passes.object_index(1)}),
        'IndexOB is in several layers: A, B; expected the manifest\'s "layer" to name one',
    ),
    "another size": (
        _frame({passes.OBJECTS: passes.object_index(1)[:12]}),
        "size = 24 x 12 px; expected the manifest's 24 x 16 px",
    ),
}


def _skipped(veldt, clip="one"):
    """The skipped frames in the clip's record."""
    return veldt.read(f"out/clips/{clip}/clip.json").get("skipped")


@pytest.mark.parametrize("name", BAD_FRAMES)
def test_a_bad_frame_is_named_and_skipped(veldt, name):
    """Exit code 3, all clips made; after a repair the same command completes the dataset as if undisturbed."""
    spoil, message = BAD_FRAMES[name]
    for clip in ("one", "two"):
        passes.write_clip(veldt.folder / clip, clip)
    run = ("convert", "one", "two", "--out", "out", "--quiet")
    assert veldt(*run[:3], "--out", "usual", "--quiet").code == 0
    spoil(veldt.folder / "one")
    expected = f"veldt: clip one: frame 1 skipped: {FRAME}: {message}\n"
    for _ in range(2):  # the second time there is nothing new
        done = veldt(*run)
        assert (done.code, done.out, done.err) == (3, "", expected)
    assert _skipped(veldt) == [{"frame_index": 1, "file": "000001.exr", "reason": message}]
    assert _skipped(veldt, "two") is None
    index = veldt.read("out/dataset.json")
    assert [(clip["status"], clip["frames"], clip.get("skipped")) for clip in index["clips"]] == [
        ("done", 2, 1),
        ("done", 3, None),
    ]
    assert (index["status"], index["frames"]) == ("complete", 5)
    assert veldt.pixels("out")["two"] == veldt.pixels("usual")["two"]
    assert veldt("validate", "out").code == 0
    shutil.rmtree(veldt.folder / "one")
    passes.write_clip(veldt.folder / "one", "one")
    assert veldt(*run).code == 0
    assert veldt.pixels("out") == veldt.pixels("usual")
    assert content_of(veldt.folder / "out") == content_of(veldt.folder / "usual")


@pytest.mark.parametrize("name", BAD_FRAMES)
def test_if_strict_the_first_bad_frame_ends_the_run(veldt, name):
    spoil, message = BAD_FRAMES[name]
    for clip in ("one", "two"):
        passes.write_clip(veldt.folder / clip, clip)
    spoil(veldt.folder / "one")
    (veldt.folder / "one" / "000002.exr").unlink()  # later faults are not reported
    done = veldt("convert", "one", "two", "--out", "out", "--strict", "--quiet")
    assert (done.code, done.out, done.err) == (1, "", f"veldt: {FRAME}: {message}\n")
    assert not list((veldt.folder / "out" / "clips").iterdir())
    assert veldt.read("out/dataset.json")["clips"] == [
        {"id": "one", "status": "failed", "reason": f"{FRAME}: {message}"},
        {"id": "two", "status": "pending"},
    ]


UNREADABLE = {
    "missing": (lambda folder: (folder / "000001.exr").unlink(), "no such file"),
    "no picture at all": (_bytes(b"not an EXR file"), "not an EXR file (wrong first bytes)"),
    "empty": (_bytes(b""), ""),
    "cut short": (_cut_short, ""),
}


@pytest.mark.parametrize("name", UNREADABLE)
def test_a_frame_that_cannot_be_read(veldt, name):
    spoil, reason = UNREADABLE[name]
    spoil(passes.write_clip(veldt.folder / "one"))
    done = veldt("convert", "one", "--out", "out", "--quiet")
    assert (done.code, done.out) == (3, "")
    assert done.err.startswith(f"veldt: clip one: frame 1 skipped: {FRAME}: ")
    assert done.err.endswith(f"{reason}\n") and done.err.count("\n") == 1
    strict = veldt("convert", "one", "--out", "strict", "--quiet", "--strict")
    assert (strict.code, strict.out) == (1, "")
    assert strict.err.startswith(f"veldt: cannot read {FRAME}: ") and strict.err.endswith(f"{reason}\n")
    assert not list((veldt.folder / "strict" / "clips").iterdir())


WITHOUT_INDEX = (
    "no object index channel; expected one such as Scene.IndexOB.X; the file has: B, G, R; an index that was written as"
    ' a picture is named by "channels": {"object_index": "R"} in the manifest'
)


@pytest.mark.parametrize("options", [[], ["--set", "sensor.model=physical"]])
def test_passes_without_an_index_leave_nothing(veldt, options):
    """The same message whatever the model, and a folder only if there is something to put into it."""
    for clip in ("one", "two"):
        folder = passes.write_clip(veldt.folder / clip, clip)
        for frame in range(passes.FRAMES):
            write_exr(folder / f"{frame:06d}.exr", {name: passes.object_index(frame) for name in "RGB"})
    done = veldt("convert", "one", "two", "--out", "out", "--quiet", *options)
    message = "veldt: clip {0} rejected: {0}/000000.exr: {1}; its 2 other frames cannot be converted either\n"
    assert (done.code, done.out) == (1, "")
    assert done.err == "".join(message.format(clip, WITHOUT_INDEX) for clip in ("one", "two"))
    assert not (veldt.folder / "out").exists()
    document = passes.manifest("one") | {"channels": {"object_index": "R"}}
    passes.write_manifest(
        veldt.folder / "one", document
    )  # the other is named, and keeps no clip from being made
    done = veldt("convert", "one", "two", "--out", "out", "--quiet", *options)
    assert (done.code, done.err) == (3, message.format("two", WITHOUT_INDEX))
    assert veldt.read("out/dataset.json")["clips"][0]["status"] == "done"


# --- manifests --------------------------------------------------------------------------------------------------------


def _set_in(place: str, key: str, value):
    return _manifest(lambda document: document[place][2].update({key: value}))


BAD_MANIFESTS = {
    "unknown key": (
        _manifest(lambda document: document.update(clips="one")),
        'clips is not a known key; expected one of {keys}; did you mean "clip"?',
    ),
    "another format": (
        _manifest(lambda document: document.update(format="coco")),
        'format = "coco"; expected veldt-passes',
    ),
    "index past the last": (
        _set_in("objects", "index", 40000),
        "objects[2].index = 40000; expected at least 1 and at most 32767",
    ),
    "index twice": (_set_in("objects", "index", 102), "objects[3].index = 102; expected each value once"),
    "track twice": (_set_in("objects", "track_id", 9), "objects[3].track_id = 9; expected each value once"),
    "actor without category": (
        _manifest(lambda document: document["objects"][2].pop("category")),
        "objects[2].category is missing; expected one for every actor",
    ),
    "unknown material of an object": (
        _set_in("objects", "material", "humn"),
        'objects[2].material = "humn"; expected one of {materials}; did you mean "human"?',
    ),
    "unknown material of an index": (
        _manifest(lambda document: document["materials"].append({"index": 1, "material": "lava"})),
        'materials[0].material = "lava"; expected one of {materials}',
    ),
    "no frames": (
        _manifest(lambda document: document.update(frames=[])),
        "frames and sequence are missing; expected one of them:"
        ' a list of files, or a pattern of their names such as "f_####.exr"',
    ),
    "a frame in another folder": (
        _set_in("frames", "file", "../x.exr"),
        'frames[2].file = "../x.exr"; expected text that matches ^[^/\\\\]+$',
    ),
    "a scene that could not name a folder": (
        _manifest(lambda document: document.update(scene="../home")),
        'scene = "../home"; expected at most 200 letters, digits, _ or -, not beginning with -',
    ),
    "the position of an unknown object": (
        _set_in("frames", "actors", [{"index": 55, "position_m": [0, 0, 0], "heading_rad": 0}]),
        "frames[2].actors[0].index = 55; expected the index of an actor in objects",
    ),
}


@pytest.mark.parametrize("name", BAD_MANIFESTS)
def test_a_manifest_that_cannot_be_meant(veldt, name):
    spoil, message = BAD_MANIFESTS[name]
    spoil(passes.write_clip(veldt.folder / "one"))
    keys = ", ".join(veldt.read(ROOT / "configs" / "schema" / "manifest.schema.json")["properties"])
    done = veldt("convert", "one", "--out", "out")
    assert done.err == f"veldt: one/manifest.json: {message.format(keys=keys, materials=MATERIALS)}\n"
    assert (done.code, done.out) == (1, "")
    assert not (veldt.folder / "out").exists()


def test_a_manifest_that_is_not_json(veldt):
    """The column is that of the last letter of the word that should not be there."""
    passes.write_clip(veldt.folder / "one")
    veldt.write("one/manifest.json", '{"format": "veldt-passes"\n "clip": "one"}')
    done = veldt("convert", "one", "--out", "out")
    assert (done.code, done.err) == (
        1,
        "veldt: one/manifest.json:2:7: not JSON: syntax error while parsing object - unexpected string literal;"
        " expected '}'\n",
    )


# --- requests ---------------------------------------------------------------------------------------------------------

SET_FORM = "expected KEY=VALUE"
REQUESTS = {
    "setting without a value": (["--set", "season"], f'--set = "season"; {SET_FORM}'),
    "setting without a key": (["--set", "=3"], f'--set = "=3"; {SET_FORM}'),
    "setting inside a number": (
        ["--set", "seed.more=3"],
        f'--set = "seed.more=3"; {SET_FORM} with the key of an object',
    ),
    "setting of a clip that is not there": (
        ["--set", "clips[4].season=summer"],
        '--set = "clips[4].season=summer"; expected an entry of clips, [0] to [0]',
    ),
    "setting of an unknown key": (
        ["--set", "sensor.optics.blur_sgma_px=1"],
        '--set: sensor.optics.blur_sgma_px is not a known key; expected one of {optics}; did you mean "blur_sigma_px"?',
    ),
    "setting of a wrong type": (
        ["--set", "sensor.optics.blur_sigma_px=wide"],
        '--set: sensor.optics.blur_sigma_px = "wide"; expected a number',
    ),
    "setting out of range": (
        ["--set", "sensor.optics.blur_sigma_px=-1"],
        "--set: sensor.optics.blur_sigma_px = -1 px; expected at least 0 and at most 10 px",
    ),
    "unknown season": (
        ["--set", "season=spring"],
        '--set: clips[0].season = "spring"; expected one of winter, summer',
    ),
    "setting of the camera that the passes already have": (
        ["--set", "season=summer", "camera.focal_length_m=0.02"],
        '--set = "camera.focal_length_m=0.02"; expected no camera; the manifest of one has that of its passes',
    ),
    "config that is missing": (["--config", "none.json"], "cannot read none.json: No such file or directory"),
    "config of other clips": (
        ["--config", "config.json"],
        'one: clip = "one"; expected one of ones; did you mean "ones"?',
    ),
    "one manifest for two clips": (
        ["two", "--manifest", "one/manifest.json"],
        "--manifest = one/manifest.json; expected a single folder of passes with it, not 2",
    ),
}


@pytest.mark.parametrize("name", REQUESTS)
def test_request_that_cannot_be_meant(veldt, name):
    options, message = REQUESTS[name]
    for clip in ("one", "two"):
        passes.write_clip(veldt.folder / clip, clip)
    veldt.write("config.json", {"name": "x", "clips": [{"id": "ones", "season": "winter", "frames": 3}]})
    schema = veldt.read(ROOT / "configs" / "schema" / "config.schema.json")["properties"]
    optics = schema["sensor"]["properties"]["optics"]["properties"]
    done = veldt("convert", "one", *options, "--out", "out")
    assert done.err == f"veldt: {message.format(optics=', '.join(optics))}\n"
    assert (done.code, done.out) == (2, "")
    assert not (veldt.folder / "out").exists()


def test_two_folders_of_one_clip(veldt):
    passes.write_clip(veldt.folder / "one")
    shutil.copytree(veldt.folder / "one", veldt.folder / "copy")
    done = veldt("convert", "one", "copy", "--out", "out")
    assert done.err == "veldt: one and copy both hold clip one; expected one folder per clip\n"
    assert (done.code, done.out) == (1, "")
    assert not (veldt.folder / "out").exists()


def test_a_dataset_of_other_settings_is_left_alone(veldt):
    passes.write_clip(veldt.folder / "one")
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    before = {name: (veldt.folder / "out" / name).read_bytes() for name in files_below(veldt.folder / "out")}
    done = veldt(
        "convert", "one", "--out", "out", "--set", "season=summer", "sensor.optics.blur_sigma_px=0.5"
    )
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        'veldt: out holds a dataset made from another config: clips[0].season is "summer" here and "winter" there,'
        " sensor.optics.blur_sigma_px is 0.5 here and 1 there; expected the same config, or another folder\n"
    )
    assert {
        name: (veldt.folder / "out" / name).read_bytes() for name in files_below(veldt.folder / "out")
    } == before
