"""`generate` from start to end with a stand-in for Blender, so that a run can be stopped or killed at every stage.

tests/integration does the same with a real one.
"""

import json
import os
import signal

import pytest

import fake_blender
from configs import CLIPS, FRAMES, tiny
from datasets import content_of
from processes import PATIENCE_S, running_with, wait_until
from program import Veldt, files_below

pytestmark = pytest.mark.usefixtures("planned")


def _run(veldt, *options, command="generate") -> list[str]:
    """The arguments of a run; the full path of its folder distinguishes its processes from those of other tests."""
    blender, out = veldt.folder / "fake_blender", veldt.folder / "out"
    silent = [] if "--progress" in options else ["--progress", "none"]
    return [command, "config.json", "--out", str(out), "--blender", str(blender), *silent, *options]


def _generate(veldt, *options, command="generate"):
    done = veldt(*_run(veldt, *options, "--quiet", command=command))
    assert (done.code, done.out, done.err) == (0, "", "")


@pytest.fixture(scope="module", name="usual")
def _usual(tmp_path_factory) -> Veldt:
    """A place with the dataset of an undisturbed run."""
    veldt = Veldt(tmp_path_factory.mktemp("usual"))
    _prepare(veldt)
    done = veldt(*_run(veldt))
    assert (done.code, done.out, done.err) == (0, f"{veldt.folder}/out: 2 clips made, 16 frames\n", "")
    return veldt


@pytest.fixture(autouse=True)
def _ready(veldt):
    _prepare(veldt)


def _prepare(veldt):
    """Lay out the config and the stand-in for Blender."""
    fake_blender.install(veldt.folder)
    veldt.write("config.json", tiny())


def _has_renderer(veldt) -> bool:
    return bool(running_with(veldt.folder / "out" / "passes"))


def _frames_of(folder) -> int:
    return len(list(folder.glob("*.png")))


# --- what is made -----------------------------------------------------------------------------------------------------


def test_the_dataset_is_laid_out_as_documented(usual):
    pictures = [f"{kind}/{k:06d}.png" for kind in ("ir8", "ir16") for k in range(FRAMES)]
    of_a_clip = ["clip.json", "frames.jsonl", "labels.json", "preview.mp4", *pictures]
    expected = [f"clips/{clip}/{name}" for clip in CLIPS for name in of_a_clip]
    baked = ["scene", *(f"tracks/{clip}" for clip in CLIPS)]
    plan = ["plan.json", "checksums.json", *(f"{name}.{kind}" for name in baked for kind in ("json", "bin"))]
    assert files_below(usual.folder / "out") == sorted(
        [".lock", "annotations.json", "dataset.json", *expected, *(f"plan/{name}" for name in plan)]
    )
    assert usual("validate", "out").code == 0
    assert len(set(usual.pixels("out").values())) == 3


def test_a_finished_dataset_is_left_alone(veldt, usual):
    _generate(veldt)
    times = {file: file.stat().st_mtime_ns for file in (veldt.folder / "out").rglob("*")}
    done = veldt(*_run(veldt))
    assert (done.code, done.err) == (0, "")
    assert done.out == f"{veldt.folder}/out: nothing to do, 2 clips already existed\n"
    assert {file: file.stat().st_mtime_ns for file in (veldt.folder / "out").rglob("*")} == times
    assert veldt.pixels("out") == usual.pixels("out")


def test_kept_passes_convert_to_the_same_pixels(veldt, usual):
    _generate(veldt, "--keep-passes")
    kept = [f"{clip}/{name}" for clip in CLIPS for name in ("000000.exr", "000007.exr", "manifest.json")]
    assert set(kept) < set(files_below(veldt.folder / "out" / "passes"))
    folders = [f"out/passes/{clip}" for clip in CLIPS]
    assert veldt("convert", *folders, "--out", "converted", "--config", "config.json", "--quiet").code == 0
    assert veldt.pixels("converted") == usual.pixels("out")


def test_render_makes_passes_that_convert_to_the_same_pixels(veldt, usual):
    _generate(veldt, command="render")
    assert not (veldt.folder / "out" / "clips").exists()
    folders = [f"out/passes/{clip}" for clip in CLIPS]
    assert veldt("convert", *folders, "--out", "converted", "--config", "config.json", "--quiet").code == 0
    assert veldt.pixels("converted") == usual.pixels("out")


