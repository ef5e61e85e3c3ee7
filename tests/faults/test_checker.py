"""The night of faults must not pass what it should report: whatever is spoilt after the resumed run is a loss."""

from __future__ import annotations

import json
import signal
import subprocess
from pathlib import Path

import pytest

import night
import runs
from checker import committed
from datasets import flip_bit
from processes import adopt_orphans
from runs import Ended
from states import Scenes
from shims import Orders, Shims, can_compile, crashed_in, injected
from trial import Kind, Outcome, Trial

pytestmark = pytest.mark.skipif(not can_compile(), reason="no C compiler")


@pytest.fixture(scope="module", name="scenes")
def _scenes(tmp_path_factory) -> Scenes:
    adopt_orphans()
    folder = tmp_path_factory.mktemp("night")
    made = Scenes(folder, Shims.compiled(folder), ["generate"])
    made.states = [state for state in made.states if state.half]
    return made


def _round(scenes, tmp_path, monkeypatch, outcome: Outcome, spoil=lambda work: None) -> night.Round:
    """A round with this outcome, in which something is spoilt at the end of the resumed run."""

    def run(trial: Trial) -> Ended:
        ended = undisturbed(trial)
        spoil(trial.work)
        return ended

    undisturbed = Trial.run
    monkeypatch.setattr(Trial, "run", run)
    monkeypatch.setitem(night.KINDS, "none", Kind(lambda trial: outcome))
    return night.Night(tmp_path, scenes, Shims(tmp_path), 1).round(0, ["none"])


def _nothing() -> Outcome:
    return Outcome([], "nothing", 0)


def test_without_a_fault_nothing_is_lost(scenes, tmp_path, monkeypatch):
    done = _round(scenes, tmp_path, monkeypatch, _nothing())
    assert (done.losses, done.recovered, done.resumed) == ([], True, 0)
    assert not (tmp_path / "rounds" / "0").exists()


PICTURE = "out/clips/second/ir16/000001.png"
SPOILT = {
    "a lost picture": (lambda work: (work / PICTURE).unlink(), f"lost: {PICTURE}"),
    "a changed byte": (lambda work: flip_bit(work / PICTURE), f"changed: {PICTURE}"),
    "a changed label": (
        lambda work: flip_bit(work / "out/annotations.json"),
        "changed: out/annotations.json",
    ),
    "a temporary file": (
        lambda work: (work / "out" / "dataset.json.tmp").touch(),
        "temporary: out/dataset.json.tmp",
    ),
    "a temporary folder": (
        lambda work: (work / "out" / "clips" / "x.part").mkdir(),
        "temporary: out/clips/x.part",
    ),
    "a file elsewhere": (lambda work: (work / "tmp" / "veldt_x").touch(), "temporary: tmp/veldt_x"),
    "an empty folder": (lambda work: (work / "out" / "passes").mkdir(), "extra folders: out/passes"),
    "a lost preview": (
        lambda work: (work / "out/clips/second/preview.mp4").write_bytes(b""),
        "lost previews: out/clips/second/preview.mp4",
    ),
    "a clip made again": (
        lambda work: _make_again(work / "out" / "clips" / "first" / "clip.json"),
        "out/clips/first was committed and is made again",
    ),
    "a process": (
        lambda work: subprocess.run(["sh", "-c", "sleep 3600 &"], check=True),
        "process left by the resumed run: sleep",
    ),
}


def _make_again(file: Path) -> None:
    content = file.read_bytes()
    file.unlink()
    file.write_bytes(content)


@pytest.mark.parametrize("name", SPOILT)
def test_what_is_spoilt_is_a_loss(scenes, tmp_path, monkeypatch, name):
    spoil, loss = SPOILT[name]
    if name == "a process":  # which never ends: without the patience with those that do
        monkeypatch.setattr(runs, "wait_until", lambda condition: condition())
    done = _round(scenes, tmp_path, monkeypatch, _nothing(), spoil)
    assert not done.recovered and loss in done.losses
    assert (tmp_path / "rounds" / "0" / "disturbed").is_dir()


