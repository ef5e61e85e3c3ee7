"""Shards as jobs of a real Slurm, on nodes that crash and disks that fill: the dataset of an undivided run comes out.

One dataset is made once, with all faults (`_made`); the tests look at what came of each of them.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from configs import tiny
from processes import parent_of, running_with, wait_until
from program import PROGRAM, Veldt, files_below
from slurm import Slurm, running_slurm
from small_disk import BLOCK, SmallDisk, small_disk

SHARDS = 8
CLIPS = [f"clip{k:02d}" for k in range(40)]
CRASHED, REQUEUED, FULL, STOPPED, BROKEN = 1, 2, 3, 4, 5  # shards, by what happens to them
_LONG = (CRASHED, REQUEUED, STOPPED)  # with clips long enough to halt them after the first

# What a user hands in. `veldt` is a file beside it, which runs the program.
_SHARD = f"""\
#!/bin/sh
#SBATCH --array=0-{SHARDS - 1} --requeue --open-mode=append --output=%a.log --time=5 --signal=B:TERM@120
# Slurm's array variables change when one shard is run again, so the number of shards is written here.
./veldt generate config.json --engine embree --shard "$SLURM_ARRAY_TASK_ID/{SHARDS}" \\
  --out "$PWD/shards/000$SLURM_ARRAY_TASK_ID" --quiet --threads 1 &
run=$!
trap 'kill -TERM $run' TERM # before the time limit Slurm signals this shell alone
wait $run
code=$?
while kill -0 $run 2>/dev/null; do # a signal has interrupted wait
  wait $run
  code=$?
done
echo "run ${{SLURM_RESTART_COUNT:-0}} on $SLURMD_NODENAME: exit $code"
# 75: try again later; 143: stopped by SIGTERM. A job that is being cancelled or requeued is not RUNNING.
case $code in
75 | 143)
  if [ "${{SLURM_RESTART_COUNT:-0}}" -lt 5 ] && [ "$(squeue -h -j "$SLURM_JOB_ID" -o %T)" = RUNNING ]; then
    scontrol requeue "$SLURM_JOB_ID"
  fi
  ;;
esac
exit $code
"""

_MERGE = """\
#!/bin/sh
./veldt merge shards/* --out merged --progress none
"""

_PROGRAM = f"""\
#!/bin/sh
exec "{PROGRAM}" "$@" $(cat "wrong_options_$SLURM_ARRAY_TASK_ID" 2>/dev/null)
"""


def _config() -> dict:
    config = tiny()
    config["render"] = {"actor_layer": True}
    down, side = config["clips"]
    config["clips"] = [
        (down, side)[k % 2] | {"id": clip, "start_s": k // 2, "frames": 40 if k % SHARDS in _LONG else 6}
        for k, clip in enumerate(CLIPS)
    ]
    return config


def _bytes_of(folder: Path) -> dict[str, bytes]:
    """Everything in a dataset but its plan, which a merged one lacks."""
    names = [name for name in files_below(folder) if not name.startswith("plan/")]
    return {name: (folder / name).read_bytes() for name in names}


@dataclass
class Made:
    """What came of the jobs."""

    veldt: Veldt
    slurm: Slurm
    arrays: list[dict[str, dict]] = field(default_factory=list)  # what Slurm says at the end, by ID_INDEX
    merges: list[tuple[str, str]] = field(default_factory=list)  # state and output
    crashed_node: str = ""
    no_disk: str = ""  # why no shard had a full disk

    def hand_in(self, script: str, *options) -> str:
        """Hand in a script of the folder; the number of the job."""
        return self.slurm.sbatch(self.veldt.folder / script, f"--chdir={self.veldt.folder}", *options)

    def merge_after(self, array: str) -> None:
        """Hand in what merges the shards once an array has ended, and wait for that."""
        job = self.hand_in("merge.sh", f"--dependency=afterany:{array}", f"--output=merge_{array}.log")
        state = self.slurm.wait(job, 180)[job]
        self.merges.append((state, self.log(f"merge_{array}")))
        self.arrays.append(self.slurm.jobs(array))

    def clips_of(self, shard: int) -> int:
        """How many clips a shard has finished."""
        found = (self.veldt.folder / f"shards/000{shard}/clips").glob("*/clip.json")
        return len([file for file in found if file.parent.name in CLIPS])

    def log(self, name: str | int) -> str:
        """What a job has printed."""
        return (self.veldt.folder / f"{name}.log").read_text(encoding="utf-8")

    def runs(self, shard: int) -> list[tuple[int, int]]:
        """The runs of a shard that came to an end: how often it was requeued before, and the exit code."""
        ended = re.findall(r"^run (\d+) on \w+: exit (\d+)$", self.log(shard), re.MULTILINE)
        return [(int(number), int(code)) for number, code in ended]


def _hold(made: Made, shards: tuple[int, ...]) -> dict[int, int]:
    """Halt shards, each of them as soon as it has finished its first clip; their processes."""
    held = {}
    end = time.monotonic() + 120
    while len(held) < len(shards):
        assert time.monotonic() < end, f"only shards {list(held)} have made a clip\n{made.slurm.logs()}"
        for shard in set(shards) - set(held):
            if made.clips_of(shard):
                (held[shard],) = running_with(made.veldt.folder / f"shards/000{shard}")
                os.kill(held[shard], signal.SIGSTOP)
                assert made.clips_of(shard) < len(CLIPS) // SHARDS, f"shard {shard} was halted too late"
        time.sleep(0.01)
    return held