@pytest.mark.parametrize("parts", [["--clips", "side"], ["--shard", "1/2"]])
def test_a_part_is_made_and_the_rest_later(veldt, usual, parts):
    done = veldt(*_run(veldt, *parts))
    assert (done.code, done.err) == (0, "")
    assert done.out == f"{veldt.folder}/out: 1 clip made, 8 frames; the dataset is not complete yet\n"
    statuses = {clip["id"]: clip["status"] for clip in veldt.read("out/dataset.json")["clips"]}
    assert statuses == {"down": "pending", "side": "done"}
    assert veldt("validate", "out").out.startswith("out/clips/down: not made yet (status pending)\n")
    assert veldt(*_run(veldt)).out == f"{veldt.folder}/out: 1 clip made, 8 frames; 1 already existed\n"
    assert veldt.pixels("out") == usual.pixels("out")


def test_more_shards_than_clips_leave_some_nothing_to_do(veldt, usual):
    done = veldt(*_run(veldt, "--shard", "2/3"))
    assert (done.code, done.out, done.err) == (
        0,
        f"{veldt.folder}/out: nothing to do, 0 clips already existed\n",
        "",
    )
    for shard in ("0/3", "1/3"):
        _generate(veldt, "--shard", shard)
    assert veldt.pixels("out") == usual.pixels("out")


# --- killed -----------------------------------------------------------------------------------------------------------

MOMENTS = {
    "before the first frame": ("down", -1),
    "in the first clip": ("down", 3),
    "at the end of the first clip": ("down", 7),
    "between the clips": ("side", -1),
    "in the second clip": ("side", 5),
    "at the very end": ("side", 7),
}


def _reached(veldt, clip: str, frame: int) -> bool:
    """Whether a run that is held there has done all it can."""
    if not fake_blender.is_held(veldt.folder):
        return False
    clips = veldt.folder / "out" / "clips"
    if frame == FRAMES - 1:
        return (clips / clip).exists()
    return (clips / f"{clip}.part").exists() and _frames_of(clips / f"{clip}.part" / "ir16") == frame + 1


@pytest.mark.parametrize("moment", MOMENTS)
def test_killed_at_any_moment_it_goes_on_to_the_same_dataset(veldt, usual, moment):
    fake_blender.hold_after(veldt.folder, *MOMENTS[moment])
    run = veldt.start(*_run(veldt))
    assert wait_until(lambda: _reached(veldt, *MOMENTS[moment]))
    assert _has_renderer(veldt)
    run.kill()
    assert run.communicate() == ("", "")
    assert run.returncode == -signal.SIGKILL
    assert wait_until(lambda: not _has_renderer(veldt))  # which is held, and ends with its parent process
    _generate(veldt)
    assert veldt.pixels("out") == usual.pixels("out")
    assert files_below(veldt.folder / "out") == files_below(usual.folder / "out")
    assert (veldt.folder / "out" / "annotations.json").read_bytes() == (
        usual.folder / "out" / "annotations.json"
    ).read_bytes()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_asked_to_stop_it_stops_the_renderer_and_goes_on_later(veldt, usual, number):
    fake_blender.hold_after(veldt.folder, "side", 2)
    run = veldt.start(*_run(veldt))
    assert wait_until(lambda: _reached(veldt, "side", 2))
    os.kill(run.pid, number)
    out, err = run.communicate(timeout=PATIENCE_S)  # less than the renderer is held
    assert (run.returncode, out) == (128 + number, "")
    assert err == "veldt: stopped on request; run the same command again to resume\n"
    assert not _has_renderer(veldt)
    assert veldt(*_run(veldt)).out == f"{veldt.folder}/out: 1 clip made, 8 frames; 1 already existed\n"
    assert veldt.pixels("out") == usual.pixels("out")


def test_a_second_run_in_the_same_folder_is_turned_away(veldt, usual):
    fake_blender.hold_after(veldt.folder, "down", 3)
    run = veldt.start(*_run(veldt))
    assert wait_until(lambda: _reached(veldt, "down", 3))
    second = veldt(*_run(veldt))
    assert (second.code, second.out) == (75, "")
    assert (
        second.err
        == f"veldt: {veldt.folder}/out is in use by another run of veldt; try again when that one has ended\n"
    )
    run.kill()
    run.communicate()
    _generate(veldt)
    assert veldt.pixels("out") == usual.pixels("out")


def test_a_config_changed_between_kill_and_resume_is_refused(veldt):
    """Even if no clip was finished: the folder belongs to the config that created it."""
    fake_blender.hold_after(veldt.folder, "down", 3)
    run = veldt.start(*_run(veldt))
    assert wait_until(lambda: _reached(veldt, "down", 3))
    run.kill()
    run.communicate()
    veldt.write("config.json", tiny(lambda config: config.update(seed=8)))
    done = veldt(*_run(veldt))
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        f"veldt: {veldt.folder}/out holds a dataset made from another config: seed is 8 here and 7 there;"
        " expected the same config, or another folder\n"
    )


