"""Planning on several cores gives what planning on one gives, and ends if one of its processes is lost."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from processes import HELD_S, wait_until
from scenes import tiny
from planner.config import ROOT
from planner.failures import failure_of
from planner.faults import ConfigError, ProcessLost
from planner.workers import Cores, end_with, in_order

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


KILLED = r"a worker process was killed by signal 9 \(Killed\)"


def _end_here() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def test_a_killed_worker_is_noticed_while_others_work_and_they_are_ended(tmp_path):
    def act(value: int) -> None:
        (tmp_path / str(os.getpid())).touch()
        if value == 3:
            _end_here()
        time.sleep(HELD_S if value > 0 else 0)

    with pytest.raises(ProcessLost, match=KILLED) as lost:
        list(in_order(act, range(10), 4))
    assert lost.value.killed
    assert not any(_is_running(int(path.name)) for path in tmp_path.iterdir())


def _wait_until_one_ended() -> None:
    """Wait until a process that this one has started ends, and leave it to be waited for."""
    os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOWAIT)


def test_a_worker_that_is_killed_while_it_sends_a_result_is_noticed():
    first_is_here, go = os.pipe()

    def act(value: int) -> bytes:
        if value == 1:
            os.read(first_is_here, 1)
            threading.Timer(0.2, _end_here).start()
        return bytes(10_000_000)  # more than the connection holds

    results = in_order(act, range(2), 2)
    next(results)
    os.write(go, b"1")
    _wait_until_one_ended()
    with pytest.raises(ProcessLost, match=KILLED):
        list(results)


def test_a_worker_that_ends_by_itself_is_no_reason_to_try_again():
    with pytest.raises(ProcessLost, match="a worker process ended with exit code 7") as lost:
        list(in_order(lambda value: os._exit(7), range(10), 2))  # pylint: disable=protected-access
    assert failure_of(lost.value).exit_code == 1


def test_a_killed_worker_is_reported_as_killed_programs_are():
    failure = failure_of(ProcessLost("a worker process", -signal.SIGKILL))
    hint = "unless someone killed it, the machine may have run out of memory"
    assert failure.in_words() == f"a worker process was killed by signal 9 (Killed); {hint}"
    assert failure.exit_code == 75


def test_without_processes_the_work_is_done_here(monkeypatch):
    def refuse() -> int:
        raise BlockingIOError("Resource temporarily unavailable")

    monkeypatch.setattr(os, "fork", refuse)
    assert list(in_order(_square, range(10), 2)) == [k * k for k in range(10)]
    assert Cores(2).start(lambda: 7)() == 7


def test_slow_and_large_results_come_in_order():
    def act(value: int) -> np.ndarray:
        time.sleep(0.05 if value % 3 == 0 else 0)
        return np.full(200_000, value)

    assert [result[0] for result in in_order(act, range(40), 3)] == list(range(40))


def test_a_process_whose_parent_ended_before_it_asked_ends():
    process = os.fork()
    if process == 0:
        end_with(os.getpid())  # not the parent
        os._exit(0)  # pylint: disable=protected-access
    assert os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]) == -signal.SIGKILL


def test_no_worker_outlives_a_killed_planner(tmp_path):
    script = (
        "import os, sys, time\n"
        f"sys.path.insert(0, {str(ROOT / 'blender_scripts')!r})\n"
        "from planner.workers import in_order\n"
        "def act(k):\n"
        "    open(os.path.join(sys.argv[1], str(os.getpid())), 'w').close()\n"
        f"    time.sleep({HELD_S})\n"
        "list(in_order(act, range(8), 2))\n"
    )
    with subprocess.Popen([sys.executable, "-B", "-c", script, str(tmp_path)]) as planner:
        assert wait_until(lambda: len(list(tmp_path.iterdir())) == 2)
        planner.kill()
    workers = [int(path.name) for path in tmp_path.iterdir()]
    assert wait_until(lambda: not any(_is_running(worker) for worker in workers))


def _is_running(process: int) -> bool:
    try:
        state = Path(f"/proc/{process}/stat").read_text(encoding="utf-8")
    except (FileNotFoundError, ProcessLookupError):  # the latter if it ends between opening and reading
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


def test_a_killed_process_of_started_work_is_noticed():
    wait = Cores(2).start(_end_here)
    with pytest.raises(ProcessLost, match=KILLED):
        wait()


def test_started_work_that_is_killed_while_it_sends_its_result_is_noticed():
    def act() -> bytes:
        threading.Timer(0.2, _end_here).start()
        return bytes(10_000_000)

    wait = Cores(2).start(act)
    _wait_until_one_ended()
    with pytest.raises(ProcessLost, match=KILLED):
        wait()


def test_started_work_that_is_killed_is_noticed_while_others_work():
    cores = Cores(2)
    cores.start(_end_here)
    with pytest.raises(ProcessLost, match=KILLED):
        list(cores.map(lambda value: time.sleep(HELD_S), range(4)))


def test_results_of_started_work_are_kept_while_others_work():
    cores = Cores(2)
    waits = [cores.start(lambda k=k: np.full(1_000_000, k)) for k in range(3)]
    assert list(cores.map(_square, range(100))) == [k * k for k in range(100)]
    assert [wait()[0] for wait in waits] == [0, 1, 2]


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