def test_a_clip_that_lacks_frames_may_be_made_again(tmp_path):
    for name, skipped in (("whole", []), ("lacking", [{"frame": 2, "reason": "cannot be read"}])):
        record = tmp_path / "out" / "clips" / name / "clip.json"
        record.parent.mkdir(parents=True)
        record.write_text(json.dumps({"skipped": skipped}), encoding="utf-8")
    assert list(committed(tmp_path)) == ["out/clips/whole"]


ENDED = {
    "a crash": (Ended(-11, ""), "ended with -11"),
    "a run that hangs": (Ended(None, ""), "ended with None"),
    "a run that has done nothing": (Ended(0, ""), "reported as done, lost: out/clips/fifth/clip.json"),
}


@pytest.mark.parametrize("name", ENDED)
def test_how_the_disturbed_run_ended_may_be_a_loss(scenes, tmp_path, monkeypatch, name):
    ended, loss = ENDED[name]
    done = _round(scenes, tmp_path, monkeypatch, Outcome([ended], "nothing", 0))
    assert not done.recovered and any(one.startswith(loss) for one in done.losses)


@pytest.mark.parametrize("name", ["out/clips/first.part", "/elsewhere/first.part"])
def test_what_cannot_be_removed_may_be_left_over_once_it_is_named(scenes, tmp_path, monkeypatch, name):
    def inject(trial: Trial) -> Outcome:
        ended = undisturbed(trial)
        (trial.work / "out/clips/first.part/ir8").mkdir(parents=True)
        (trial.work / "out/clips/first.part/preview.mp4").write_text("half")
        warning = f"veldt: warning: cannot remove {name}: Permission denied; the next run tries again\n"
        return Outcome([Ended(ended.code, warning)], "named", 1)

    undisturbed = Trial.run
    monkeypatch.setitem(night.KINDS, "named", Kind(inject))
    done = night.Night(tmp_path, scenes, Shims(tmp_path), 1).round(0, ["named"])
    assert done.recovered == name.startswith("out")


def test_a_resumed_run_that_fails_is_a_loss(scenes, tmp_path, monkeypatch):
    done = _round(scenes, tmp_path, monkeypatch, _nothing(), lambda work: None)
    assert done.recovered
    monkeypatch.setattr(Trial, "run", lambda trial: Ended(1, "veldt: no\n"))
    done = night.Night(tmp_path, scenes, Shims(tmp_path), 1).round(0, ["none"])
    assert not done.recovered and "resumed: 1, veldt: no" in done.losses


def test_the_table_counts_by_kind():
    rounds = [
        night.Round(0, 1, "kill", "generate", faults=1, recovered=True),
        night.Round(1, 1, "kill", "generate", faults=0, recovered=True),
        night.Round(2, 1, "no memory", "generate", faults=7, recovered=False),
    ]
    rows = [line.split() for line in night.table(rounds).splitlines()]
    assert rows[1] == ["kill", "2", "1", "1", "2", "0"]
    assert rows[2] == ["no", "memory", "1", "1", "7", "0", "1"]
    assert rows[3] == ["all", "3", "2", "8", "2", "1"]


@pytest.mark.parametrize("name", ["program", "liboops.so"])
def test_a_crash_is_logged_with_the_file_that_caused_it(tmp_path, name):
    library, program = tmp_path / "liboops.so", tmp_path / "program"
    source = "void *volatile nothing; long oops(void) { return *(long *)nothing; }"
    main = (
        "int main(int count, char **words) { (void)words; return count > 1 ? (int)oops() : *(int *)nothing; }"
    )
    for text, flags in (
        (source, ["-shared", "-fPIC", "-o", library]),
        ("extern void *volatile nothing; long oops(void); " + main, ["-o", program, library]),
    ):
        subprocess.run(["cc", "-x", "c", "-", "-x", "none", *flags], input=text, text=True, check=True)
    shims, log = Shims.compiled(tmp_path), tmp_path / "log.txt"
    env = shims.preloaded(Orders("machine_shim", {"MALLOC": 1_000_000}), tmp_path, log)
    ended = subprocess.run([program, *(["twice"] if name != "program" else [])], env=env, check=False)
    assert (ended.returncode, crashed_in(log), injected(log)) == (-signal.SIGSEGV, name, 0)