# --- several at a time ------------------------------------------------------------------------------------------------


def _is_like(veldt, usual) -> None:
    """Every file of the two datasets is the same."""
    assert content_of(veldt.folder / "out") == content_of(usual.folder / "out")


@pytest.mark.parametrize("jobs", ["2", "5"])
def test_jobs_make_the_same_dataset(veldt, usual, jobs):
    _generate(veldt, "--jobs", jobs)
    _is_like(veldt, usual)


def test_jobs_render_at_the_same_time_and_share_the_threads(veldt, usual):
    fake_blender.hold_after(veldt.folder, "down", 3)
    run = veldt.start(*_run(veldt, "--jobs", "2", "--threads", "5"))
    assert wait_until((veldt.folder / "out" / "clips" / "side").exists)
    assert wait_until(lambda: _reached(veldt, "down", 3))
    (command,) = [line for line in running_with(veldt.folder / "out" / "passes").values() if "down" in line]
    assert " --threads 2 " in command and " --clip side" not in command
    run.kill()
    run.communicate()
    _generate(veldt, "--jobs", "2")
    _is_like(veldt, usual)


def test_progress_of_jobs_is_of_all_together(veldt):
    done = veldt(*_run(veldt, "--jobs", "2", "--progress", "json"))
    events = [json.loads(line) for line in done.err.splitlines()]
    lines = [event for event in events if "flights_done" not in event]
    assert [line["frames_done"] for line in lines] == sorted(line["frames_done"] for line in lines)
    assert {line["frames_total"] for line in lines} == {2 * FRAMES}
    assert lines[-1]["frames_done"] == 2 * FRAMES
    assert {line["clip"] for line in lines} == set(CLIPS)


def test_jobs_render_the_same_passes(veldt, usual):
    _generate(veldt, "--jobs", "2", command="render")
    folders = [f"out/passes/{clip}" for clip in CLIPS]
    assert veldt("convert", *folders, "--out", "converted", "--config", "config.json", "--quiet").code == 0
    assert veldt.pixels("converted") == usual.pixels("out")


@pytest.mark.parametrize("first", ["0/2", "1/2"])
def test_shards_at_the_same_time_in_one_folder(veldt, usual, first):
    """One is held in its clip while the other begins and ends."""
    clip, second = ("down", "1/2") if first == "0/2" else ("side", "0/2")
    fake_blender.hold_after(veldt.folder, clip, 3)
    run = veldt.start(*_run(veldt, "--shard", first))
    assert wait_until(lambda: _reached(veldt, clip, 3))
    done = veldt(*_run(veldt, "--shard", second))
    assert (done.code, done.err) == (0, "")
    assert done.out == f"{veldt.folder}/out: 1 clip made, 8 frames; the dataset is not complete yet\n"
    assert (veldt.folder / "out" / "passes" / clip / "000003.exr").exists()
    again = veldt(*_run(veldt, "--shard", first))
    assert (again.code, again.out) == (75, "")
    assert " is in use by another run of veldt; try again when that one has ended" in again.err
    run.kill()
    run.communicate()
    _generate(veldt, "--shard", first)
    _is_like(veldt, usual)


def test_the_last_of_two_shards_reports_both(veldt, usual):
    runs = [veldt.start(*_run(veldt, "--shard", shard, "--quiet")) for shard in ("0/2", "1/2")]
    assert [run.communicate() for run in runs] == [("", ""), ("", "")]
    assert [run.returncode for run in runs] == [0, 0]
    _is_like(veldt, usual)


def test_a_conversion_waits_for_no_shard(veldt):
    """Commands that need exclusive access to the folder are rejected, too."""
    fake_blender.hold_after(veldt.folder, "down", 3)
    run = veldt.start(*_run(veldt, "--shard", "0/2"))
    assert wait_until(lambda: _reached(veldt, "down", 3))
    done = veldt(*_run(veldt, "--preview", command="render"))
    assert (done.code, done.out) == (75, "")
    run.kill()
    run.communicate()


# --- a Blender that crashes -------------------------------------------------------------------------------------------

KILLED = "Blender was killed by signal 9 (Killed) while "
IN_WORDS = "; unless someone killed it, the machine may have run out of memory"


def _in_words(veldt, doing: str, log: str = "down") -> str:
    """What a killed Blender is reported with; a Blender that has several clips names its log after the first."""
    return f"{KILLED}{doing}{IN_WORDS}; log: {veldt.folder}/out/passes/{log}.log"


