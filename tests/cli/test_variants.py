"""`convert --variants`: many datasets from reading the passes once, each identical to one made alone."""

import fcntl
import shutil
import signal

import numpy as np
import pytest

import passes
from opened import Opened
from pictures import write_exr
from program import ROOT, files_below

# What a variant may change, and the same by --set.
VARIANTS = {
    "plain": ({}, []),
    "summer": (
        {"season": "summer", "seed": 3, "sensor": {"optics": {"blur_sigma_px": 0.5}}},
        ["season=summer", "seed=3", "sensor.optics.blur_sigma_px=0.5"],
    ),
    "plateau": (
        {"sensor": {"agc": {"mode": "plateau", "polarity": "black_hot"}, "shutter": {"interval_s": 0.2}}},
        ["sensor.agc.mode=plateau", "sensor.agc.polarity=black_hot", "sensor.shutter.interval_s=0.2"],
    ),
    "boson": (
        {
            "sensor": {"preset": "boson_640_14mm"},
            "camera": {"distortion": {"k1": 0}},  # the passes have no overscan
            "weather": {"air_temperature_k": 280},
            "terms": {"sky": "on", "angular": "off", "place": "off"},  # the passes have no maps of the ground
        },
        [
            "sensor.preset=boson_640_14mm",
            "camera.distortion.k1=0",
            "weather.air_temperature_k=280",
            "terms.sky=on",
            "terms.angular=off",
            "terms.place=off",
        ],
    ),
    "noiseless": ({"sensor": {"noise": {"amount": 0}}}, ["sensor.noise.amount=0"]),  # the scene of "plain"
}
NAMES = list(VARIANTS)


def _list(*names: str) -> dict:
    return {"variants": [{"name": name, **VARIANTS[name][0]} for name in names]}


def _write_clip(folder):
    """Passes of a clip with all that physical terms ask for: seen from 50 m above even ground."""
    folder.mkdir()
    document = passes.manifest(folder.name)
    even = np.ones((passes.HEIGHT, passes.WIDTH))
    for k, frame in enumerate(document["frames"]):
        frame |= {"agl_m": 50, "camera_to_world": [1, 0, 0, k, 0, -1, 0, 0, 0, 0, -1, 50, 0, 0, 0, 1]}
        normal = {f"Scene.Normal.{axis}": even * (axis == "Z") for axis in "XYZ"}
        planes = {passes.OBJECTS: passes.object_index(k), passes.DEPTH: 50 * even}
        write_exr(folder / f"{k:06d}.exr", planes | normal)
    passes.write_manifest(folder, document)
    return folder


@pytest.fixture(name="clips")
def _clips(veldt):
    """Passes of two clips, in the folders one and two, and a list of all variants."""
    veldt.write("list.json", _list(*NAMES))
    return [_write_clip(veldt.folder / clip) for clip in ("one", "two")]


def _convert(veldt, *arguments):
    done = veldt("convert", *arguments, "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")


def _times(folder) -> dict:
    return {file: file.stat().st_mtime_ns for file in folder.rglob("*")}


# --- what is made -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("threads", ["1", "2"])
def test_a_variant_is_what_it_would_be_alone(veldt, clips, threads):
    """Labels, config and hashes of all pixels are those of a plain conversion with the same settings."""
    done = veldt(
        *("convert", *clips, "--variants", "list.json", "--out", "out"),
        *("--threads", threads, "--progress", "none"),
    )
    expected = "".join(f"out/{name}: 2 clips made, 6 frames\n" for name in NAMES)
    assert (done.code, done.out, done.err) == (0, expected, "")
    for name, (_, settings) in VARIANTS.items():
        _convert(veldt, *clips, "--out", "alone", *(["--set", *settings] if settings else []))
        here, there = veldt.folder / "out" / name, veldt.folder / "alone"
        assert files_below(here) == files_below(there)
        found, expected = veldt.read(here / "dataset.json"), veldt.read(there / "dataset.json")
        for clip in (*found["clips"], *expected["clips"]):
            del clip["record_sha256"]  # the preview is among it: lossy, and the encoder's own
        assert found == expected
        assert (here / "annotations.json").read_bytes() == (there / "annotations.json").read_bytes()
        assert veldt("validate", f"out/{name}").code == 0
        shutil.rmtree(there)
    assert len({veldt.pixels(f"out/{name}")["all"] for name in NAMES}) == len(NAMES)


