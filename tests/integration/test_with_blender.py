"""`generate` with a real Blender: the same pixels every time, even after interruptions."""

import json
import os
import re
import shutil
import signal
import subprocess

import pytest

from configs import CLIPS, FRAMES, tiny
from datasets import content_of
from processes import PATIENCE_S, running_with, wait_until
from program import ROOT, Veldt

IN_WORDS = "; unless someone killed it, the machine may have run out of memory; log: "


@pytest.fixture(scope="module", name="usual")
def _usual(tmp_path_factory, blender) -> Veldt:
    """A place with the dataset of an undisturbed run, its passes kept."""
    veldt = Veldt(tmp_path_factory.mktemp("usual"))
    veldt.write("config.json", tiny())
    done = veldt("generate", "config.json", "--out", "out", "--keep-passes", "--quiet", "--blender", blender)
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt


@pytest.fixture(name="command")
def _command(veldt, blender) -> list[str]:
    """The arguments of the same run in a separate folder; its full path identifies its processes."""
    veldt.write("config.json", tiny())
    return ["generate", "config.json", "--out", str(veldt.folder / "out"), "--blender", blender]


def _complete(veldt, command, usual) -> None:
    """Run to the end and compare with the undisturbed run."""
    done = veldt(*command, "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    _check_same(veldt, "out", usual)


def _check_same(veldt, out, usual) -> None:
    """Check that a dataset has the pixels, the labels and the records of the undisturbed run's."""
    assert veldt.pixels(out) == usual.pixels("out")
    usual_files = content_of(usual.folder / "out")
    made = content_of(veldt.folder / out)
    assert made == {name: content for name, content in usual_files.items() if not name.startswith("passes/")}
    assert veldt("validate", out).code == 0


# What its progress says, and the file before which Blender is held.
MOMENTS = {
    "building the scene": ({"clip": "down", "frames_done": 0}, "/scene.bin"),
    "in the first clip": ({"clip": "down", "frames_done": 3}, "/down/000005.exr"),
    "between the clips": ({"clip": "side", "frames_done": FRAMES}, "/side/000000.exr"),
    "in the second clip": ({"clip": "side", "frames_done": FRAMES + 3}, "/side/000005.exr"),
}


def _held(veldt, command, gate, moment) -> subprocess.Popen:
    """A run whose Blender is held at a moment, which its progress has reached."""
    said, before = moment
    *arguments, blender = command
    run = veldt.start(*arguments, gate.around(blender, before), "--progress", "json")
    gate.wait_for(run)
    for line in run.stderr:
        if said.items() <= json.loads(line).items():
            return run
    raise AssertionError(f"the run ended before {moment}: {run.communicate()}")


# --- the same again ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("threads", [1, 2])
def test_again_and_whatever_the_threads(veldt, command, usual, threads):
    _complete(veldt, [*command, "--threads", str(threads)], usual)


@pytest.mark.parametrize("threads", [1, 2])
def test_two_at_a_time_make_the_same(veldt, command, usual, threads):
    _complete(veldt, [*command, "--jobs", "2", "--threads", str(threads)], usual)


def test_a_finished_dataset_is_left_alone_and_starts_no_blender(usual, blender):
    times = {file: file.stat().st_mtime_ns for file in (usual.folder / "out" / "clips").rglob("*")}
    done = usual("generate", "config.json", "--out", "out", "--keep-passes", "--blender", blender)
    assert (done.code, done.err) == (0, "")
    assert done.out == "out: nothing to do, 2 clips already existed\n"
    assert {file: file.stat().st_mtime_ns for file in (usual.folder / "out" / "clips").rglob("*")} == times


def test_kept_passes_convert_to_the_same_pixels(usual):
    folders = [f"out/passes/{clip}" for clip in CLIPS]
    done = usual("convert", *folders, "--out", "converted", "--config", "config.json", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    assert usual.pixels("converted") == usual.pixels("out")


def test_shards_into_one_folder_make_the_undivided_dataset(veldt, command, usual):
    done = veldt(*command, "--shard", "0/2", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    assert [clip["status"] for clip in veldt.read("out/dataset.json")["clips"]] == ["done", "pending"]
    _complete(veldt, [*command, "--shard", "1/2"], usual)


def test_shards_at_the_same_time_into_one_folder(veldt, command, usual):
    runs = [veldt.start(*command, "--shard", f"{k}/2", "--quiet") for k in range(2)]
    assert [run.communicate() for run in runs] == [("", ""), ("", "")]
    _check_same(veldt, "out", usual)


def test_shards_merged_make_the_undivided_dataset(veldt, command, usual, blender):
    shards = [f"shard_{k}" for k in range(3)]
    for k, shard in enumerate(shards):
        run = ["generate", "config.json", "--out", shard, "--blender", blender, "--quiet"]
        done = veldt(*run, "--shard", f"{k}/3")
        assert (done.code, done.out, done.err) == (0, "", "")
    done = veldt("merge", *shards, "--out", "out", "--progress", "none")
    assert (done.code, done.err) == (0, "")
    assert done.out == "out: 2 clips merged, 16 frames\n"
    done = veldt(*command)  # plans, and finds all clips
    assert done.out == f"{veldt.folder}/out: nothing to do, 2 clips already existed\n"
    _check_same(veldt, "out", usual)


# --- disturbed --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("moment", MOMENTS)
def test_killed_at_any_moment_it_goes_on_to_the_same_dataset(veldt, command, usual, gate, moment):
    run = _held(veldt, command, gate, MOMENTS[moment])
    run.kill()
    run.communicate()
    assert run.returncode == -signal.SIGKILL
    assert wait_until(
        lambda: not running_with(veldt.folder / "out")
    )  # Blender, which was held, has ended, too
    assert veldt.read("out/dataset.json")["status"] == "unfinished"
    _complete(veldt, command, usual)


def test_killed_again_and_again(veldt, command, usual, gate):
    """After 2 frames, 5 frames, the first clip and 1 frame, and 3 of the remaining frames."""
    moments = [(2, "/down/000003.exr"), (5, "/down/000006.exr"), (FRAMES + 1, "/side/000002.exr")]
    for frames_done, before in [*moments, (3, "/side/000005.exr")]:
        run = _held(veldt, command, gate, ({"frames_done": frames_done}, before))
        run.kill()
        run.communicate()
        gate.open()
    assert (veldt.folder / "out" / "clips" / "down").exists()
    _complete(veldt, command, usual)


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("moment", ["building the scene", "in the first clip"])
def test_a_killed_blender_is_started_again(veldt, command, usual, gate, moment, jobs):
    *arguments, blender = command
    around = gate.around(blender, MOMENTS[moment][1])
    run = veldt.start(*arguments, around, "--jobs", jobs, "--progress", "json")
    gate.wait_for(run)
    os.kill(gate.held(), signal.SIGKILL)
    gate.open()
    out, err = run.communicate(timeout=PATIENCE_S)
    assert (run.returncode, out) == (0, f"{veldt.folder}/out: 2 clips made, 16 frames\n")
    (restart,) = [event for event in map(json.loads, err.splitlines()) if "event" in event]
    assert restart["event"] == "restart" and restart["clip"] in CLIPS
    doing = r"(building the scene|rendering clip (down|side)( after frame \d)?)"
    log = rf"{veldt.folder}/out/passes/(down|side)\.log"
    assert re.fullmatch(
        rf"Blender was killed by signal 9 \(Killed\) while {doing}{IN_WORDS}{log}", restart["reason"]
    )
    _check_same(veldt, "out", usual)


@pytest.mark.parametrize("moment", ["building the scene", "in the second clip"])
def test_ctrl_c_stops_blender_too(veldt, command, usual, gate, moment):
    run = _held(veldt, command, gate, MOMENTS[moment])
    os.kill(run.pid, signal.SIGINT)
    out, err = run.communicate(timeout=PATIENCE_S)  # less than Blender is held
    assert (run.returncode, out) == (130, "")
    assert err.splitlines()[-1] == "veldt: stopped on request; run the same command again to resume"
    assert not running_with(veldt.folder / "out")
    _complete(veldt, command, usual)


def test_a_second_run_in_the_same_folder_is_turned_away(veldt, command, usual, gate):
    run = _held(veldt, command, gate, MOMENTS["building the scene"])
    second = veldt(*command)
    assert (second.code, second.out) == (75, "")
    assert second.err == (
        f"veldt: {veldt.folder}/out is in use by another run of veldt; try again when that one has ended\n"
    )
    gate.open()
    assert run.communicate()[0] == f"{veldt.folder}/out: 2 clips made, 16 frames\n"
    assert veldt.pixels("out") == usual.pixels("out")


# --- Blender's own faults ---------------------------------------------------------------------------------------------


def test_a_fault_in_the_scripts_is_one_line_that_names_its_place(veldt, command):
    """Blender's full output stays in the log."""
    for part in ("assets", "blender_scripts", "configs"):
        shutil.copytree(ROOT / part, veldt.folder / "home" / part)
    script = veldt.folder / "home" / "blender_scripts" / "veldt_bl" / "render.py"
    lines = script.read_text().splitlines()
    body = next(k for k, line in enumerate(lines) if line.startswith("    scene = bpy.context.scene"))
    lines[body] = '    raise RuntimeError("no such pass: heat")'
    script.write_text("\n".join(lines))
    done = veldt(*command, "--progress", "none", env={"VELDT_HOME": str(veldt.folder / "home")})
    assert done.code == 1
    why = f"RuntimeError: no such pass: heat (blender_scripts/veldt_bl/render.py:{body + 1})"
    log = f"{veldt.folder}/out/passes/down.log"
    assert done.err == "".join(
        f"veldt: clip {clip} failed: Blender failed while rendering clip {clip}: {why}; log: {log}\n"
        for clip in ("down", "side")
    )
    assert "Traceback" in (veldt.folder / "out" / "passes" / "down.log").read_text()


def test_a_file_in_the_way_of_the_passes_is_named(veldt, command, usual):
    (veldt.folder / "out" / "passes").mkdir(parents=True)
    veldt.write("out/passes/side", "a file where the clip's folder should be")
    done = veldt(*command, "--progress", "none")
    assert (done.code, done.out) == (1, "")
    assert done.err == f"veldt: cannot make folder {veldt.folder}/out/passes/side: Not a directory\n"
    (veldt.folder / "out" / "passes" / "side").unlink()
    _complete(veldt, command, usual)
