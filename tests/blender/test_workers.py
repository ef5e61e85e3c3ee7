"""Planning on several cores gives what planning on one gives, and survives what may happen to a process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from processes import wait_until
from scenes import tiny
from veldt.config import ROOT
from veldt.faults import ConfigError
from veldt.workers import Cores, in_order

SCRIPT = ROOT / "blender_scripts" / "plan_scene.py"


def _square(value: int) -> int:
    return value * value


def _fault_beyond_two(value: int) -> int:
    if value > 2:
        raise ConfigError(f"value = {value}; expected at most 2")
    return value


@pytest.mark.parametrize("processes", [1, 2, 5])
@pytest.mark.parametrize("count", [0, 1, 7, 100])
def test_results_come_in_the_order_of_the_items(processes, count):
    assert list(in_order(_square, range(count), processes)) == [k * k for k in range(count)]


@pytest.mark.parametrize("processes", [1, 2])
def test_the_first_fault_of_the_config_is_the_one_reported(processes):
    with pytest.raises(ConfigError, match="value = 3; expected at most 2"):
        list(in_order(_fault_beyond_two, range(50), processes))


def test_a_fault_of_the_scripts_is_raised_with_its_own_place():
    with pytest.raises(ZeroDivisionError) as fault:
        list(in_order(lambda value: 1 // value, [2, 1, 0], 2))
    assert fault.traceback[-1].path == Path(__file__)


def test_work_goes_on_here_if_a_worker_is_killed():
    here = os.getpid()

    def act(value: int) -> int:
        if value == 3 and os.getpid() != here:
            os.kill(os.getpid(), signal.SIGKILL)
        return value

    assert list(in_order(act, range(10), 2)) == list(range(10))


def test_no_worker_outlives_a_killed_planner(tmp_path):
    script = (
        "import os, sys, time\n"
        f"sys.path.insert(0, {str(ROOT / 'blender_scripts')!r})\n"
        "from veldt.workers import in_order\n"
        "def act(k):\n"
        "    open(os.path.join(sys.argv[1], str(os.getpid())), 'w').close()\n"
        "    time.sleep(60)\n"
        "list(in_order(act, range(8), 2))\n"
    )
    with subprocess.Popen([sys.executable, "-B", "-c", script, str(tmp_path)]) as planner:
        assert wait_until(lambda: len(list(tmp_path.iterdir())) == 2, 30)
        planner.kill()
    workers = [int(path.name) for path in tmp_path.iterdir()]
    assert wait_until(lambda: not any(_is_running(worker) for worker in workers), 30)


def _is_running(process: int) -> bool:
    try:
        state = Path(f"/proc/{process}/stat").read_text(encoding="utf-8")
    except FileNotFoundError:
        return False
    return state.rpartition(")")[2].split()[0] != "Z"


def _plan(config: dict, processes: int) -> tuple[str, list[dict]]:
    reader, writer = os.pipe()
    with open(reader, encoding="utf-8") as events:
        command = [sys.executable, "-B", str(SCRIPT), "--config", "-"]
        done = subprocess.run(
            [*command, "--processes", str(processes), "--events-fd", str(writer)],
            input=json.dumps(config),
            pass_fds=[writer],
            capture_output=True,
            text=True,
            check=True,
        )
        os.close(writer)
        return done.stdout, [json.loads(line) for line in events]


def test_a_plan_is_the_same_on_any_number_of_cores_and_says_how_far_it_is():
    config = tiny()
    clip = config["clips"][0]
    config["clips"] = [clip | {"id": f"c{k}", "start_s": 0.1 * k} for k in range(9)]
    alone, events = _plan(config, 1)
    assert _plan(config, 3) == (alone, events)
    assert [event["id"] for event in events] == [f"c{k}" for k in range(9)]
    assert events[-1] == {"event": "planned", "id": "c8", "done": 9, "total": 9}


@pytest.mark.parametrize("processes", [1, 2])
def test_started_work_has_the_same_result_anywhere(processes):
    assert Cores(processes).start(lambda: np.arange(1000) ** 2)().tolist() == [k * k for k in range(1000)]


def test_started_work_goes_on_here_if_its_process_is_killed():
    here = os.getpid()

    def act() -> str:
        if os.getpid() != here:
            os.kill(os.getpid(), signal.SIGKILL)
        return "done"

    assert Cores(2).start(act)() == "done"


def test_a_fault_in_started_work_is_raised_with_its_own_place():
    with pytest.raises(ZeroDivisionError) as fault:
        Cores(2).start(lambda: 1 // 0)()
    assert fault.traceback[-1].path == Path(__file__)


def test_a_baked_plan_is_the_same_on_any_number_of_cores(tmp_path):
    config = tiny()
    for processes in (1, 3):
        (tmp_path / str(processes)).mkdir()
        command = [
            sys.executable,
            "-B",
            str(SCRIPT),
            "--config",
            "-",
            "--out",
            str(tmp_path / str(processes)),
        ]
        command += ["--processes", str(processes)]
        subprocess.run(command, input=json.dumps(config), capture_output=True, text=True, check=True)
    alone, together = (
        {file.relative_to(tmp_path / name): file.read_bytes() for file in (tmp_path / name).rglob("*.*")}
        for name in ("1", "3")
    )
    assert len(alone) == 7 and alone == together
