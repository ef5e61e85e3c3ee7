"""`cluster`: job scripts for Slurm and Kubernetes, run with stand-ins for their schedulers."""

import os
import subprocess
from pathlib import Path

import pytest
import yaml

from configs import tiny
from datasets import content_of
from program import PROGRAM, Veldt, check_fault

_SHARDS = 2

# What the stand-ins for sbatch and scontrol were called with is listed in `calls`. tests/cluster has a real Slurm.
_STAND_IN = """#!/bin/sh
printf '%s' "$(basename "$0")" >>calls
printf ' <%s>' "$@" >>calls
echo >>calls
case "$*" in *--parsable*) echo 77 ;; esac
"""


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A folder whose name needs quotes, with a plan and programs that stand in for Slurm's."""
    folder = tmp_path_factory.mktemp("cluster") / "the ranger's Büro"
    folder.mkdir()
    veldt = Veldt(folder)
    config = tiny() | {"name": "My_Park"}
    config["render"] = {"engine": "embree"}
    veldt.write("config.json", config)
    assert veldt("plan", "config.json", "--out", "plan", "--quiet").code == 0
    (folder / "bin").mkdir()
    for name in ("sbatch", "scontrol"):
        _install(folder / "bin" / name, _STAND_IN)
    _install(folder / "bin" / "squeue", "#!/bin/sh\necho ${STATE:-RUNNING}\n")
    (folder / "bin" / "veldt").symlink_to(PROGRAM)
    return veldt


def _install(file: Path, text: str) -> None:
    file.write_text(text, encoding="utf-8")
    file.chmod(0o755)


def _write(veldt, scheduler: str, *options) -> None:
    done = veldt("cluster", scheduler, "plan", "--shards", _SHARDS, *options, "--out", "jobs")
    assert (done.code, done.out, done.err) == (0, "", "")


def _run(veldt, *arguments, env: dict | None = None):
    """Runs the Slurm script. Returns its exit code and what it called."""
    calls = veldt.folder / "calls"
    calls.unlink(missing_ok=True)
    path = f"{veldt.folder / 'bin'}:{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "jobs", *arguments],
        cwd=veldt.folder,
        env=os.environ | {"PATH": path} | (env or {}),
        check=False,
    )
    return done.returncode, calls.read_text(encoding="utf-8").splitlines() if calls.exists() else []


def _task(shard: int, **more) -> dict:
    return {"SLURM_ARRAY_TASK_ID": str(shard), "SLURM_JOB_ID": "78", "SLURM_CPUS_PER_TASK": "1", **more}


# --- Slurm ------------------------------------------------------------------------------------------------------------


def test_the_header_has_what_was_asked_for(place):
    _write(place, "slurm", "--nodes", 3, "--cores", 8, "--memory-gb", 6)
    lines = (place.folder / "jobs").read_text(encoding="utf-8").splitlines()
    header = [line.removeprefix("#SBATCH --") for line in lines if line.startswith("#SBATCH")]
    assert {"job-name=veldt_my-park", "array=0-1%3", "cpus-per-task=8", "mem=6G", "requeue"} < set(header)
    assert not any("{{" in line for line in lines)


@pytest.mark.parametrize("scheduler", ["slurm", "kubernetes"])
def test_without_a_file_the_same_is_printed(place, scheduler):
    _write(place, scheduler)
    done = place("cluster", scheduler, "plan", "--shards", _SHARDS)
    assert (done.code, done.out, done.err) == (0, (place.folder / "jobs").read_text(encoding="utf-8"), "")


def test_a_path_that_shells_read_in_ways_of_their_own_is_refused(place):
    path = f"{place.folder}/a\\x09b"
    rule = "expected a text without control characters, in UTF-8, such as /data/park"
    check_fault(place("cluster", "slurm", "plan", "--data", "a\tb"), 2, f"--data = {path}; {rule}")


def test_the_script_submits_shards_and_a_merge_that_waits_for_them(place):
    _write(place, "slurm")
    code, calls = _run(place, "--array=1")
    assert code == 0
    assert calls[0] == "sbatch <--parsable> <--array=1> <jobs>"
    assert calls[1].startswith("sbatch <--dependency=afterany:77> <--job-name=veldt_my-park_merge>")


