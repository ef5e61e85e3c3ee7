"""`convert` turns passes into the canonical dataset: correct pixels and labels, complete or not at all."""

import re
import shutil
import signal

import numpy as np
import pytest

import passes
from labels import check_labels
from pictures import read_grey, write_exr
from processes import PATIENCE_S, interrupt
from program import ROOT, files_below

IDEAL = ["sensor.optics.blur_sigma_px=0", "sensor.noise.amount=0"]


@pytest.fixture(name="clips")
def _clips(veldt):
    """Passes of two clips, in the folders one and two."""
    return [passes.write_clip(veldt.folder / clip, clip) for clip in ("one", "two")]


def _convert(veldt, *arguments):
    done = veldt("convert", *arguments, "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")


# --- what is made -----------------------------------------------------------------------------------------------------


def test_the_dataset_is_laid_out_as_documented(veldt, clips):
    done = veldt("convert", *clips, "--out", "out", "--progress", "none")
    assert (done.code, done.out, done.err) == (0, "out: 2 clips made, 6 frames\n", "")
    pictures = [f"{kind}/{k:06d}.png" for kind in ("ir8", "ir16") for k in range(3)]
    of_a_clip = ["clip.json", "frames.jsonl", "labels.json", "preview.mp4", *pictures]
    expected = [f"clips/{clip}/{name}" for clip in ("one", "two") for name in of_a_clip]
    assert files_below(veldt.folder / "out") == sorted(
        [".lock", "annotations.json", "dataset.json", *expected]
    )
    assert (veldt("validate", "out").code, veldt("validate", "out").err) == (0, "")


def test_dataset_json_describes_the_dataset(veldt, clips):
    _convert(
        veldt, *clips, "--out", "out", "--set", "season=summer", "sensor.optics.blur_sigma_px=0.5", "seed=9"
    )
    index = veldt.read("out/dataset.json")
    assert (index["status"], index["frames"], index["annotations"]) == ("complete", 6, 12)
    assert [(clip["id"], clip["status"], clip["season"]) for clip in index["clips"]] == [
        ("one", "done", "summer"),
        ("two", "done", "summer"),
    ]
    config = index["config"]
    assert (config["name"], config["seed"], config["sensor"]["optics"]["blur_sigma_px"]) == (
        "made_up",
        9,
        0.5,
    )


def test_labels_are_exactly_the_actors_pixels(veldt, clips):
    _convert(veldt, *clips, "--out", "out")
    planes = {
        f"clips/{clip}/ir8/{k:06d}.png": passes.object_index(k) for clip in ("one", "two") for k in range(3)
    }
    manifests = {clip: passes.manifest(clip) for clip in ("one", "two")}
    assert check_labels(veldt.read("out/annotations.json"), planes, manifests) == 12


def test_a_label_reads_as_documented(veldt, clips):
    _convert(veldt, clips[0], "--out", "out")
    document = veldt.read("out/annotations.json")
    categories = {category["id"]: category["name"] for category in document["categories"]}
    walker = next(a for a in document["annotations"] if a["track_id"] == 7)
    cow = next(a for a in document["annotations"] if a["track_id"] == 9)
    assert (walker["bbox"], walker["area"], walker["truncated"]) == ([8.0, 5.0, 2.0, 4.0], 6, False)
    assert (cow["bbox"], cow["area"], cow["truncated"]) == ([0.0, 10.0, 5.0, 4.0], 20, True)
    assert [categories[a["category_id"]] for a in (walker, cow)] == ["human", "elephant"]
    assert document["images"][1] == {
        "id": 2,
        "file_name": "clips/one/ir8/000001.png",
        "width": 24,
        "height": 16,
        "video_id": 1,
        "frame_index": 1,
        "time_s": 1 / 9,
        "ffc": False,
    }


