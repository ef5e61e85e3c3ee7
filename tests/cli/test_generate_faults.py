"""Faults in `generate`: exact messages on standard error, exit codes, and no partial output."""

import fcntl
import json
import os
import re
import shutil
import subprocess
import sys

import pytest

from configs import tiny
from fake_blender import generate
from program import ROOT, check_fault, files_below
from small_disk import BLOCK

# --- the request ------------------------------------------------------------------------------------------------------

REQUESTS = {
    "unknown clip": (
        ["--clips", "down,sied"],
        '--clips = "sied"; expected one of down, side; did you mean "side"?',
    ),
    "shard past the last": (
        ["--shard", "2/2"],
        "--shard = 2/2; expected I/N with I from 0 to N - 1, or auto",
    ),
    "negative shard": (["--shard=-1/2"], "--shard = -1/2; expected I/N with I from 0 to N - 1, or auto"),
    "shard without a count": (["--shard", "1"], "--shard = 1; expected I/N with I from 0 to N - 1, or auto"),
    "shard with more behind": (
        ["--shard", "0/2x"],
        "--shard = 0/2x; expected I/N with I from 0 to N - 1, or auto",
    ),
}


@pytest.mark.parametrize("name", REQUESTS)
def test_request_that_cannot_be_meant(veldt, blender, name):
    options, message = REQUESTS[name]
    check_fault(generate(veldt, blender, *options), 2, message)
    assert not (veldt.folder / "out").exists()


def test_a_config_may_follow_the_clips(veldt, blender):
    done = veldt(
        "generate", "--clips", "side", "config.json", "--out", "out", "--blender", blender, "--quiet"
    )
    assert (done.code, done.err) == (0, "")


def test_a_dry_run_needs_no_blender_and_writes_nothing(veldt):
    veldt.write("config.json", tiny())
    done = veldt("generate", "config.json", "--out", "out", "--dry-run", env={"PATH": ""})
    assert (done.code, done.err) == (0, "")
    table = [line.split() for line in done.out.splitlines()]
    assert table[0] == ["clip", "or", "flight", "clips", "frames", "with", "actors", "height", "[m", "AGL]"]
    assert [row[:4] for row in table[1:-1]] == [
        ["down", "1", "8", "8"],
        ["side", "1", "8", "8"],
        ["all", "2", "16", "16"],
    ]
    assert re.fullmatch(r"about \d+ s on 2 cores, 0 MB of disk space", done.out.splitlines()[-1])
    assert files_below(veldt.folder) == ["config.json"]


# --- programs it needs ------------------------------------------------------------------------------------------------


def test_no_blender_on_path(veldt):
    veldt.write("config.json", tiny())
    done = veldt("generate", "config.json", "--out", "out", env={"PATH": ""})
    check_fault(
        done,
        1,
        "no blender on PATH; install it (apt-get install blender) or name one with --blender",
    )
    assert not (veldt.folder / "out").exists()


@pytest.mark.parametrize("name", ["nowhere/blender", ".", "config.json"])
def test_a_blender_that_cannot_be_run(veldt, blender, name):
    named = veldt.folder / name
    check_fault(generate(veldt, named), 2, f"--blender = {named}; expected an executable program")
    assert blender.exists() and not (veldt.folder / "out").exists()


def test_a_home_without_assets(veldt, blender):
    done = generate(veldt, blender, env={"VELDT_HOME": "/proc"})
    check_fault(done, 1, 'VELDT_HOME = "/proc"; expected a folder with assets and blender_scripts')


@pytest.mark.parametrize(
    "said, reported",
    [
        (
            "echo 'Traceback …' >&2; echo 'ModuleNotFoundError: No module (planner/noise.py:8)' >&2; exit 1",
            "",
        ),
        ("exit 1", None),
    ],
)
def test_a_python_that_fails_to_plan(veldt, blender, said, reported):
    python = veldt.write("python", f"#!/bin/sh\n{said}\n")
    python.chmod(0o755)
    done = generate(veldt, blender, env={"VELDT_PYTHON": str(python)})
    why = "" if reported is None else ": ModuleNotFoundError: No module (planner/noise.py:8)"
    check_fault(done, 1, f"{python} plan_scene.py ended with exit code 1{why}")


