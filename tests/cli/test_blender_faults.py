"""What `generate` reports when Blender fails, in a scene or in a clip, and which clips survive it."""

import shutil
from pathlib import Path

import pytest

from configs import tiny
from fake_blender import generate
from program import ROOT, check_fault

pytestmark = pytest.mark.usefixtures("planned")

LOG = "; log: out/passes/down.log"
KILLED = "; unless someone killed it, the machine may have run out of memory" + LOG
NUMPY = (
    '{"event": "error", "kind": "internal", "message": "ModuleNotFoundError: No module named numpy",'
    ' "where": "blender_scripts/planner/noise.py:8", "hint": "install it"}'
)
BLENDERS = {
    "ends without a word": (
        "exit 0",
        1,
        "Blender ended early while building the scene; it printed nothing" + LOG,
    ),
    "ends early, with words": (
        "echo Saved nothing; exit 0",
        1,
        "Blender ended early while building the scene: Saved nothing" + LOG,
    ),
    "fails without a word": (
        "exit 3",
        1,
        "Blender ended with exit code 3 while building the scene; it printed nothing" + LOG,
    ),
    "fails with a page of log before a script runs": (
        "echo Blender 3.4; echo; echo 'Error: 0 errors' >&2; echo 'Read prefs'; echo 'no memory'; echo Blender quit;"
        " exit 1",
        1,
        "Blender ended with exit code 1 while building the scene: Error: 0 errors / Read prefs / no memory"
        + LOG,
    ),
    "is killed": (
        "kill -9 $$",
        75,
        "Blender was killed by signal 9 (Killed) while building the scene" + KILLED,
    ),
    "is asked to end": (
        "echo Blender 3.4; kill -15 $$",
        75,
        "Blender was killed by signal 15 (Terminated) while building the scene" + LOG,
    ),
    "crashes": (
        "echo Blender 3.4; echo 'Writing: blender.crash.txt'; kill -6 $$",
        75,
        "Blender was killed by signal 6 (Aborted) while building the scene:"
        " Blender 3.4 / Writing: blender.crash.txt" + LOG,
    ),
    "reports a fault of its script": (
        f"echo 'Error: something else'; echo '{NUMPY}' >&3; exit 1",
        1,
        "Blender failed while building the scene: ModuleNotFoundError: No module named numpy"
        " (blender_scripts/planner/noise.py:8); install it" + LOG,
    ),
    "reports a fault of many lines": (
        """printf %s\\\\n '{"event": "error", "kind": "internal", "message": "a\\nb\\u001b[2J"}' >&3; exit 1""",
        1,
        "Blender failed while building the scene: a; b\\x1b[2J" + LOG,
    ),
    "reports a fault of the config": (
        """echo '{"event": "error", "kind": "config", "message": "seed = 0; expected more", "where": "a.py:1"}' >&3
        exit 2""",
        2,
        "seed = 0; expected more",
    ),
    "speaks no JSON": (
        "echo {oops >&3; echo 7 >&3; echo '[\"event\"]' >&3; exit 0",
        1,
        "Blender ended early while building the scene; it printed nothing" + LOG,
    ),
    "sends an event without its fields": (
        """echo '{"event": "clip"}' >&3; exec sleep 3600""",
        1,
        'Blender sent a malformed event while building the scene: {"event": "clip"}' + LOG,
    ),
    "sends an event of another type": (
        """echo '{"event": 7}' >&3; exec sleep 3600""",
        1,
        'Blender sent a malformed event while building the scene: {"event": 7}' + LOG,
    ),
}


@pytest.mark.parametrize("name", BLENDERS)
def test_a_blender_that_fails_before_there_is_a_scene_ends_the_run(veldt, blender, name):
    script, code, message = BLENDERS[name]
    good = blender.read_text()
    blender.write_text(f"#!/bin/sh\n{script}\n")
    done = generate(veldt, blender, "--progress", "none")
    check_fault(done, code, message)
    assert not (veldt.folder / "out" / "clips" / "down").exists()
    blender.write_text(good)
    assert generate(veldt, blender).code == 0  # and the same command goes on from there


BUILT = """echo '{"event": "scene_built"}' >&3; """
FAILING_IN_CLIPS = {
    "is killed in each clip": (
        "kill -9 $$",
        75,
        "Blender was killed by signal 9 (Killed) while rendering clip {clip}" + KILLED,
    ),
    "crashes in each clip": (
        "kill -11 $$",
        75,
        "Blender was killed by signal 11 (Segmentation fault) while rendering clip {clip}; it printed nothing"
        + LOG,
    ),
    "reports a fault of its script": (
        """echo '{"event": "error", "kind": "internal", "message": "no mesh", "where": "render.py:12"}' >&3; exit 1""",
        1,
        "Blender failed while rendering clip {clip}: no mesh (render.py:12)" + LOG,
    ),
}


@pytest.mark.parametrize("name", FAILING_IN_CLIPS)
def test_a_blender_that_fails_in_every_clip_is_reported_for_each(veldt, blender, name):
    script, code, message = FAILING_IN_CLIPS[name]
    good = blender.read_text()
    blender.write_text(f"#!/bin/sh\n{BUILT}{script}\n")
    done = generate(veldt, blender, "--progress", "none")
    lines = [f"veldt: clip {clip} failed: {message.format(clip=clip)}\n" for clip in ("down", "side")]
    assert (done.code, done.err) == (code, "".join(lines))
    assert done.out == "out: 0 clips made, 0 frames; the dataset is not complete yet\n"
    blender.write_text(good)
    assert generate(veldt, blender).code == 0