@pytest.mark.parametrize("season", ["winter", "summer"])
def test_16_bit_frames_are_the_materials_apparent_temperatures(veldt, clips, season):
    """The frames of an ideal sensor hold the apparent temperature that `radiance` computes for a material."""
    _convert(veldt, clips[0], "--out", "out", "--set", f"season={season}", *IDEAL)
    step_k = veldt.read("out/dataset.json")["kelvin_per_count"]
    frame = read_grey(veldt.folder / "out" / "clips" / "one" / "ir16" / "000000.png")
    index = passes.object_index(0)
    pairs = {
        0: "sky",
        passes.GROUND: "soil",
        passes.SHRUB: "shrub",
        passes.WALKER: "human",
        passes.ELEPHANT: "elephant",
    }
    for number, name in pairs.items():
        material = veldt.read(ROOT / "assets" / "materials" / f"{name}.json")
        asked = ["--temperature-k", material[f"{season}_k"], "--emissivity", material["emissivity"], "--json"]
        radiance = veldt("radiance", *asked).json()["values"][0]["radiance_w_m2_sr"]
        apparent_k = veldt("radiance", "--radiance", radiance, "--json").json()["values"][0]["temperature_k"]
        counts = np.unique(frame[index == number])
        assert len(counts) == 1
        # Half a count of rounding; radiance is stored as float32, 6e-8 of it: 5e-6 K, or 5e-4 counts.
        assert abs(counts[0] - apparent_k / step_k) <= 0.501


def test_the_brightest_material_is_255_in_8_bits(veldt, clips):
    _convert(veldt, clips[0], "--out", "out", "--set", *IDEAL)
    frame = read_grey(veldt.folder / "out" / "clips" / "one" / "ir8" / "000000.png")
    index = passes.object_index(0)
    assert set(frame[index == passes.WALKER]) == {255}
    assert frame[index == passes.ELEPHANT].max() < 255
    assert frame[index == 0].max() < frame[index == passes.GROUND].min()


def test_a_config_gives_season_seed_and_sensor(veldt, clips):
    flight = {"pattern": "zigzag", "area_m": [0, 0, 1, 1]}
    clip = {"id": "one", "season": "summer", "frames": 3, "flight": flight}
    config = {
        "name": "by_config",
        "seed": 77,
        "sensor": {"optics": {"blur_sigma_px": 0}},
        "clips": [clip, clip | {"id": "other"}],
    }
    veldt.write("config.json", config)
    _convert(veldt, clips[0], "--out", "out", "--config", "config.json")
    index = veldt.read("out/dataset.json")
    assert (index["status"], [c["id"] for c in index["clips"]]) == ("complete", ["one"])
    assert (index["config"]["seed"], index["clips"][0]["season"]) == (77, "summer")
    assert index["config"]["sensor"]["optics"]["blur_sigma_px"] == 0


def test_a_manifest_may_lie_elsewhere(veldt, clips):
    shutil.move(clips[0] / "manifest.json", veldt.folder / "elsewhere.json")
    _convert(veldt, clips[0], "--out", "out", "--manifest", "elsewhere.json")
    _convert(veldt, passes.write_clip(veldt.folder / "whole"), "--out", "usual")
    assert veldt.pixels("out") == veldt.pixels("usual")


@pytest.mark.parametrize(
    "channel",
    [
        "ViewLayer.IndexOB.X",
        "View Layer.IndexOB.X",
        "RenderLayer.IndexOB.X",
        "Scene.Object Index.X",
        "IndexOB",
        "IndexOB.V",
    ],
)
def test_other_renderers_spellings_are_read(veldt, clips, channel):
    for frame in range(passes.FRAMES):
        write_exr(clips[0] / f"{frame:06d}.exr", {channel: passes.object_index(frame)})
    _convert(veldt, clips[0], "--out", "out")
    _convert(veldt, passes.write_clip(veldt.folder / "usual"), "--out", "same")
    assert veldt.pixels("out") == veldt.pixels("same")


# --- the same again ---------------------------------------------------------------------------------------------------


