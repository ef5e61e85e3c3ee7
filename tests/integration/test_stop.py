"""`convert` stopped in the middle of a clip: no partial clip is left, and the same command completes the dataset."""

import os
import signal

import pytest

import passes
from datasets import content_of
from processes import wait_until
from program import files_below

FRAMES = 300  # long enough to be caught in the middle
STOPPED = "veldt: stopped on request; run the same command again to resume\n"


@pytest.fixture(name="clip")
def _clip(veldt):
    """Passes of a clip, and the dataset of an undisturbed run."""
    passes.write_clip(veldt.folder / "one", frames=FRAMES)
    assert veldt("convert", "one", "--out", "usual", "--quiet").code == 0
    return veldt.folder / "usual"


def _start(veldt, *more, part="out/clips/one.part"):
    """A run that has written some pictures, and not all."""
    run = veldt.start("convert", "one", "--out", "out", "--progress", "none", "--threads", "1", *more)
    pictures = veldt.folder / part / "ir16"
    assert wait_until(lambda: pictures.is_dir() and len(list(pictures.iterdir())) > 5, 60)
    return run


def _below(folder):
    return sorted(str(place.relative_to(folder)) for place in folder.rglob("*"))


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_asked_to_stop_it_leaves_nothing_half_made(veldt, clip, number):
    run = _start(veldt)
    os.kill(run.pid, number)
    out, err = run.communicate(timeout=60)
    assert (run.returncode, out, err) == (128 + number, "", STOPPED)
    assert _below(veldt.folder / "out") == [".lock", "annotations.json", "clips", "dataset.json"]
    assert veldt.read("out/dataset.json")["clips"] == [{"id": "one", "status": "pending"}]
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    assert content_of(veldt.folder / "out") == content_of(clip)


def test_asked_to_stop_it_leaves_nothing_of_any_variant(veldt, clip):
    veldt.write("variants.json", {"variants": [{"name": "a"}, {"name": "b", "season": "summer"}]})
    run = _start(veldt, "--variants", "variants.json", part="out/b/clips/one.part")
    run.terminate()
    assert (run.communicate(timeout=60), run.returncode) == (("", STOPPED), 128 + signal.SIGTERM)
    for name in ("a", "b"):
        assert list((veldt.folder / "out" / name / "clips").iterdir()) == []
    again = veldt("convert", "one", "--out", "out", "--variants", "variants.json", "--quiet")
    assert again.code == 0
    assert veldt.pixels("out/a") == veldt.pixels(clip)


def test_killed_it_leaves_what_the_next_run_sweeps_away(veldt, clip):
    run = _start(veldt)
    run.kill()
    run.communicate()
    assert run.returncode == -signal.SIGKILL
    assert (veldt.folder / "out" / "clips" / "one.part").is_dir()
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    assert files_below(veldt.folder / "out") == files_below(clip)
    assert content_of(veldt.folder / "out") == content_of(clip)


def test_stopped_while_a_clip_is_made_again_the_old_one_stays(veldt, clip):
    """A clip that lacks a frame is replaced in one step, when the new one is whole."""
    frame = veldt.folder / "one" / f"{FRAMES // 2:06d}.exr"
    content = frame.read_bytes()
    frame.unlink()
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 3
    old = content_of(veldt.folder / "out" / "clips" / "one")
    frame.write_bytes(content)
    run = _start(veldt)
    run.terminate()
    run.communicate(timeout=60)
    assert run.returncode == 128 + signal.SIGTERM
    assert content_of(veldt.folder / "out" / "clips" / "one") == old
    assert veldt("validate", "out").code == 0
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    assert content_of(veldt.folder / "out") == content_of(clip)