def test_tasks_and_the_merge_make_the_dataset(place):
    _write(place, "slurm")
    for shard in range(_SHARDS):
        assert _run(place, env=_task(shard)) == (0, [])
    merge = _run(place)[1][1].split(" <--wrap> <")[1].removesuffix(">")
    path = f"{place.folder / 'bin'}:{os.environ['PATH']}"
    subprocess.run(["sh", "-c", merge], env=os.environ | {"PATH": path}, check=True, capture_output=True)
    assert place("generate", "config.json", "--out", "whole", "--quiet").code == 0
    whole = {
        name: text
        for name, text in content_of(place.folder / "whole").items()
        if not name.startswith("plan/")
    }
    assert content_of(place.folder / "dataset") == whole


@pytest.mark.parametrize(
    "code, restarts, calls",
    [
        (75, 0, ["scontrol <requeue> <78>"]),
        (143, 4, ["scontrol <requeue> <78>"]),
        (75, 5, []),
        (1, 0, []),
        (2, 0, []),
        (3, 0, []),
    ],
)
def test_only_shards_that_can_go_on_are_requeued(place, tmp_path, code, restarts, calls):
    _write(place, "slurm")
    _install(tmp_path / "veldt", f"#!/bin/sh\nexit {code}\n")
    path = f"{tmp_path}:{place.folder / 'bin'}:{os.environ['PATH']}"
    ended = _run(place, env=_task(0, SLURM_RESTART_COUNT=str(restarts), PATH=path))
    assert ended == (0 if calls else code, calls)


def test_a_shard_that_is_cancelled_is_not_requeued(place, tmp_path):
    _write(place, "slurm")
    _install(tmp_path / "veldt", "#!/bin/sh\nexit 143\n")
    path = f"{tmp_path}:{place.folder / 'bin'}:{os.environ['PATH']}"
    assert _run(place, env=_task(0, STATE="COMPLETING", PATH=path)) == (143, [])


def test_no_scratch_folder_is_left(place, tmp_path):
    _write(place, "slurm")
    _run(place, env=_task(0, SLURM_TMPDIR=str(tmp_path)))
    assert not list(tmp_path.iterdir())


# --- Kubernetes -------------------------------------------------------------------------------------------------------


def test_the_manifest_is_an_indexed_job_and_a_merge(place):
    _write(place, "kubernetes", "--image", "registry.example/veldt:1", "--claim", "park", "--nodes", 3)
    shards, merge = yaml.safe_load_all((place.folder / "jobs").read_text(encoding="utf-8"))
    assert shards["metadata"]["name"] == "veldt-my-park"
    assert (shards["spec"]["completions"], shards["spec"]["parallelism"]) == (_SHARDS, 3)
    worker = shards["spec"]["template"]["spec"]["containers"][0]
    assert worker["image"] == "registry.example/veldt:1"
    assert worker["env"] == [{"name": "JOB_COMPLETIONS", "value": str(_SHARDS)}]
    assert merge["spec"]["suspend"] is True


def test_the_arguments_of_the_pods_make_the_dataset(place):
    _write(place, "kubernetes")
    shards, merge = yaml.safe_load_all((place.folder / "jobs").read_text(encoding="utf-8"))
    volume = place.folder / "volume"
    volume.mkdir()
    (volume / "plan").symlink_to(place.folder / "plan")
    worker = shards["spec"]["template"]["spec"]["containers"][0]
    for index in range(_SHARDS):
        env = {"JOB_COMPLETION_INDEX": str(index)} | {one["name"]: one["value"] for one in worker["env"]}
        here = {"/data": str(volume), "/scratch": str(volume / f"scratch_{index}")}
        arguments = [_in_pod(argument, here, env) for argument in worker["args"]]
        done = place(*arguments, env=env | {"PATH": "/nonexistent"})
        assert done.code == 0, done.err
    command = merge["spec"]["template"]["spec"]["containers"][0]["args"][0].replace("/data/", "volume/")
    path = f"{place.folder / 'bin'}:{os.environ['PATH']}"
    subprocess.run(["sh", "-c", command], cwd=place.folder, env=os.environ | {"PATH": path}, check=True)
    assert place("validate", "volume/dataset").code == 0


def _in_pod(argument: str, mounts: dict, env: dict) -> str:
    for name, value in env.items():
        argument = argument.replace(f"$({name})", value)
    for mount, folder in mounts.items():
        argument = argument.replace(f"={mount}/", f"={folder}/")
    return argument


# --- faults -----------------------------------------------------------------------------------------------------------


def test_a_folder_that_is_no_plan(place):
    done = place("cluster", "slurm", "bin")
    check_fault(done, 2, "--plan = bin; expected a folder that veldt plan wrote, with plan.json")


def test_a_scheduler_that_there_is_not(place):
    done = place("cluster", "condor", "plan")
    assert done.code == 2
    assert "condor not in {slurm,kubernetes}" in done.err