def test_each_file_of_passes_is_opened_as_often_as_for_one_dataset(veldt, clips):
    """As for a single dataset that needs to know the planes, which reads the first frame of each clip first."""
    with Opened(*clips) as opened:
        _convert(veldt, *clips, "--out", "alone", "--set", "sensor.model=physical")
        once = opened.counts(".exr")
        seen = {file: n for file, n in once.items() if file.name != "000000.exr"}
        assert len(once) == 6 and set(seen.values()) == {min(once.values())}
        assert max(once.values()) == 2 * min(once.values())
        _convert(veldt, *clips, "--variants", "list.json", "--out", "out")
        assert opened.counts(".exr") == once
        _convert(veldt, *clips, "--variants", "list.json", "--out", "out")
        assert set(opened.counts(".exr")) == set(once) - set(seen)  # nothing was left to do
        shutil.rmtree(veldt.folder / "out" / "summer" / "clips" / "two")
        _convert(veldt, *clips, "--variants", "list.json", "--out", "out")
        assert set(opened.counts(".exr")) == {
            clips[0] / "000000.exr",
            *(file for file in once if file.parent == clips[1]),
        }


def test_variants_change_the_config_after_its_settings(veldt, clips):
    clip = {"id": "one", "season": "summer", "frames": 3}
    agc = {"mode": "linear", "low_k": 250, "high_k": 300}
    veldt.write("config.json", {"name": "mine", "seed": 77, "sensor": {"agc": agc}, "clips": [clip]})
    veldt.write("list.json", {"variants": [{"name": "a", "sensor": {"agc": {"high_k": 320}}}]})
    setting = ("--set", "sensor.agc.low_k=255", "sensor.agc.high_k=310")
    _convert(veldt, clips[0], "--config", "config.json", "--variants", "list.json", *setting, "--out", "out")
    config = veldt.read("out/a/dataset.json")["config"]
    assert (config["name"], config["seed"], config["clips"][0]["season"]) == ("mine", 77, "summer")
    assert {key: config["sensor"]["agc"][key] for key in agc} == agc | {"low_k": 255, "high_k": 320}


def test_progress_counts_a_frame_once_for_all_variants(veldt, clips):
    done = veldt("convert", *clips, "--variants", "list.json", "--out", "out", "--progress", "json")
    last = done.err.splitlines()[-1]
    assert last.startswith('{"clip":"two","frames_done":6,"frames_total":6,')


def test_the_example_is_a_list_that_can_be_meant(veldt, clips):
    example = ROOT / "configs" / "variants_example.json"
    _convert(veldt, clips[0], "--variants", example, "--out", "out")
    names = [variant["name"] for variant in veldt.read(example)["variants"]]
    assert sorted(folder.name for folder in (veldt.folder / "out").iterdir()) == sorted(names)


# --- the same again ---------------------------------------------------------------------------------------------------


def test_finished_variants_are_left_alone(veldt, clips):
    run = ("convert", *clips, "--variants", "list.json", "--out", "out")
    assert veldt(*run, "--quiet").code == 0
    times = _times(veldt.folder / "out")
    done = veldt(*run)
    expected = "".join(f"out/{name}: nothing to do, 2 clips already existed\n" for name in NAMES)
    assert (done.code, done.out, done.err) == (0, expected, "")
    assert _times(veldt.folder / "out") == times


def test_another_list_adds_variants(veldt, clips):
    veldt.write("list.json", _list("plain"))
    _convert(veldt, *clips, "--variants", "list.json", "--out", "out")
    times = _times(veldt.folder / "out" / "plain")
    veldt.write("list.json", _list("summer", "plain"))
    done = veldt("convert", *clips, "--variants", "list.json", "--out", "out", "--progress", "none")
    assert done.out == (
        "out/summer: 2 clips made, 6 frames\nout/plain: nothing to do, 2 clips already existed\n"
    )
    assert _times(veldt.folder / "out" / "plain") == times


def test_another_clip_is_another_config(veldt, clips):
    _convert(veldt, clips[0], "--variants", "list.json", "--out", "out")
    done = veldt("convert", *clips, "--variants", "list.json", "--out", "out")
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("veldt: out/plain holds a dataset made from another config: clips")


