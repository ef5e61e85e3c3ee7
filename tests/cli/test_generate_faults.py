"""What can stand in the way of `generate`: exact words on standard error, exit codes, nothing half made."""

import fcntl
import os
import re
import shutil
import subprocess

import pytest

import fake_blender
from configs import tiny
from program import ROOT, files_below


@pytest.fixture(name="blender")
def _blender(veldt):
    """A stand-in for Blender, and the tiny config beside it."""
    veldt.write("config.json", tiny())
    return fake_blender.install(veldt.folder)


def _generate(veldt, blender, *options, out="out", **how):
    return veldt("generate", "config.json", "--out", out, "--blender", blender, *options, **how)


def _check(done, code: int, message: str) -> None:
    assert (done.code, done.out, done.err) == (code, "", f"veldt: {message}\n")


# --- the request ------------------------------------------------------------------------------------------------------

REQUESTS = {
    "unknown clip": (
        ["--clips", "down,sied"],
        '--clips = "sied"; expected one of down, side; did you mean "side"?',
    ),
    "shard past the last": (["--shard", "2/2"], "--shard = 2/2; expected I/N with I from 0 to N - 1"),
    "negative shard": (["--shard=-1/2"], "--shard = -1/2; expected I/N with I from 0 to N - 1"),
    "shard without a count": (["--shard", "1"], "--shard = 1; expected I/N with I from 0 to N - 1"),
    "shard with more behind": (["--shard", "0/2x"], "--shard = 0/2x; expected I/N with I from 0 to N - 1"),
}


@pytest.mark.parametrize("name", REQUESTS)
def test_request_that_cannot_be_meant(veldt, blender, name):
    options, message = REQUESTS[name]
    _check(_generate(veldt, blender, *options), 2, message)
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
    assert re.fullmatch(r"about \d+ s on 2 cores, 0 MB of disk", done.out.splitlines()[-1])
    assert files_below(veldt.folder) == ["config.json"]


# --- programs it needs ------------------------------------------------------------------------------------------------


def test_no_blender_on_path(veldt):
    veldt.write("config.json", tiny())
    done = veldt("generate", "config.json", "--out", "out", env={"PATH": ""})
    _check(
        done,
        1,
        "no blender on PATH; install it (apt-get install blender) or name one with --blender PATH",
    )
    assert not (veldt.folder / "out").exists()


@pytest.mark.parametrize("name", ["nowhere/blender", ".", "config.json"])
def test_a_blender_that_cannot_be_run(veldt, blender, name):
    named = veldt.folder / name
    _check(_generate(veldt, named), 2, f"--blender = {named}; expected a program that can be run")
    assert blender.exists() and not (veldt.folder / "out").exists()


def test_a_home_without_assets(veldt, blender):
    done = _generate(veldt, blender, env={"VELDT_HOME": "/proc"})
    _check(done, 1, 'VELDT_HOME = "/proc"; expected a folder with assets and blender_scripts')


def test_a_python_without_numpy(veldt, blender):
    python = veldt.write(
        "python", "#!/bin/sh\necho \"ModuleNotFoundError: No module named 'numpy'\" >&2\nexit 1\n"
    )
    python.chmod(0o755)
    script = ROOT / "blender_scripts" / "plan_dataset.py"
    done = _generate(veldt, blender, env={"VELDT_PYTHON": str(python)})
    _check(done, 1, f"{script} ended with exit code 1: ModuleNotFoundError: No module named 'numpy'")


# --- the output folder ------------------------------------------------------------------------------------------------


def test_a_file_where_the_folder_should_be(veldt, blender):
    veldt.write("out", "precious")
    _check(_generate(veldt, blender), 1, "cannot make folder out: Not a directory")
    _check(_generate(veldt, blender, out="out/deep"), 1, "cannot make folder out/deep: Not a directory")
    assert (veldt.folder / "out").read_text() == "precious"


