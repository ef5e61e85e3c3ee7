"""Full and read-only disks: `convert` reports them, leaves no partial files, and resumes once there is disk space."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

import passes
from datasets import content_of
from processes import PATIENCE_S
from program import PROGRAM, ROOT, Veldt, files_below
from small_disk import BLOCK, can_be_root_of_a_namespace, small_disk

FULL = "No space left on device"


@pytest.fixture(name="disk")
def _disk(veldt):
    with small_disk(veldt.folder / "disk") as disk:
        yield disk


def _half_written(folder):
    return [name for name in files_below(folder) if ".part/" in name or name.endswith(".tmp")]


@pytest.mark.skipif(os.geteuid() == 0, reason="root mounts without a namespace")
def test_this_file_as_root_of_a_namespace():
    """Runs the tests in a user namespace for ordinary users, who cannot mount a disk otherwise."""
    if not can_be_root_of_a_namespace():
        pytest.skip("unshare -rm: not allowed here")
    command = [
        "unshare",
        "-rm",
        sys.executable,
        "-B",
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        __file__,
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert done.returncode == 0, done.stdout


def test_a_disk_that_fills_with_tar_files(veldt, disk):
    """Exit code 75 and the tar file's name, nothing half written; with enough disk space the same command passes."""
    passes.write_clip(veldt.folder / "one", frames=40)
    assert veldt("convert", "one", "--out", "usual", "--quiet").code == 0
    export = ("export", "usual", "--format", "webdataset", "--samples-per-shard", 10, "--quiet")
    for options, made in (([], "x.part"), (["--scratch", "scratch"], "x")):
        disk.leave(5 * BLOCK)
        done = veldt(*export, "--out", "disk/x", *options)
        assert (done.code, done.out) == (75, "")
        assert re.fullmatch(rf"veldt: cannot write disk/{made}/train/\w+-00000[0-3]\.tar: {FULL}\n", done.err)
        assert files_below(disk.folder) == ["filling"]
        assert files_below(veldt.folder / "scratch") == []
    disk.free_space()
    done = veldt(*export, "--out", "disk/x")
    assert (done.code, done.out, done.err) == (0, "", "")
    assert len(files_below(disk.folder / "x")) == 5


def test_a_disk_that_fills_with_pictures(veldt, disk):
    """Exit code 75 and the file's name; with enough disk space the same command makes the usual dataset."""
    passes.write_clip(veldt.folder / "one", frames=40)
    usual = veldt("convert", "one", "--out", "usual", "--quiet")
    assert usual.code == 0
    disk.leave(50 * BLOCK)
    done = veldt("convert", "one", "--out", "disk/out", "--quiet")
    assert (done.code, done.out) == (75, "")
    assert re.fullmatch(rf"veldt: cannot write disk/out/clips/one\.part/[\w/]+\.\w+: {FULL}\n", done.err)
    assert _half_written(veldt.folder / "disk") == []
    assert list((veldt.folder / "disk" / "out" / "clips").iterdir()) == []
    assert veldt.read("disk/out/dataset.json")["clips"] == [{"id": "one", "status": "pending"}]
    disk.free_space()
    done = veldt("convert", "one", "--out", "disk/out", "--quiet")
    assert (done.code, done.err) == (0, "")
    assert content_of(veldt.folder / "disk" / "out") == content_of(veldt.folder / "usual")
    assert veldt("validate", "disk/out").code == 0