def test_a_variant_of_other_settings_is_left_alone(veldt, clips):
    _convert(veldt, *clips, "--variants", "list.json", "--out", "out")
    times = _times(veldt.folder / "out")
    changed = _list("plain", "summer")
    changed["variants"][1]["seed"] = 4
    veldt.write("list.json", changed)
    done = veldt("convert", *clips, "--variants", "list.json", "--out", "out")
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        "veldt: out/summer holds a dataset made from another config: seed is 4 here and 3 there;"
        " expected the same config, or another folder\n"
    )
    assert _times(veldt.folder / "out") == times


# --- killed, in use, spoilt -------------------------------------------------------------------------------------------


def test_killed_it_goes_on_to_the_same_datasets(veldt, gate):
    folders = [passes.write_clip(veldt.folder / clip, clip, 12) for clip in ("one", "two")]
    veldt.write("list.json", _list("plain", "summer"))
    run = ("convert", *folders, "--variants", "list.json")
    assert veldt(*run, "--out", "undisturbed", "--quiet").code == 0
    before = "out/summer/clips/two.part/ir16/000006.png"
    started = gate.start(veldt, before, *run, "--out", "out", "--progress", "none")
    started.kill()
    started.communicate()
    assert started.returncode == -signal.SIGKILL
    assert not (veldt.folder / "out" / "plain" / "clips" / "two").exists()
    for name in ("plain", "summer"):
        lines = veldt("validate", f"out/{name}").out.splitlines()
        assert lines[:2] == [
            f"out/{name}/clips/two: not made yet (status pending)",
            f"out/{name}/annotations.json: may lack clips (a run has not ended, or was killed)",
        ]
    done = veldt(*run, "--out", "out", "--progress", "none")
    assert done.out == "".join(
        f"out/{name}: 1 clip made, 12 frames; 1 already existed\n" for name in ("plain", "summer")
    )
    for name in ("plain", "summer"):
        assert veldt.pixels(f"out/{name}") == veldt.pixels(f"undisturbed/{name}")
        assert veldt("validate", f"out/{name}").code == 0


def test_a_clip_that_cannot_be_converted_is_named_for_each_variant(veldt, clips):
    veldt.write("list.json", _list("plain", "summer"))
    for frame in range(passes.FRAMES):
        passes.change_index(clips[1], frame, -7)
    done = veldt("convert", "one", "two", "--variants", "list.json", "--out", "out", "--progress", "none")
    why = (
        f"clip two rejected: two/000000.exr: {passes.OBJECTS} at pixel (3, 2) = -7;"
        " expected a whole number from 0 to 32767; its 2 other frames cannot be converted either"
    )
    assert done.code == 3
    assert done.err == f"veldt: plain: {why}\nveldt: summer: {why}\n"
    assert done.out == "".join(
        f"out/{name}: 1 clip made, 3 frames; the dataset is not complete yet\n"
        for name in ("plain", "summer")
    )
    for name in ("plain", "summer"):
        assert [folder.name for folder in (veldt.folder / "out" / name / "clips").iterdir()] == ["one"]
        assert veldt.read(f"out/{name}/dataset.json")["clips"][1]["status"] == "failed"
    for frame in range(passes.FRAMES):
        passes.change_index(clips[1], frame, passes.GROUND)
    _convert(veldt, "one", "two", "--variants", "list.json", "--out", "out")
    assert veldt("validate", "out/summer").code == 0


def test_nothing_converted_is_a_failure(veldt, clips):
    veldt.write("list.json", _list("plain", "summer"))
    for frame in range(passes.FRAMES):
        passes.change_index(clips[0], frame, -7)
    done = veldt("convert", "one", "--variants", "list.json", "--out", "out", "--quiet")
    assert (done.code, done.err.count(": clip one rejected: one/000000.exr: ")) == (1, 2)


def test_a_variant_in_use_is_turned_away(veldt, clips):
    (veldt.folder / "out" / "summer").mkdir(parents=True)
    with open(veldt.folder / "out" / "summer" / ".lock", "w", encoding="utf-8") as lock:
        fcntl.lockf(lock, fcntl.LOCK_EX)  # as another run of veldt holds it
        done = veldt("convert", *clips, "--variants", "list.json", "--out", "out")
    assert (done.code, done.out) == (75, "")
    assert done.err == (
        "veldt: out/summer is in use by another run of veldt; try again when that one has ended\n"
    )
    assert files_below(veldt.folder / "out") == ["plain/.lock", "summer/.lock"]