def test_neither_threads_nor_other_clips_change_pixels(veldt, clips):
    _convert(veldt, *clips, "--out", "both", "--threads", "1")
    _convert(veldt, *clips, "--out", "again", "--threads", "2")
    assert veldt.pixels("again") == veldt.pixels("both")
    assert (veldt.folder / "again" / "annotations.json").read_bytes() == (
        veldt.folder / "both" / "annotations.json"
    ).read_bytes()
    _convert(veldt, clips[1], "--out", "alone")
    assert veldt.pixels("alone")["two"] == veldt.pixels("both")["two"]
    assert veldt.pixels("both")["one"] != veldt.pixels("both")["two"]  # each clip has noise of its own


def test_seed_and_sensor_change_pixels(veldt, clips):
    _convert(veldt, clips[0], "--out", "out")
    for setting in ("seed=6", "season=summer", "sensor.optics.blur_sigma_px=0.5"):
        _convert(veldt, clips[0], "--out", setting, "--set", setting)
        assert veldt.pixels(setting) != veldt.pixels("out")


def test_a_finished_dataset_is_left_alone(veldt, clips):
    _convert(veldt, *clips, "--out", "out")
    times = {file: file.stat().st_mtime_ns for file in (veldt.folder / "out").rglob("*")}
    done = veldt("convert", *clips, "--out", "out")
    assert (done.code, done.err) == (0, "")
    assert done.out == "out: nothing to do, 2 clips already existed\n"
    assert {file: file.stat().st_mtime_ns for file in (veldt.folder / "out").rglob("*")} == times


def test_progress_in_json_counts_every_frame(veldt, clips):
    done = veldt("convert", *clips, "--out", "out", "--progress", "json", "--threads", "1")
    matches = [
        re.match(r'{"clip":"(\w+)","frames_done":(\d),"frames_total":6,', line)
        for line in done.err.splitlines()
    ]
    assert [match.groups() for match in matches] == [
        *(("one", str(k)) for k in range(4)),
        *(("two", str(k)) for k in range(3, 7)),
    ]


# --- killed -----------------------------------------------------------------------------------------------------------


MOMENTS = {  # the path before which it is held, and the clips that are whole by then
    "before the first clip": ("out/clips/one.part/ir8", []),
    "in the first clip": ("out/clips/one.part/ir16/000006.png", []),
    "between the clips": ("out/clips/two.part/ir8", ["one"]),
    "in the second clip": ("out/clips/two.part/ir16/000006.png", ["one"]),
    "before the second clip is whole": ("out/clips/two.part/clip.json", ["one"]),
    "at the end": ("out/annotations.json.tmp", ["one", "two"]),
}


@pytest.mark.parametrize("moment", MOMENTS)
def test_killed_at_any_moment_it_goes_on_to_the_same_dataset(veldt, gate, moment):
    folders = [passes.write_clip(veldt.folder / clip, clip, 12) for clip in ("one", "two")]
    _convert(veldt, *folders, "--out", "undisturbed")
    before, whole = MOMENTS[moment]
    run = gate.start(veldt, before, "convert", *folders, "--out", "out", "--progress", "none")
    run.kill()
    run.communicate()
    assert run.returncode == -signal.SIGKILL
    assert [clip for clip in ("one", "two") if (veldt.folder / "out" / "clips" / clip).exists()] == whole
    _convert(veldt, *folders, "--out", "out")
    assert veldt.pixels("out") == veldt.pixels("undisturbed")
    assert files_below(veldt.folder / "out") == files_below(veldt.folder / "undisturbed")
    assert veldt("validate", "out").code == 0


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_asked_to_stop_it_says_so_and_goes_on_later(veldt, gate, number):
    folder = passes.write_clip(veldt.folder / "one", frames=40)
    before = "out/clips/one.part/ir16/000003.png"
    run = gate.start(veldt, before, "convert", folder, "--out", "out", "--progress", "none")
    interrupt(run.pid, number)
    gate.open()
    out, err = run.communicate(timeout=PATIENCE_S)
    assert (run.returncode, out) == (128 + number, "")
    assert err == "veldt: stopped on request; run the same command again to resume\n"
    assert not (veldt.folder / "out" / "clips" / "one").exists()
    _convert(veldt, folder, "--out", "out")