def test_a_disk_that_fills_at_any_file(veldt, disk):
    """Disk space grows block by block from none to enough: whichever file does not fit is named, and every file is
    complete or missing."""
    passes.write_clip(
        veldt.folder / "one", frames=20
    )  # so many that annotations.json is larger than dataset.json
    run = ("convert", "one", "--out", "disk/out", "--quiet", "--threads", "1")
    assert veldt("convert", "one", "--out", "usual", "--quiet").code == 0
    named = set()
    for blocks in range(200):
        disk.leave(blocks * BLOCK)
        done = veldt(*run)
        if done.code == 0:
            break
        match = re.fullmatch(
            rf"veldt: cannot (?:write|make folder|lock|rename to) disk/(\S+): {FULL}\n", done.err
        )
        assert (done.code, done.out) == (75, "") and match, done
        assert _half_written(disk.folder) == []
        disk.free_space()
        kind = re.sub(r"\d{6}", "N", match[1])
        if kind not in named:
            assert veldt(*run).code == 0
            assert content_of(disk.folder / "out") == content_of(veldt.folder / "usual")
            assert veldt("validate", "disk/out").code == 0
        named.add(kind)
        subprocess.run(["rm", "-rf", disk.folder / "out"], check=True)
    assert done.code == 0 and veldt("validate", "disk/out").code == 0
    part = "out/clips/one.part"
    expected = {"out/dataset.json.tmp", f"{part}/preview.mp4", f"{part}/ir8/N.png", f"{part}/ir16/N.png"}
    expected |= {"out/annotations.json.tmp", f"{part}/labels.json", f"{part}/frames.jsonl"}
    assert expected - named == set()


def test_a_read_only_disk(veldt, disk):
    passes.write_clip(veldt.folder / "one")
    (disk.folder / "begun").mkdir()
    disk.make_read_only()
    done = veldt("convert", "one", "--out", "disk/out", "--quiet")
    assert (done.code, done.err) == (1, "veldt: cannot make folder disk/out: Read-only file system\n")
    done = veldt("convert", "one", "--out", "disk/begun", "--quiet")
    assert (done.code, done.err) == (1, "veldt: cannot lock disk/begun/.lock: Read-only file system\n")


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes into any folder")
@pytest.mark.parametrize("locked, message", [("", "make folder out"), ("out", "lock out/.lock")])
def test_a_folder_that_is_not_ours_to_write_in(veldt, locked, message):
    passes.write_clip(veldt.folder / "one")
    if locked:
        (veldt.folder / locked).mkdir()
    folder = veldt.folder / locked
    folder.chmod(0o555)
    try:
        done = veldt("convert", "one", "--out", "out", "--quiet")
    finally:
        folder.chmod(0o755)
    assert (done.code, done.err) == (1, f"veldt: cannot {message}: Permission denied\n")


UNPRIVILEGED = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")


@pytest.fixture(name="public")
def _public():
    """A copy of the program in a folder that every user may read, unlike pytest's own and root's home."""
    with tempfile.TemporaryDirectory(prefix="veldt-") as name:
        folder = Path(name)
        folder.chmod(0o755)
        for part in ("bin/veldt", "lib/veldt/libveldt_pictures.so"):
            (folder / "built" / part).parent.mkdir(parents=True)
            shutil.copy(PROGRAM.parents[1] / part, folder / "built" / part)
        yield Veldt(folder, folder / "built" / "bin" / "veldt")


@pytest.fixture(name="home")
def _home(public) -> dict:
    """The environment of a user whose checkout is in `public.folder`."""
    for resources in ("assets", "blender_scripts", "configs"):
        shutil.copytree(ROOT / resources, public.folder / "home" / resources)
    return {"VELDT_HOME": str(public.folder / "home")}


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can be an ordinary user")
def test_a_folder_of_another_user(public, home):
    passes.write_clip(public.folder / "one")
    done = public("convert", "one", "--out", "out", "--quiet", under=UNPRIVILEGED, env=home)
    assert (done.code, done.err) == (1, "veldt: cannot make folder out: Permission denied\n")


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can be an ordinary user")
def test_a_folder_on_path_that_may_not_be_looked_into(public, home):
    (public.folder / "secret").mkdir(mode=0o700)
    found = public("doctor", "--json", under=UNPRIVILEGED, env=home)
    assert (found.code, found.err) == (0, "")
    secret = {"PATH": f"{public.folder / 'secret'}:{os.environ['PATH']}"}
    assert public("doctor", "--json", under=UNPRIVILEGED, env=home | secret) == found