@pytest.mark.parametrize("command", [["validate"], ["generate", "--out", "out", "--dry-run"]])
def test_a_long_plan_says_how_far_it_is(veldt, command):
    config = veldt.write("config.json", tiny())
    events = "".join(
        json.dumps({"event": "planned", "id": name, "done": k, "total": 2}) + "\\n"
        for k, name in enumerate(["down", "side"], 1)
    )
    python = veldt.write(
        "python", f"#!/bin/sh\nsleep 10.1\nprintf '{events}' >&3\nexec {sys.executable} \"$@\"\n"
    )
    python.chmod(0o755)
    env = {"VELDT_PYTHON": str(python)}
    first, *rest = veldt(*command[:1], config, *command[1:], "--progress", "plain", env=env).err.splitlines()
    assert first == "1/2 flights, 0.0 flights/s, starting, clip down"
    done = [line.partition(" flights")[0] for line in rest]
    assert [one for one in done if one != "1/2"] == [
        "2/2",
        "2/2",
    ]  # the planner's own first, only if it takes seconds


# --- the output folder ------------------------------------------------------------------------------------------------


def test_a_file_where_the_folder_should_be(veldt, blender):
    veldt.write("out", "precious")
    check_fault(generate(veldt, blender), 1, "cannot make folder out: Not a directory")
    check_fault(generate(veldt, blender, out="out/deep"), 1, "cannot make folder out/deep: Not a directory")
    assert (veldt.folder / "out").read_text() == "precious"


def test_a_folder_that_cannot_be_made(veldt, blender):
    check_fault(
        generate(veldt, blender, out="/proc/out"),
        1,
        "cannot make folder /proc/out: No such file or directory",
    )


def test_a_folder_without_permission_to_write(veldt, blender):
    (veldt.folder / "out").mkdir(mode=0o555)
    under = []
    if os.geteuid() == 0:  # root may write anywhere, unless that right is taken from it
        under = ["setpriv", "--bounding-set=-dac_override"]
        if subprocess.run([*under, "true"], check=False).returncode != 0:
            pytest.skip("this root may not give up rights")
    check_fault(generate(veldt, blender, under=under), 1, "cannot lock out/.lock: Permission denied")
    assert not files_below(veldt.folder / "out")


def test_a_folder_in_use(veldt, blender):
    (veldt.folder / "out").mkdir()
    with open(veldt.folder / "out" / ".lock", "w", encoding="utf-8") as lock:
        fcntl.lockf(lock, fcntl.LOCK_EX)
        done = generate(veldt, blender)
    check_fault(done, 75, "out is in use by another run of veldt; try again when that one has ended")
    assert generate(veldt, blender).code == 0


def _other(config: dict) -> None:
    config.update(seed=8, camera={"width_px": 96, "height_px": 64, "pixel_pitch_um": 90})
    config["clips"][1].update(frames=4, start_s=1.5)
    config["scene"]["groups"].pop()


OTHER = [
    "seed is 8 here and 7 there",
    "scene.groups has 2 entries here and 3 there",
    "camera.height_px is 64 here and 80 there",
    "camera.pixel_pitch_um is 90 here and 100 there",
    "clips[1].frames is 4 here and 8 there",
    "clips[1].start_s is 1.5 here and 0 there",
]