# --- requests that cannot be meant ------------------------------------------------------------------------------------

FIRST, SECOND = "list.json: variants[0] (a)", "list.json: variants[1] (b)"
REQUESTS = {
    "unknown key of a sensor": (
        [{"name": "a"}, {"name": "b", "sensor": {"agc": {"mod": "plateau"}}}],
        f'{SECOND}: sensor.agc.mod is not a known key; expected one of {{agc}}; did you mean "mode"?',
    ),
    "value out of range": (
        [{"name": "a", "weather": {"air_temperature_k": 20}}],
        f"{FIRST}: weather.air_temperature_k = 20 K; expected at least 233 and at most 323 K",
    ),
    "unknown preset": (
        [{"name": "a", "sensor": {"preset": "boson"}}],
        f'{FIRST}: sensor.preset = "boson"; expected one of {{presets}}',
    ),
    "negative seed": (
        [{"name": "a", "seed": -1}],
        f"{FIRST}: seed = -1; expected at least 0 and at most 4294967295",
    ),
    "size of the picture": (
        [{"name": "a", "camera": {"width_px": 320}}],
        "list.json: variants[0].camera.width_px is not a known key; expected one of distortion",
    ),
    "name twice": (
        [{"name": "a"}, {"name": "a", "seed": 2}],
        'list.json: variants[1].name = "a"; expected each name once',
    ),
    "name that leaves the folder": (
        [{"name": "../a"}],
        'list.json: variants[0].name = "../a"; expected 1 to 200 letters, digits, _ or -, not beginning with -',
    ),
    "none": ([], "list.json: variants = a list of 0; expected at least 1 entries"),
}


@pytest.mark.parametrize("name", REQUESTS)
def test_a_list_that_cannot_be_meant(veldt, clips, name):
    variants, message = REQUESTS[name]
    veldt.write("list.json", {"variants": variants})
    schema = veldt.read(ROOT / "configs" / "schema" / "config.schema.json")["properties"]["sensor"]
    agc = ", ".join(schema["properties"]["agc"]["properties"])
    presets = ", ".join(sorted(file.stem for file in (ROOT / "assets" / "sensors").glob("*.json")))
    done = veldt("convert", *clips, "--variants", "list.json", "--out", "out")
    assert done.err == f"veldt: {message.format(agc=agc, presets=presets)}\n"
    assert (done.code, done.out) == (2, "")
    assert not (veldt.folder / "out").exists()


def test_a_list_that_is_missing(veldt, clips):
    done = veldt("convert", *clips, "--variants", "none.json", "--out", "out")
    assert (done.code, done.err) == (2, "veldt: cannot read none.json: No such file or directory\n")


def test_a_fault_of_the_config_is_not_put_down_to_a_variant(veldt, clips):
    done = veldt("convert", *clips, "--variants", "list.json", "--set", "seed=-1", "--out", "out")
    assert (done.code, done.err) == (
        2,
        "veldt: --set: seed = -1; expected at least 0 and at most 4294967295\n",
    )


def test_a_lens_that_the_passes_do_not_reach_is_put_down_to_its_variant(veldt, clips):
    bent = {"name": "b", "camera": {"distortion": {"k1": -0.1}}}
    veldt.write("list.json", {"variants": [{"name": "a"}, bent]})
    done = veldt("convert", *clips, "--variants", "list.json", "--out", "out", "--quiet")
    assert done.code == 2
    assert done.err.startswith(f"veldt: {SECOND}: clip one: overscan_px = 0 px; expected at least ")


def test_datasets_do_not_go_into_a_dataset(veldt, clips):
    _convert(veldt, *clips, "--out", "out")
    before = files_below(veldt.folder / "out")
    done = veldt("convert", *clips, "--variants", "list.json", "--out", "out")
    assert (done.code, done.out) == (2, "")
    assert (
        done.err
        == "veldt: --out = out; expected a folder that is not a dataset, to hold those of --variants\n"
    )
    assert files_below(veldt.folder / "out") == before
