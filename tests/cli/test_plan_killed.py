"""`plan` and `generate` killed while the planner works, and it with them or alone: the same command then makes the same
plan, and nothing of the killed run is left."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

import fake_blender
import held_planner
from configs import CLIPS, tiny
from processes import PATIENCE_S, parent_of, parents, running_with, wait_until
from program import Veldt, files_below

WRITTEN = {  # at a moment: files in the unfinished plan that must, and must not, be there
    "planning": ((), ("scene.bin", "tracks")),
    "baking the scene": (("scene.bin",), ("scene.json", "tracks")),
    "baking tracks": (("scene.json", "tracks"), ("plan.json",)),
}
ARGUMENTS = {
    "plan": ("--threads", "2", "--progress", "none"),
    "generate": ("--threads", "2", "--progress", "none", "--blender", "./fake_blender"),
}
HINT = "unless someone killed it, the machine may have run out of memory"
FOLDER = {"plan": "out", "generate": "out/plan"}  # of the plan, by command


def _prepare(veldt: Veldt) -> None:
    veldt.write("config.json", tiny())
    fake_blender.install(veldt.folder)
    held_planner.install(veldt.folder)


def _run(veldt: Veldt, command: str) -> None:
    done = veldt(command, "config.json", "--out", veldt.folder / "out", *ARGUMENTS[command])
    assert (done.code, done.err) == (0, "")


@pytest.fixture(autouse=True)
def _ready(veldt):
    _prepare(veldt)


@pytest.fixture(scope="module", name="usual")
def _usual(tmp_path_factory) -> dict[str, dict[str, bytes]]:
    """By command, all files of the plan of a run that was not disturbed."""
    plans = {}
    for command, folder in FOLDER.items():
        veldt = Veldt(tmp_path_factory.mktemp(command))
        _prepare(veldt)
        _run(veldt, command)
        plans[command] = _content(veldt.folder / folder)
    return plans


def _content(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in files_below(folder)}


def _start(veldt: Veldt, command: str, moment: str):
    """A run whose planner is held at a moment, and the planner's process."""
    held_planner.hold_at(veldt.folder, moment)
    run = veldt.start(
        command,
        "config.json",
        "--out",
        veldt.folder / "out",
        *ARGUMENTS[command],
        env={"VELDT_PYTHON": str(veldt.folder / "held_python")},
    )
    assert wait_until(lambda: held_planner.is_held(veldt.folder))
    part = _part(veldt, command)
    there, missing = WRITTEN[moment]
    assert all((part / name).exists() for name in there)
    assert not any((part / name).exists() for name in missing)
    if moment == "baking tracks":
        assert any((part / "tracks" / f"{clip}.json").exists() for clip in CLIPS)
    (planner,) = [process for process in running_with(part) if parent_of(process) == run.pid]
    return run, planner


def _part(veldt: Veldt, command: str) -> Path:
    return veldt.folder / f"{FOLDER[command]}.part"


def _check_nothing_runs(veldt: Veldt, command: str) -> None:
    """Neither the planner nor a worker of it."""
    assert wait_until(lambda: not running_with(_part(veldt, command)))


def _check_again(veldt: Veldt, command: str, usual: dict) -> None:
    """The same command makes the same plan, and leaves nothing else."""
    _run(veldt, command)
    assert _content(veldt.folder / FOLDER[command]) == usual[command]
    assert not [path for path in veldt.folder.rglob("*") if path.name.endswith((".part", ".tmp"))]
    if command == "plan":
        ours = {"config.json", "fake_blender", "held_python", "planner_is_held.txt"}
        assert {path.name for path in veldt.folder.iterdir()} == ours | {"out"}
    _check_nothing_runs(veldt, command)


@pytest.mark.parametrize("moment", held_planner.MOMENTS)
@pytest.mark.parametrize("command", FOLDER)
def test_killed_it_takes_its_planner_along_and_starts_again(veldt, usual, command, moment):
    run, _ = _start(veldt, command, moment)
    run.kill()
    run.communicate()
    assert run.returncode == -signal.SIGKILL
    _check_nothing_runs(veldt, command)
    assert not (veldt.folder / FOLDER[command] / "plan.json").exists()
    assert _part(veldt, command).is_dir()
    _check_again(veldt, command, usual)


@pytest.mark.parametrize("moment", held_planner.MOMENTS)
@pytest.mark.parametrize("command", FOLDER)
def test_a_killed_planner_is_reported_and_leaves_nothing(veldt, usual, command, moment):
    run, planner = _start(veldt, command, moment)
    os.kill(planner, signal.SIGKILL)
    out, err = run.communicate(timeout=PATIENCE_S)
    how = f"{veldt.folder}/held_python plan_scene.py was killed by signal 9 (Killed)"
    assert (run.returncode, out, err) == (75, "", f"veldt: {how}; {HINT}\n")
    _check_nothing_runs(veldt, command)
    assert not _part(veldt, command).exists() and not (veldt.folder / FOLDER[command]).exists()
    _check_again(veldt, command, usual)


@pytest.mark.parametrize("command", FOLDER)
def test_a_killed_worker_of_the_planner_is_reported_at_once_and_leaves_nothing(veldt, usual, command):
    run, planner = _start(veldt, command, "baking tracks")
    worker = max(process for process, parent in parents().items() if parent == planner)
    os.kill(worker, signal.SIGKILL)
    out, err = run.communicate(timeout=PATIENCE_S)  # less than the others are held
    how = f"{veldt.folder}/held_python plan_scene.py ended with exit code 75"
    why = "a worker process was killed by signal 9 (Killed)"
    assert (run.returncode, out, err) == (75, "", f"veldt: {how}: {why}; {HINT}\n")
    _check_nothing_runs(veldt, command)
    assert not _part(veldt, command).exists() and not (veldt.folder / FOLDER[command]).exists()
    _check_again(veldt, command, usual)


@pytest.mark.parametrize("moment", held_planner.MOMENTS)
def test_both_killed_at_once_it_starts_again(veldt, usual, moment):
    """As the kernel does when a container runs out of memory."""
    run, planner = _start(veldt, "plan", moment)
    os.kill(run.pid, signal.SIGSTOP)  # it must not see its planner end
    os.kill(planner, signal.SIGKILL)
    run.kill()
    run.communicate()
    _check_nothing_runs(veldt, "plan")
    _check_again(veldt, "plan", usual)


def test_killed_while_it_plans_again_the_old_plan_stays(veldt, usual):
    """A plan of another config is replaced in one step, when the new one is whole."""
    veldt.write("config.json", tiny(lambda config: config.update(seed=8)))
    _run(veldt, "plan")
    old = _content(veldt.folder / "out")
    veldt.write("config.json", tiny())
    run, _ = _start(veldt, "plan", "baking tracks")
    run.kill()
    run.communicate()
    _check_nothing_runs(veldt, "plan")
    assert _content(veldt.folder / "out") == old
    _check_again(veldt, "plan", usual)