@pytest.mark.parametrize(
    "command, option, what",
    [("generate", "--quiet", "a dataset made from"), ("render", "--quiet", "passes of")],
)
def test_the_folder_of_another_config(veldt, blender, command, option, what):
    run = (command, "config.json", "--out", "out", "--blender", blender, option)
    assert veldt(*run).code == 0
    before = {name: (veldt.folder / "out" / name).read_bytes() for name in files_below(veldt.folder / "out")}
    veldt.write("config.json", tiny(_other))
    done = veldt(*run)
    place = "out" if command == "generate" else "out/passes"
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith(f"veldt: {place} holds {what} another config: ")
    assert done.err.endswith("; expected the same config, or another folder\n")
    listed = done.err.split(" another config: ")[1].split("; expected")[0]
    assert sorted(listed.split(", ")) == sorted(OTHER)
    after = {name: (veldt.folder / "out" / name).read_bytes() for name in files_below(veldt.folder / "out")}
    assert after == before


# --- disk space -------------------------------------------------------------------------------------------------------


def _on_a_small_disk(veldt, beside_plan: int) -> list[str]:
    """A command that mounts a disk as `out` and copies it to `kept` afterwards. On the disk is space for the plan and
    this many bytes."""
    assert veldt("plan", "config.json", "--out", "planned", "--quiet").code == 0
    planned = [file.stat().st_size for file in (veldt.folder / "planned").rglob("*.*")]
    size = beside_plan + sum(-(-one // BLOCK) * BLOCK for one in planned)
    script = f'mount -t tmpfs -o size={size} none out && "$@"; code=$?; cp -r out/. kept; exit $code'
    under = ["unshare", "--map-root-user", "--mount", "sh", "-c", script, "sh"]
    for folder in ("out", "kept"):
        (veldt.folder / folder).mkdir()
    if subprocess.run([*under, "true"], cwd=veldt.folder, capture_output=True, check=False).returncode != 0:
        pytest.skip("no permission here to mount a small disk")
    return under


def test_too_little_disk_space_for_a_clip_is_reported_before_it_is_begun(veldt, blender):
    under = _on_a_small_disk(veldt, 64 << 10)
    done = generate(veldt, blender, "--progress", "none", under=under)
    # 8 frames of 96 x 80 pixels, 40 bytes of passes and 4 of pictures each
    wanted = "expected at least 2 x the 2.7 MB that clip down still needs"
    assert done.code == 75 and re.fullmatch(rf"veldt: out = \d+ kB left; {wanted}\n", done.err), done
    assert not list((veldt.folder / "kept" / "clips").glob("*"))


def test_a_full_disk_ends_the_run_and_finished_clips_stay(veldt, blender):
    """Disk space would suffice if another process did not use it while the second clip is rendered."""
    under = _on_a_small_disk(veldt, 7 << 20)
    good = blender.read_text()
    shutil.copytree(ROOT / "tests" / "support", veldt.folder / "support")
    stand_in = veldt.folder / "support" / "fake_blender.py"
    taking = (
        'while frame == 2 and clip == "side" and not Path("out/clips/down").exists(): time.sleep(0.02)\n'
        '        clip == "side" and frame == 2 and Path("out/other").write_bytes(bytes(6500000))\n'
    )
    held = "        _hold(clip, frame)\n"
    assert held in stand_in.read_text()
    stand_in.write_text(stand_in.read_text().replace(held, f"        {taking}{held}"))
    blender.write_text(good.replace(str(ROOT / "tests" / "support"), str(veldt.folder / "support")))
    done = generate(veldt, blender, "--progress", "none", under=under)
    few = r"out = \d+ (k|)B left; expected at least 2 x the \d+ kB that clip side still needs"
    assert (done.code, done.out) == (75, "") and re.fullmatch(f"veldt: {few}\n", done.err), done
    kept = files_below(veldt.folder / "kept")
    assert [name for name in kept if ".part" in name] == []
    assert "clips/down/clip.json" in kept and "passes/side/000002.exr" in kept
    blender.write_text(good)
    (veldt.folder / "kept" / "other").unlink()
    done = generate(veldt, blender, "--progress", "none", out="kept")
    assert (done.code, done.err) == (0, "")
    assert done.out == "kept: 1 clip made, 8 frames; 1 already existed\n"
    assert veldt("validate", "kept").code == 0