def test_a_folder_that_cannot_be_made(veldt, blender):
    _check(
        _generate(veldt, blender, out="/proc/out"),
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
    _check(_generate(veldt, blender, under=under), 1, "cannot lock out/.lock: Permission denied")
    assert not files_below(veldt.folder / "out")


def test_a_full_disk_is_to_be_tried_again(veldt, blender):
    in_a_small_place = 'mount -t tmpfs -o size=64k none out && exec "$@"'
    under = ["unshare", "--map-root-user", "--mount", "sh", "-c", in_a_small_place, "sh"]
    (veldt.folder / "out").mkdir()
    if subprocess.run([*under, "true"], cwd=veldt.folder, capture_output=True, check=False).returncode != 0:
        pytest.skip("no permission here to mount a small disk")
    done = _generate(veldt, blender, "--progress", "none", under=under)
    # Whether the renderer or the converter runs out of room first is a matter of chance.
    full = r"veldt: (cannot write out/\S+: No space left on device|Blender ended .*; the disk is full)\n"
    assert done.code == 75 and re.fullmatch(full, done.err), done


def test_a_folder_in_use(veldt, blender):
    (veldt.folder / "out").mkdir()
    with open(veldt.folder / "out" / ".lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = _generate(veldt, blender)
    _check(done, 75, "out is in use by another run of veldt; try again when that one has ended")
    assert _generate(veldt, blender).code == 0


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


# --- a Blender that fails ---------------------------------------------------------------------------------------------

KILLED = "; if nobody stopped it, the machine may have run out of memory"
BLENDERS = {
    "ends without a word": ("exit 0", 1, "Blender ended early while building the scene"),
    "fails without a word": (
        "exit 3",
        1,
        "Blender ended with exit code 3 while building the scene; it gave no reason",
    ),
    "fails with a page of log": (
        "echo Blender 3.4; echo 'Error: no memory for a BVH' >&2; echo Blender quit; exit 1",
        1,
        "Blender ended with exit code 1 while building the scene: Error: no memory for a BVH",
    ),
    "is killed": (
        "kill -9 $$",
        75,
        "Blender was killed by signal 9 (Killed) while building the scene" + KILLED,
    ),
    "crashes in a clip": (
        """echo '{"event": "clip", "clip": "side", "first_frame": 0}' >&3; kill -11 $$""",
        75,
        "Blender was killed by signal 11 (Segmentation fault) while rendering clip side" + KILLED,
    ),
    "crashes after a frame": (
        """echo '{"event": "frame", "clip": "side", "index": 4}' >&3; kill -11 $$""",
        75,
        "Blender was killed by signal 11 (Segmentation fault) while rendering clip side after frame 4"
        + KILLED,
    ),
    "tells of a fault of its script": (
        """echo '{"event": "error", "kind": "internal", "message": "no mesh", "where": "terrain.py:12"}' >&3; exit 1""",
        1,
        "no mesh (terrain.py:12)",
    ),
    "tells of a fault of the config": (
        """echo '{"event": "error", "kind": "config", "message": "seed = 0; expected more"}' >&3; exit 2""",
        2,
        "seed = 0; expected more",
    ),
    "speaks no JSON": (
        "echo {oops >&3; echo 7 >&3; exit 0",
        1,
        "Blender ended early while building the scene",
    ),
}


@pytest.mark.parametrize("name", BLENDERS)
def test_a_failing_blender_is_relayed_in_words(veldt, blender, name):
    script, code, message = BLENDERS[name]
    good = blender.read_text()
    blender.write_text(f"#!/bin/sh\n{script}\n")
    done = _generate(veldt, blender, "--progress", "none")
    _check(done, code, message)
    assert not (veldt.folder / "out" / "clips" / "down").exists()
    blender.write_text(good)
    assert _generate(veldt, blender).code == 0  # and the same command goes on from there


def test_passes_that_cannot_be_converted_stop_the_run(veldt, blender):
    """Blender delivers an index the manifest lacks: the run ends at once, and names file, pixel and index."""
    shutil.copytree(ROOT / "tests" / "support", veldt.folder / "support")
    spoilt = veldt.folder / "support" / "passes.py"
    spoilt.write_text(spoilt.read_text().replace("plane[:2] = 0", "plane[:2] = 55 * (frame == 2)"))
    program = blender.read_text().replace(str(ROOT / "tests" / "support"), str(veldt.folder / "support"))
    blender.write_text(program)
    done = _generate(veldt, blender, "--progress", "none")
    _check(
        done,
        1,
        "out/passes/down/000002.exr: object index at pixel (0, 0) = 55 (48 pixels);"
        " expected an index of the manifest's objects: 0, 1, 4, 101, 102",
    )
    assert not (veldt.folder / "out" / "clips" / "down").exists()
