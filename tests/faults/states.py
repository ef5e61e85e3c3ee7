"""What is disturbed: ways to make a dataset, step by step, with the state of the folder before and after each step."""

from __future__ import annotations

import shutil
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

import fake_blender
from configs import tiny
from program import PROGRAM, Veldt
from runs import run_to_end
from shims import TALLY, Shims, tally

CLIPS = ("first", "second", "third", "fourth", "fifth")
_QUIET = ("--threads", "2", "--progress", "none")


def config(engine: str = "embree") -> dict:
    """Small clips of different lengths, with plants and actors."""
    small = tiny()
    small["camera"] = {"width_px": 64, "height_px": 48, "pixel_pitch_um": 100}
    small["render"] = {"actor_layer": True, "engine": engine}
    down, side = small["clips"]
    small["clips"] = [
        (side if k % 2 else down) | {"id": name, "frames": 3 + k, "start_s": k / 2}
        for k, name in enumerate(CLIPS)
    ]
    return small


def _generate(*options: str, out: str = "out") -> tuple[str, ...]:
    return ("generate", *options, "--out", out, *_QUIET)


def _shards(out: tuple[str, str], *options: str) -> list[tuple[str, ...]]:
    return [_generate(*options, "--shard", f"{k}/2", out=out[k]) for k in range(2)]


_PASSES = [f"made/passes/{clip}" for clip in CLIPS]
_PLAN = ("plan", "config.json", "--out", "plan", *_QUIET)
_MERGE = ("merge", "one", "two", "--out", "whole", "--progress", "none")

STEPS: dict[str, list[tuple[str, ...]]] = {
    "generate": [_generate("config.json")],
    "keep passes": [_generate("config.json", "--keep-passes")],
    "shards in a folder": _shards(("out", "out"), "config.json"),
    "shards and merge": [*_shards(("one", "two"), "config.json"), _MERGE],
    "planned shards": [
        _PLAN,
        *_shards(("one", "two"), "--plan", "plan"),
        (*_MERGE, "--plan", "plan", "--shards", "2"),
    ],
    "planned with scratch": [
        _PLAN,
        *(
            _generate("--plan", "plan", "--shard", f"{k}/2", "--scratch", f"scratch{k}", out=name)
            for k, name in enumerate(("one", "two"))
        ),
    ],
    "convert": [
        _generate("config.json", "--keep-passes", out="made"),
        ("convert", *_PASSES, "--config", "config.json", "--out", "out", *_QUIET),
    ],
    "stand-in for Blender": [
        _generate("blender.json", "--jobs", "2", "--blender", "../../../fake_blender"),
    ],
}
# Half of a step, to start from what an earlier run has left: options that are added to it.
_HALF = {"generate": ("--clips", "first,third")}


@dataclass
class State:
    """A folder to start a step from, and what the step then makes of it."""

    scene: str
    step: tuple[str, ...]
    half: bool
    before: Path
    after: Path
    takes_s: float
    calls: dict[tuple[str, str], int] = field(default_factory=dict)

    def is_making(self) -> bool:
        """Whether the step makes clips from a plan that it keeps in the dataset's folder."""
        return self.step[0] == "generate" and "--plan" not in self.step

    def where(self) -> str:
        """In words."""
        return f"{self.scene}: {' '.join(self.step[:2])}{', half made' if self.half else ''}"


def copy(folder: Path, to: Path) -> None:
    """Copy a folder, with links and times."""
    shutil.rmtree(to, ignore_errors=True)
    to.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run(["cp", "-a", folder, to], check=True)


class Scenes:
    """All states, made once without faults."""

    def __init__(self, base: Path, shims: Shims, names: list[str] | None = None):
        self._base, self._shims = base, shims
        self.states: list[State] = []
        fake_blender.install(base)
        for name in names or STEPS:
            self._prepare(name)

    def _prepare(self, name: str) -> None:
        folder = self._base / "states" / name.replace(" ", "_")
        work = folder / "0"
        (work / "tmp").mkdir(parents=True)
        for engine, file in (("embree", "config.json"), ("blender", "blender.json")):
            Veldt(work).write(file, config(engine))
        for number, step in enumerate(STEPS[name]):
            after = folder / str(number + 1)
            copy(work, after)
            seconds = self._run(step, after)
            calls = self._tally(work, step, folder)
            self.states.append(State(name, step, False, work, after, seconds, calls))
            if step[0] in _HALF and not self._is_sharded(step):
                half = folder / f"{number}_half"
                copy(work, half)
                self._run((*step, *_HALF[step[0]]), half)
                self.states.append(State(name, step, True, half, after, seconds, calls))
            work = after

    @staticmethod
    def _is_sharded(step: tuple[str, ...]) -> bool:
        return "--shard" in step

    def _run(self, step: tuple[str, ...], work: Path, env: dict[str, str] | None = None) -> float:
        start_s = time.monotonic()
        done = run_to_end(step, work, env=env)
        if done.code != 0:
            raise RuntimeError(f"{PROGRAM} {' '.join(step)} in {work} fails without faults: {done}")
        return time.monotonic() - start_s

    def _tally(self, before: Path, step: tuple[str, ...], folder: Path) -> dict[tuple[str, str], int]:
        """The calls of a step, as the library sees them."""
        work, log = folder / "tally", folder / "calls.txt"
        log.unlink(missing_ok=True)
        log.touch()
        copy(before, work)
        env = self._shims.preloaded(TALLY, work, log)
        env["VELDT_PYTHON"] = str(self._shims.python(folder / "python", env))
        self._run(step, work, env)
        shutil.rmtree(work)
        return tally(log)
