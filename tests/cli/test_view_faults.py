"""`veldt view`: what is refused, in which words, and what a disturbed run leaves."""

from __future__ import annotations

import fcntl
import json
import os
import shutil
import signal
from pathlib import Path

import pytest

import passes
from processes import PATIENCE_S, interrupt
from program import check_fault, files_below
from reports import change, make_dataset


@pytest.fixture(name="dataset")
def _dataset(veldt):
    """Two clips of made-up passes, without poses."""
    return make_dataset(veldt)


def _view(veldt, *options):
    return veldt("view", "out", "--out", "page", "--progress", "none", *options)


def _make(veldt, *options) -> Path:
    done = _view(veldt, "--quiet", *options)
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt.folder / "page"


# --- what is refused --------------------------------------------------------------------------------------------------

FAULTS = {
    "no dataset": (["nowhere", "--out", "page"], 1, "nowhere does not exist"),
    "a folder of something else": (
        ["down", "--out", "page"],
        1,
        "down is not a dataset; expected a folder with dataset.json, or a clip's folder, DIR/clips/CLIP",
    ),
    "an unknown clip": (
        ["out", "--out", "page", "--clips", "down,sid"],
        2,
        '--clips = "sid"; expected a clip of out: down, side; did you mean "side"?',
    ),
    "clips of a clip": (
        ["out/clips/down", "--out", "page", "--clips", "down"],
        2,
        "--clips = down; expected none, because out/clips/down is one clip",
    ),
    "a folder of the user's": (
        ["out", "--out", "mine"],
        2,
        '--out = "mine"; expected an empty or new folder, or the page of an earlier veldt view',
    ),
    "the dataset itself": (
        ["out", "--out", "out"],
        2,
        '--out = "out"; expected an empty or new folder, or the page of an earlier veldt view',
    ),
    "a file": (["out", "--out", "mine/text"], 2, '--out = "mine/text"; expected a folder'),
    "a page as a report is one": (
        ["out", "--out", "page.html"],
        2,
        '--out = "page.html"; expected the name of a folder, in which the page is index.html',
    ),
    "a folder in the way": (
        ["out", "--out", "other"],
        2,
        "other.part is in the way; expected to make the result there before it becomes other",
    ),
}


@pytest.mark.usefixtures("dataset")
@pytest.mark.parametrize("name", FAULTS)
def test_a_request_that_cannot_be_met(veldt, name):
    for folder in ("mine", "other.part"):
        (veldt.folder / folder).mkdir()
        (veldt.folder / folder / "text").write_text("mine", encoding="utf-8")
    before = files_below(veldt.folder)
    arguments, code, message = FAULTS[name]
    check_fault(veldt("view", *arguments, "--progress", "none"), code, message)
    assert files_below(veldt.folder) == before


def _check_data_fault(veldt, message: str) -> None:
    """A fault of the dataset leaves the page that is there, and nothing else."""
    before = files_below(veldt.folder)
    done = _view(veldt)
    assert (done.code, done.out) == (1, "")
    assert done.err.startswith(f"veldt: {message}")
    assert files_below(veldt.folder) == before


def test_damaged_files_are_named_and_an_earlier_page_stays(veldt, dataset):
    _make(veldt)
    picture = dataset / "clips" / "side" / "ir16" / "000002.png"
    content = picture.read_bytes()
    picture.write_bytes(content[:-20])
    _check_data_fault(veldt, "out/clips/side/ir16/000002.png: damaged: ")
    shutil.copy(dataset / "clips" / "side" / "ir8" / "000002.png", picture)
    _check_data_fault(
        veldt, "out/clips/side/ir16/000002.png: pixels = grey of 8 bits; expected grey of 16 bits\n"
    )
    picture.unlink()
    _check_data_fault(veldt, "cannot read out/clips/side/ir16/000002.png: no such file\n")
    picture.write_bytes(content)
    frames = dataset / "clips" / "side" / "frames.jsonl"
    frames.write_text(frames.read_text(encoding="utf-8")[:-40], encoding="utf-8")
    _check_data_fault(veldt, "out/clips/side/frames.jsonl:3: not a frame of a clip: ")
    (dataset / "clips" / "down" / "labels.json").unlink()
    _check_data_fault(veldt, "cannot read out/clips/down/labels.json: No such file or directory\n")


@pytest.mark.parametrize("counts", ["0", "zzzz", "~", 5])
def test_masks_must_be_those_of_a_frame(veldt, dataset, counts):
    def damage(document):
        document["annotations"][1]["segmentation"]["counts"] = counts

    change(dataset / "clips" / "down" / "labels.json", damage)
    text = json.dumps({"size": [16, 24], "counts": counts}, separators=(",", ":"))
    message = f"out/clips/down/labels.json: annotations[1].segmentation = {text}; expected run lengths of 24 x 16 px\n"
    _check_data_fault(veldt, message)


# --- runs that are disturbed ------------------------------------------------------------------------------------------


@pytest.fixture(name="long")
def _long(dataset):
    """A clip of enough frames to be stopped on the way, all as its second one, and without labels."""
    clip = dataset / "clips" / "down"
    change(clip / "labels.json", lambda document: document.update(annotations=[]))
    line = (clip / "frames.jsonl").read_text(encoding="utf-8").splitlines()[1]
    lines = [line.replace('"frame_index":1,', f'"frame_index":{k},') for k in range(3000)]
    (clip / "frames.jsonl").write_text("\n".join(lines) + "\n", encoding="utf-8")
    for kind in ("ir8", "ir16"):
        for frame in range(passes.FRAMES, 3000):
            os.link(clip / kind / "000001.png", clip / kind / f"{frame:06d}.png")
    return dataset


def _started(veldt, out: str):
    """A run that has begun with frames."""
    run = veldt.start("view", "out/clips/down", "--out", out, "--progress", "json")
    run.stderr.readline()
    return run


@pytest.mark.usefixtures("long")
def test_stopped_it_leaves_what_was_there(veldt):
    page = _make(veldt, "--clips", "side")
    before = files_below(veldt.folder)
    run = _started(veldt, page.name)
    assert (veldt.folder / "page.part" / "index.html").exists()
    interrupt(run.pid, signal.SIGINT)
    out, err = run.communicate(timeout=PATIENCE_S)
    assert (run.returncode, out) == (128 + signal.SIGINT, "")
    assert err.splitlines()[-1] == "veldt: stopped on request; run the same command again to resume"
    assert files_below(veldt.folder) == before


@pytest.mark.usefixtures("long")
def test_killed_it_starts_again(veldt):
    run = _started(veldt, "page")
    run.kill()
    run.communicate(timeout=PATIENCE_S)
    part = veldt.folder / "page.part"
    assert part.is_dir() and not (veldt.folder / "page").exists()
    (part / "data" / "stale.js").write_text("", encoding="utf-8")
    assert not [
        name for name in files_below(_make(veldt, "--clips", "side")) if "stale" in name or "down" in name
    ]
    assert not part.exists()


@pytest.mark.usefixtures("dataset")
def test_two_runs_do_not_write_one_page(veldt):
    part = veldt.folder / "page.part"
    part.mkdir()
    with open(part / ".lock", "w", encoding="utf-8") as lock:
        fcntl.lockf(lock, fcntl.LOCK_EX)
        message = "page.part is in use by another run of veldt; try again when that one has ended"
        check_fault(_view(veldt), 75, message)
    assert _view(veldt).code == 0 and not part.exists()