def test_the_log_keeps_every_blender_of_a_run_and_only_those(veldt, blender):
    """The message that names it comes after other Blenders may have been started."""
    (veldt.folder / "out" / "passes").mkdir(parents=True)
    veldt.write("out/passes/down.log", "of an earlier run\n")
    blender.write_text(f"#!/bin/sh\n{BUILT} echo x >> starts; echo Blender $(wc -l < starts); exit 3\n")
    done = generate(veldt, blender, "--progress", "none")
    why = "Blender ended with exit code 3 while rendering clip {}: Blender {}" + LOG
    assert done.err == "".join(
        f"veldt: clip {clip} failed: {why.format(clip, number)}\n"
        for clip, number in (("down", 2), ("side", 4))
    )
    log = veldt.folder / "out" / "passes" / "down.log"
    assert log.read_text() == "Blender 1\nBlender 2\nBlender 3\nBlender 4\n"


def test_a_fault_of_the_config_in_a_clip_ends_the_run(veldt, blender):
    event = '{"event": "error", "kind": "config", "message": "seed = 0; expected more"}'
    blender.write_text(f"#!/bin/sh\n{BUILT}\necho x >> starts\necho '{event}' >&3; exit 2\n")
    check_fault(generate(veldt, blender, "--progress", "none"), 2, "seed = 0; expected more")
    assert (veldt.folder / "starts").read_text() == "x\n"  # not started again


def _spoil(veldt, blender, when: str) -> None:
    """Make the stand-in write an index that the manifest does not list."""
    shutil.copytree(ROOT / "tests" / "support", veldt.folder / "support")
    spoilt = veldt.folder / "support" / "passes.py"
    spoilt.write_text(spoilt.read_text().replace("plane[:2] = 0", f"plane[:2] = 55 * ({when})"))
    program = blender.read_text().replace(str(ROOT / "tests" / "support"), str(veldt.folder / "support"))
    blender.write_text(program)


UNKNOWN = (
    "object index at pixel (0, 0) = 55 (960 pixels);"
    " expected an index of the manifest's objects: 0, 1, 2, 3, 4, 101, 102, 103, 104, 105, 106, 107"
)


def test_passes_that_cannot_be_converted_fail_their_clip_alone(veldt, blender):
    """The message names file, pixel and index; the file is kept for inspection, and the next run makes it again."""
    good = blender.read_text()
    _spoil(veldt, blender, "frame == 6")  # the other clip is cut short of it
    veldt.write("config.json", tiny(lambda config: config["clips"][1].update(frames=5)))
    done = generate(veldt, blender, "--progress", "none")
    why = f"out/passes/down/000006.exr: {UNKNOWN}"
    assert (done.code, done.err) == (3, f"veldt: clip down failed: {why}\n")
    assert done.out == "out: 1 clip made, 5 frames; the dataset is not complete yet\n"
    clips = {entry["id"]: entry for entry in veldt.read("out/dataset.json")["clips"]}
    assert clips["down"] == {"id": "down", "status": "failed", "reason": why}
    assert not list((veldt.folder / "out" / "clips").glob("down*"))
    assert (veldt.folder / "out" / "passes" / "down" / "unusable.txt").read_text() == why + "\n"
    assert (veldt.folder / "out" / "passes" / "down" / "000006.exr").exists()
    blender.write_text(good)
    done = generate(veldt, blender, "--progress", "none")
    assert (done.code, done.err) == (0, "")
    assert done.out == "out: 1 clip made, 8 frames; 1 already existed\n"
    assert not (veldt.folder / "out" / "passes").exists()


def test_a_damaged_file_fails_its_clip_alone(veldt, blender):
    """Blender reports it as complete, but it is not."""
    shutil.copytree(ROOT / "tests" / "support", veldt.folder / "support")
    stand_in = veldt.folder / "support" / "fake_blender.py"
    written = 'write_exr(folder / "part.exr", planes)\n'
    cut = '        clip == "side" and frame == 2 and os.truncate(folder / "part.exr", 300)\n'
    assert written in stand_in.read_text()
    stand_in.write_text(stand_in.read_text().replace(written, written + cut))
    good = blender.read_text()
    blender.write_text(good.replace(str(ROOT / "tests" / "support"), str(veldt.folder / "support")))
    done = generate(veldt, blender, "--progress", "none")
    assert done.code == 3 and done.err.startswith(
        "veldt: clip side failed: cannot read out/passes/side/000002.exr: "
    )
    blender.write_text(good)
    assert generate(veldt, blender, "--quiet").code == 0


def test_no_passes_can_be_converted(veldt, blender):
    _spoil(veldt, blender, "frame == 2")
    done = generate(veldt, blender, "--progress", "none")
    names = [f"out/passes/{clip}/000002.exr" for clip in ("down", "side")]
    lines = [f"veldt: clip {Path(name).parent.name} failed: {name}: {UNKNOWN}\n" for name in names]
    assert (done.code, done.err) == (1, "".join(lines))