def _awaits(process: int, number: int) -> bool:
    """Whether a halted process will get a signal when it goes on."""
    status = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    return bool(int(re.search(r"ShdPnd:\s*(\w+)", status)[1], 16) >> (number - 1) & 1)


def _disturb(made: Made, array: str) -> None:
    """Disturb three shards, each of them between two clips."""
    process = _hold(made, _LONG)[STOPPED]
    crashed = f"{array}_{CRASHED}"
    made.crashed_node = made.slurm.jobs(crashed)[crashed]["NodeList"]
    made.slurm.kill_node(made.crashed_node)
    made.slurm.command("scontrol", "requeue", f"{array}_{REQUEUED}")  # also has it go on, and end
    os.kill(parent_of(process), signal.SIGTERM)  # the script alone, as before a time limit
    assert wait_until(lambda: _awaits(process, signal.SIGTERM), 30), made.slurm.logs()
    os.kill(process, signal.SIGCONT)


def _free_space(made: Made, job: str, disk: SmallDisk) -> None:
    """Free disk space once a job was requeued."""
    assert wait_until(lambda: made.slurm.jobs(job)[job]["Restarts"] != "0", 120), made.slurm.logs()
    disk.free_space()


def _prepare(veldt: Veldt) -> None:
    veldt.write("config.json", _config())
    veldt.write("shard.sh", _SHARD)
    veldt.write("merge.sh", _MERGE)
    veldt.write("veldt", _PROGRAM).chmod(0o755)
    veldt.write(f"wrong_options_{BROKEN}", "--seasons all")
    (veldt.folder / "shards").mkdir()


@pytest.fixture(scope="module", name="made")
def _made(tmp_path_factory) -> Iterator[Made]:
    veldt = Veldt(tmp_path_factory.mktemp("made"))
    _prepare(veldt)
    with ExitStack() as stack:
        made = Made(veldt, stack.enter_context(running_slurm(nodes=3)))
        try:
            disk = stack.enter_context(small_disk(veldt.folder / f"shards/000{FULL}", "8m"))
            disk.leave(100 * BLOCK)
        except pytest.skip.Exception as reason:
            disk, made.no_disk = None, str(reason)
        array = made.hand_in("shard.sh")
        _disturb(made, array)
        if disk:
            _free_space(made, f"{array}_{FULL}", disk)
        made.merge_after(array)
        (veldt.folder / f"wrong_options_{BROKEN}").unlink()
        made.merge_after(made.hand_in("shard.sh", f"--array={BROKEN}"))
        yield made


def _states(array: dict[str, dict]) -> dict[int, tuple[str, str]]:
    """State, and exit code with signal, by shard."""
    return {
        int(name.partition("_")[2]): (job["JobState"], job["ExitCode"]) for name, job in sorted(array.items())
    }


def test_a_shard_that_fails_fails_alone(made):
    usual = {shard: ("COMPLETED", "0:0") for shard in range(SHARDS)}
    assert _states(made.arrays[0]) == usual | {BROKEN: ("FAILED", "2:0")}
    assert made.runs(BROKEN) == [(0, 2), (0, 0)]
    assert _states(made.arrays[1]) == {BROKEN: ("COMPLETED", "0:0")}


def test_a_crashed_node_leaves_its_shard_to_another(made):
    (job,) = [job for name, job in made.arrays[0].items() if name.endswith(f"_{CRASHED}")]
    assert job["NodeList"] != made.crashed_node
    assert made.runs(CRASHED) == [(1, 0)]
    made.slurm.start_node(made.crashed_node)
    assert wait_until(lambda: made.slurm.node_state(made.crashed_node) == "idle", 30)


def test_a_requeued_shard_goes_on(made):
    assert made.runs(REQUEUED)[-1] == (1, 0)


def test_a_shard_waits_for_disk_space(made):
    if made.no_disk:
        pytest.skip(made.no_disk)
    assert made.runs(FULL) == [(0, 75), (1, 0)]
    assert "No space left on device" in made.log(FULL)


def test_a_shard_that_is_stopped_before_its_time_limit_goes_on(made):
    assert made.runs(STOPPED) == [(0, 143), (1, 0)]
    assert "veldt: stopped on request" in made.log(STOPPED)


def test_merge_names_what_is_missing(made):
    (state, said), (later_state, later_said) = made.merges
    assert (state, later_state) == ("FAILED", "COMPLETED")
    missing = ", ".join(CLIPS[BROKEN::SHARDS])
    assert f"veldt: merged lacks clips {missing}; " in said
    assert later_said == "merged: 5 clips merged, 30 frames; 35 already existed\n"


def test_the_dataset_is_that_of_an_undivided_run(made):
    done = made.veldt("generate", "config.json", "--engine", "embree", "--out", "whole", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    assert made.veldt("validate", "merged").code == 0
    merged, whole = (_bytes_of(made.veldt.folder / name) for name in ("merged", "whole"))
    assert sorted(merged) == sorted(whole)
    assert [name for name in whole if merged[name] != whole[name]] == []
    labels = made.veldt.read("whole/annotations.json")["annotations"]
    assert {label["image_id"] for label in labels} and len(labels) > len(CLIPS)


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
        script = f"{folder}/n0/job"
        assert wait_until(lambda: running_with(script), 10)
        test.kill()
    assert wait_until(lambda: not running_with(folder), 10), running_with(folder)
    shutil.rmtree(folder)
    assert running_with(made.slurm.folder)
