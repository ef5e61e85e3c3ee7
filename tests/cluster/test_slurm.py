"""`cluster slurm` on a real Slurm, whose nodes crash and whose disks fill: the dataset of an undivided run comes out.

One dataset is made once, with all faults (`_made`); the tests look at what came of each of them.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from configs import tiny
from gate import Gate
from processes import knows_of, parent_of, running_with, wait_until
from program import PROGRAM, Veldt, files_below
from slurm import Slurm, running_slurm
from small_disk import BLOCK, SmallDisk, small_disk

NODES = 3
SHARDS = 8
CLIPS = 40
CRASHED, REQUEUED, FULL, STOPPED, BROKEN, CANCELLED = range(1, 7)  # shards, by what happens to them

# What the nodes find on PATH: the program, held in some shards, and with an option that it does not know in one.
_PROGRAM = f"""\
#!/bin/sh
exec env $(cat "held_$SLURM_ARRAY_TASK_ID" 2>/dev/null) \\
  "{PROGRAM}" "$@" $(cat "wrong_options_$SLURM_ARRAY_TASK_ID" 2>/dev/null)
"""


def _config() -> dict:
    """Five clips a shard."""
    config = tiny()
    config["render"] = {"actor_layer": True, "engine": "embree"}
    two = config["clips"]
    config["clips"] = [
        two[k % 2] | {"id": f"clip{k:02d}", "start_s": k // 2, "frames": 20} for k in range(CLIPS)
    ]
    return config


@dataclass
class Made:
    """What came of the jobs."""

    veldt: Veldt
    slurm: Slurm
    arrays: list[dict[int, dict[str, str]]] = field(
        default_factory=list
    )  # what Slurm says at the end, by shard
    merges: list[tuple[str, str]] = field(default_factory=list)  # state and output
    crashed_node: str = ""
    no_disk: str = ""  # why no shard had a full disk

    def hand_in(self, *options) -> tuple[str, str]:
        """Run the script that `veldt cluster slurm` wrote; the numbers of the array and of the job that merges it."""
        folder = self.veldt.folder
        environment = {"PATH": f"{folder}/bin:{os.environ['PATH']}", "TMPDIR": f"{folder}/scratch"}
        said = self.slurm.command("bash", "jobs", *options, cwd=folder, env=environment)
        (merge,) = re.findall(r"^Submitted batch job (\d+)$", said, re.MULTILINE)
        return re.match(r"afterany:(\d+)_", self.slurm.jobs(merge)[merge]["Dependency"])[1], merge

    def wait(self, array: str, merge: str) -> None:
        """Wait for the merge, and keep what came of all jobs."""
        state = self.slurm.wait(merge)[merge]
        self.merges.append((state, self.log(merge)))
        jobs = self.slurm.jobs(array)
        self.arrays.append({int(jobs[name]["ArrayTaskId"]): jobs[name] for name in sorted(jobs)})

    def log(self, job: str) -> str:
        """What a job has printed."""
        return (self.veldt.folder / f"slurm-{job}.out").read_text(encoding="utf-8")

    def shard_log(self, shard: int) -> str:
        """What a shard of the first array has printed."""
        return self.log(f"{self.arrays[0][shard]['ArrayJobId']}_{shard}")

    def clips_of(self, shard: int) -> int:
        """How many clips a shard has finished."""
        return len(list((self.veldt.folder / f"shards/{shard}/clips").glob("clip??/clip.json")))

    def ends(self, array: int) -> dict[int, tuple[str, str, str]]:
        """State, exit code (with a signal) and number of requeues of the shards of an array."""
        jobs = self.arrays[array].items()
        return {shard: (job["JobState"], job["ExitCode"], job["Restarts"]) for shard, job in jobs}


def _gate(made: Made, library: Path, shard: int, stack: ExitStack) -> Gate:
    """Has a shard held after its first clip."""
    folder = made.veldt.folder / f"gate{shard}"
    folder.mkdir()
    gate = stack.enter_context(Gate(folder, library))
    only = ("--plan", "plan", "--shard", f"{shard}/{SHARDS}", "--out", "none", "--dry-run")
    second = made.veldt("generate", *only).out.splitlines()[2].split()[0]  # below the titles
    settings = gate.variables(f"/{second}.part/ir8")
    made.veldt.write(f"held_{shard}", " ".join(f"{name}={value}" for name, value in settings.items()))
    return gate


def _disturb(made: Made, array: str, gates: dict[int, Gate]) -> None:
    """Disturb four shards, each of them between two clips; there are nodes for three at a time."""
    for shard in (CRASHED, REQUEUED, STOPPED):
        gates[shard].wait_for()
        assert made.clips_of(shard) == 1
    crashed = f"{array}_{CRASHED}"
    made.crashed_node = made.slurm.jobs(crashed)[crashed]["NodeList"]
    made.slurm.kill_node(made.crashed_node)
    made.slurm.command("scontrol", "requeue", f"{array}_{REQUEUED}")
    stopped = gates[STOPPED].held()
    os.kill(parent_of(stopped), signal.SIGTERM)  # the script alone, as before a time limit
    assert wait_until(lambda: knows_of(stopped, signal.SIGTERM)), made.slurm.logs()
    for shard in (CRASHED, REQUEUED, STOPPED):
        gates[shard].open()
    gates[CANCELLED].wait_for()
    made.slurm.command("scancel", f"{array}_{CANCELLED}")
    gates[CANCELLED].open()


def _free_space(made: Made, job: str, disk: SmallDisk) -> None:
    """Free disk space once a job was requeued."""
    assert wait_until(lambda: made.slurm.jobs(job)[job]["Restarts"] != "0"), made.slurm.logs()
    disk.free_space()


def _prepare(veldt: Veldt) -> None:
    for name in ("bin", "scratch", "shards"):
        (veldt.folder / name).mkdir()
    veldt.write("bin/veldt", _PROGRAM).chmod(0o755)
    veldt.write("config.json", _config())
    veldt.write(f"wrong_options_{BROKEN}", "--seasons all")
    small = ("--shards", SHARDS, "--nodes", NODES, "--cores", 1, "--memory-gb", 1)
    for arguments in (
        ["plan", "config.json", "--out", "plan", "--quiet"],
        ["cluster", "slurm", "plan", *small, "--out", "jobs"],
    ):
        done = veldt(*arguments)
        assert (done.code, done.out, done.err) == (0, "", "")


@pytest.fixture(scope="module", name="made")
def _made(tmp_path_factory, gate_library) -> Iterator[Made]:
    veldt = Veldt(tmp_path_factory.mktemp("made"))
    with ExitStack() as stack:
        made = Made(veldt, stack.enter_context(running_slurm(NODES)))
        _prepare(veldt)
        try:
            disk = stack.enter_context(small_disk(veldt.folder / f"shards/{FULL}", "8m"))
            disk.leave(400 * BLOCK)  # two clips fit in
        except pytest.skip.Exception as reason:
            disk, made.no_disk = None, str(reason)
        shards = (CRASHED, REQUEUED, STOPPED, CANCELLED)
        gates = {shard: _gate(made, gate_library, shard, stack) for shard in shards}
        array, merge = made.hand_in()
        _disturb(made, array, gates)
        if disk:
            _free_space(made, f"{array}_{FULL}", disk)
        made.wait(array, merge)
        (veldt.folder / f"wrong_options_{BROKEN}").unlink()
        made.wait(*made.hand_in(f"--array={BROKEN},{CANCELLED}"))
        yield made


def test_undisturbed_shards_run_once(made):
    ends = made.ends(0)
    assert sorted(ends) == list(range(SHARDS))
    assert {ends[shard] for shard in (0, 7)} == {("COMPLETED", "0:0", "0")}


def test_a_shard_that_fails_fails_alone_and_once(made):
    assert made.ends(0)[BROKEN] == ("FAILED", "2:0", "0")
    assert made.shard_log(BROKEN) == "veldt: unknown option --seasons; see veldt generate --help\n"


def test_a_crashed_node_leaves_its_shard_to_another(made):
    assert made.ends(0)[CRASHED] == ("COMPLETED", "0:0", "1")
    assert made.arrays[0][CRASHED]["NodeList"] != made.crashed_node
    made.slurm.start_node(made.crashed_node)
    assert wait_until(lambda: made.slurm.node_state(made.crashed_node) == "idle")


def test_a_requeued_shard_goes_on(made):
    assert made.ends(0)[REQUEUED] == ("COMPLETED", "0:0", "1")


def test_a_shard_waits_for_disk_space(made):
    if made.no_disk:
        pytest.skip(made.no_disk)
    assert made.ends(0)[FULL] == ("COMPLETED", "0:0", "1")
    log = made.shard_log(FULL)
    assert len(re.findall(r"No space left on device|B left; expected at least", log)) == 1
    assert "already existed" in log


def test_a_shard_that_is_stopped_before_its_time_limit_goes_on(made):
    assert made.ends(0)[STOPPED] == ("COMPLETED", "0:0", "1")
    assert made.shard_log(STOPPED).count("veldt: stopped on request") == 1


def test_a_cancelled_shard_stays_cancelled(made):
    state, _, restarts = made.ends(0)[CANCELLED]
    assert (state, restarts) == ("CANCELLED", "0")


def test_merge_lists_the_shards_to_run_again(made):
    (state, said), (later_state, later_said) = made.merges
    assert (state, later_state) == ("FAILED", "COMPLETED")
    assert f"veldt: run these of {SHARDS} shards again: {BROKEN},{CANCELLED}\n" in said
    merged = [int(re.search(r"(\d+) clips merged", text)[1]) for text in (said, later_said)]
    assert sum(merged) == CLIPS and "the dataset is not complete yet" in said
    assert {end[0] for end in made.ends(1).values()} == {"COMPLETED"}


def test_the_dataset_is_that_of_an_undivided_run(made):
    done = made.veldt("generate", "config.json", "--out", "whole", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    merged, whole = (_bytes_of(made.veldt.folder / name) for name in ("dataset", "whole"))
    assert sorted(merged) == sorted(whole)
    assert [name for name in whole if merged[name] != whole[name]] == []
    assert made.veldt("validate", "dataset").code == 0
    assert len(made.veldt.read("dataset/annotations.json")["annotations"]) > CLIPS


def _bytes_of(folder: Path) -> dict[str, bytes]:
    """Everything in a dataset but its plan, which a merged one lacks."""
    names = [name for name in files_below(folder) if not name.startswith("plan/")]
    return {name: (folder / name).read_bytes() for name in names}


# Starts a cluster and a job that would last for an hour, and waits.
_KILLED = """\
import time
from slurm import running_slurm
with running_slurm(nodes=1) as slurm:
    script = slurm.folder / "job.sh"
    script.write_text("#!/bin/sh\\nsleep 3600 &\\nwait\\n")
    job = slurm.sbatch(script, "--output=/dev/null")
    while slurm.states(job)[job] != "RUNNING":
        time.sleep(0.1)
    print(slurm.folder, flush=True)
    time.sleep(3600)
"""


def test_no_process_outlives_a_killed_test(made):
    """Daemons and the script of a job have the cluster's folder in their command lines."""
    search = {"PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(
        [sys.executable, "-B", "-c", _KILLED], env=os.environ | search, stdout=subprocess.PIPE, text=True
    ) as test:
        folder = test.stdout.readline().strip()
        assert folder and folder != str(made.slurm.folder)
        assert wait_until(lambda: running_with(f"{folder}/n0/job"))
        test.kill()
    assert wait_until(lambda: not running_with(folder)), running_with(folder)
    shutil.rmtree(folder)
    assert running_with(made.slurm.folder)