DEATHS = {
    "as it builds the scene": ("scene", -1, "building the scene"),
    "before the first frame": ("down", -1, "rendering clip down"),
    "in the first clip": ("down", 3, "rendering clip down after frame 3"),
    "in the second clip": ("side", 5, "rendering clip side after frame 5"),
}


@pytest.mark.parametrize("moment", DEATHS)
def test_a_crashed_blender_is_restarted(veldt, usual, moment):
    clip, frame, doing = DEATHS[moment]
    fake_blender.die_after(veldt.folder, clip, frame)
    done = veldt(*_run(veldt, "--progress", "plain"))
    assert (done.code, done.out) == (0, f"{veldt.folder}/out: 2 clips made, 16 frames\n")
    reported = "down" if clip == "scene" else clip
    assert f"clip {reported}: {_in_words(veldt, doing)}; restarting Blender\n" in done.err
    _is_like(veldt, usual)


def test_json_progress_reports_a_restart(veldt):
    fake_blender.die_after(veldt.folder, "side", 5)
    done = veldt(*_run(veldt, "--progress", "json"))
    lines = [json.loads(line) for line in done.err.splitlines()]
    assert [line for line in lines if "event" in line] == [
        {
            "event": "restart",
            "clip": "side",
            "reason": _in_words(veldt, "rendering clip side after frame 5"),
        }
    ]
    assert lines[-1]["frames_done"] == 2 * FRAMES


@pytest.mark.parametrize("jobs", ["1", "2"])
@pytest.mark.parametrize("clip, other", [CLIPS, CLIPS[::-1]])
def test_a_clip_that_crashes_blender_twice_fails_alone(veldt, usual, clip, other, jobs):
    fake_blender.die_after(veldt.folder, clip, 3, times=2)
    done = veldt(*_run(veldt, "--jobs", jobs))
    why = _in_words(veldt, f"rendering clip {clip} after frame 4", log=clip if jobs == "2" else "down")
    assert (done.code, done.err) == (3, f"veldt: clip {clip} failed: {why}\n")
    assert done.out == f"{veldt.folder}/out: 1 clip made, 8 frames; the dataset is not complete yet\n"
    entries = {entry["id"]: entry for entry in veldt.read("out/dataset.json")["clips"]}
    assert entries[clip] == {"id": clip, "status": "failed", "reason": why}
    assert entries[other]["status"] == "done"
    assert (veldt.folder / "out" / "passes" / clip / "000004.exr").exists()  # for the next run to go on from
    done = veldt(*_run(veldt))
    assert (done.code, done.err) == (0, "")
    assert done.out == f"{veldt.folder}/out: 1 clip made, 8 frames; 1 already existed\n"
    _is_like(veldt, usual)


def test_other_shards_keep_the_record_of_a_failed_clip(veldt):
    fake_blender.die_after(veldt.folder, "down", 3, times=2)
    veldt(*_run(veldt, "--shard", "0/2"))
    _generate(veldt, "--shard", "1/2")
    statuses = [(entry["id"], entry["status"]) for entry in veldt.read("out/dataset.json")["clips"]]
    assert statuses == [("down", "failed"), ("side", "done")]


def test_a_blender_that_is_always_killed_ends_with_exit_code_75(veldt, usual):
    fake_blender.die_after(veldt.folder, "down", 3, times=2)
    done = veldt(*_run(veldt, "--clips", "down"))
    assert (done.code, done.out) == (
        75,
        f"{veldt.folder}/out: 0 clips made, 0 frames; the dataset is not complete yet\n",
    )
    why = _in_words(veldt, "rendering clip down after frame 4")
    assert done.err == f"veldt: clip down failed: {why}\n"
    _generate(veldt)
    _is_like(veldt, usual)


def test_a_blender_that_cannot_even_build_the_scene_ends_the_run(veldt):
    fake_blender.die_after(veldt.folder, "scene", -1, times=9)
    done = veldt(*_run(veldt))
    assert (done.code, done.out) == (75, "")
    assert done.err == f"veldt: {_in_words(veldt, 'building the scene')}\n"
    assert (veldt.folder / "deaths.txt").stat().st_size == 2


def test_render_loses_a_clip_alone_too(veldt, usual):
    fake_blender.die_after(veldt.folder, "down", 3, times=2)
    done = veldt(*_run(veldt, command="render"))
    assert done.code == 3 and done.err.startswith("veldt: clip down failed: Blender was killed by signal 9")
    _generate(veldt, command="render")
    folders = [f"out/passes/{clip}" for clip in CLIPS]
    assert veldt("convert", *folders, "--out", "converted", "--config", "config.json", "--quiet").code == 0
    assert veldt.pixels("converted") == usual.pixels("out")
