"""`convert` stopped in the middle of a clip: no partial clip is left, and the same command completes the dataset."""

import signal

import pytest

import passes
from datasets import content_of
from processes import PATIENCE_S, interrupt
from program import files_below

FRAMES = 40  # more than a run begins after it was asked to stop
STOPPED = "veldt: stopped on request; run the same command again to resume\n"


@pytest.fixture(name="clip")
def _clip(veldt):
    """Passes of a clip, and the dataset of an undisturbed run."""
    passes.write_clip(veldt.folder / "one", frames=FRAMES)
    assert veldt("convert", "one", "--out", "usual", "--quiet").code == 0
    return veldt.folder / "usual"


def _held(veldt, gate, *more, part="out/clips/one.part"):
    """A run that has written some pictures, and is held before the next."""
    command = ["convert", "one", "--out", "out", "--progress", "none", "--threads", "1", *more]
    run = gate.start(veldt, f"{part}/ir16/000006.png", *command)
    assert len(list((veldt.folder / part / "ir16").iterdir())) == 6
    return run


def _stop(run, gate, number):
    interrupt(run.pid, number)
    gate.open()
    return run.communicate(timeout=PATIENCE_S)


def _below(folder):
    return sorted(str(place.relative_to(folder)) for place in folder.rglob("*"))


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_asked_to_stop_it_leaves_nothing_half_made(veldt, gate, clip, number):
    run = _held(veldt, gate)
    out, err = _stop(run, gate, number)
    assert (run.returncode, out, err) == (128 + number, "", STOPPED)
    assert _below(veldt.folder / "out") == [".lock", "annotations.json", "clips", "dataset.json"]
    assert veldt.read("out/dataset.json")["clips"] == [{"id": "one", "status": "pending"}]
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    assert content_of(veldt.folder / "out") == content_of(clip)


def test_asked_to_stop_it_leaves_nothing_of_any_variant(veldt, gate, clip):
    veldt.write("variants.json", {"variants": [{"name": "a"}, {"name": "b", "season": "summer"}]})
    run = _held(veldt, gate, "--variants", "variants.json", part="out/b/clips/one.part")
    assert (_stop(run, gate, signal.SIGTERM), run.returncode) == (("", STOPPED), 128 + signal.SIGTERM)
    for name in ("a", "b"):
        assert list((veldt.folder / "out" / name / "clips").iterdir()) == []
    again = veldt("convert", "one", "--out", "out", "--variants", "variants.json", "--quiet")
    assert again.code == 0
    assert veldt.pixels("out/a") == veldt.pixels(clip)


def test_killed_it_leaves_what_the_next_run_sweeps_away(veldt, gate, clip):
    run = _held(veldt, gate)
    run.kill()
    run.communicate()
    assert run.returncode == -signal.SIGKILL
    assert (veldt.folder / "out" / "clips" / "one.part").is_dir()
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    assert files_below(veldt.folder / "out") == files_below(clip)
    assert content_of(veldt.folder / "out") == content_of(clip)


def test_stopped_while_a_clip_is_made_again_the_old_one_stays(veldt, gate, clip):
    """A clip that lacks a frame is replaced in one step, when the new one is whole."""
    frame = veldt.folder / "one" / f"{FRAMES // 2:06d}.exr"
    content = frame.read_bytes()
    frame.unlink()
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 3
    old = content_of(veldt.folder / "out" / "clips" / "one")
    frame.write_bytes(content)
    run = _held(veldt, gate)
    _stop(run, gate, signal.SIGTERM)
    assert run.returncode == 128 + signal.SIGTERM
    assert content_of(veldt.folder / "out" / "clips" / "one") == old
    assert veldt("validate", "out").code == 0
    assert veldt("convert", "one", "--out", "out", "--quiet").code == 0
    assert content_of(veldt.folder / "out") == content_of(clip)
