"""`plan` once, then `generate --plan --shard` anywhere, then `merge`: the same dataset as one run makes."""

import re
import shutil
import subprocess
import tarfile
from pathlib import Path

import pytest

from configs import tiny
from datasets import content_of, flip_bit
from program import PROGRAM, Veldt, check_fault, files_below

_NO_PROGRAMS = {"PATH": "/nonexistent"}
_SHARDS = 3


def _config() -> dict:
    """Six clips of different lengths, with plants and actors."""
    config = tiny()
    config["render"] = {"actor_layer": True, "engine": "embree"}
    first = config["clips"][0]
    config["clips"] = [first | {"id": f"clip_{k}", "frames": 2 + k % 4, "start_s": k / 2} for k in range(6)]
    return config


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A plan, the dataset that it plans, and the same in shards."""
    veldt = Veldt(tmp_path_factory.mktemp("units"))
    veldt.write("config.json", _config())
    for arguments in (
        ["plan", "config.json", "--out", "plan"],
        ["generate", "config.json", "--out", "whole"],
    ):
        done = veldt(*arguments, "--quiet")
        assert (done.code, done.out, done.err) == (0, "", "")
    shutil.rmtree(veldt.folder / "whole" / "plan")
    for shard in range(_SHARDS):
        _make(veldt, shard, f"shards/{shard}")
    return veldt


def _make(veldt, shard: int, out, *options, env: dict | None = None) -> None:
    plan = veldt.folder / "plan"
    arguments = ["--plan", plan, "--shard", f"{shard}/{_SHARDS}", "--out", out, "--quiet", *options]
    done = veldt("generate", *arguments, env=_NO_PROGRAMS | (env or {}))
    assert (done.code, done.out, done.err) == (0, "", "")


def _merge(veldt, *sources, out):
    options = ["--plan", veldt.folder / "plan", "--shards", _SHARDS, "--out", out, "--progress", "none"]
    return veldt("merge", *sources, *options)


def _frames_of(veldt, shard: int) -> int:
    return veldt.read(f"shards/{shard}/dataset.json")["frames"]


# --- the work ---------------------------------------------------------------------------------------------------------


def test_shards_of_a_plan_merge_to_the_undivided_dataset(place, tmp_path):
    done = _merge(place, "shards/0", "shards/1", "shards/2", out=tmp_path / "out")
    assert (done.code, done.err) == (0, "")
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")


def test_shards_have_nearly_the_same_number_of_frames(place):
    frames = [_frames_of(place, shard) for shard in range(_SHARDS)]
    assert sum(frames) == sum(clip["frames"] for clip in _config()["clips"])
    assert max(frames) - min(frames) <= max(clip["frames"] for clip in _config()["clips"])


def test_the_files_that_a_plan_was_made_from_need_not_be_there(place, tmp_path):
    shutil.copytree(place.folder / "plan", tmp_path / "plan")
    elsewhere = Veldt(tmp_path)
    _make(elsewhere, 1, "out")
    assert content_of(tmp_path / "out") == content_of(place.folder / "shards" / "1")


def test_a_shard_is_finished_once(place):
    before = {file: file.stat().st_mtime_ns for file in (place.folder / "shards" / "0").rglob("*")}
    _make(place, 0, "shards/0")
    assert {file: file.stat().st_mtime_ns for file in (place.folder / "shards" / "0").rglob("*")} == before


def test_merge_lists_the_shards_to_run_again(place, tmp_path):
    (tmp_path / "empty").mkdir()
    done = _merge(place, "shards/1", tmp_path / "empty", out=tmp_path / "out")
    assert done.code == 3
    left_out, lacking, again = done.err.splitlines()
    assert left_out == f"veldt: {tmp_path}/empty is left out: it has no dataset.json"
    assert lacking.startswith(f"veldt: {tmp_path}/out lacks clips clip_")
    assert again == "veldt: run these of 3 shards again: 0,2"
    done = _merge(place, "shards/0", "shards/2", out=tmp_path / "out")
    assert (done.code, done.err) == (0, "")
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")


@pytest.mark.parametrize(
    "environment",
    [
        {"SLURM_ARRAY_TASK_ID": "2", "SLURM_ARRAY_TASK_COUNT": "3", "SLURM_ARRAY_TASK_MAX": "2"},
        {"JOB_COMPLETION_INDEX": "2", "JOB_COMPLETIONS": "3"},
        {"CI_NODE_INDEX": "3", "CI_NODE_TOTAL": "3"},
    ],
)
def test_the_scheduler_says_which_shard(place, environment):
    arguments = ["--plan", "plan", "--shard", "auto", "--out", "shards/2"]
    done = place("generate", *arguments, env=_NO_PROGRAMS | environment)
    assert done.code == 0
    assert done.out == "shards/2: nothing to do, 2 clips already existed\n"


# --- places to write to -----------------------------------------------------------------------------------------------


def test_clips_made_on_a_scratch_disk_are_the_same(place, tmp_path):
    _make(place, 1, tmp_path / "out", "--scratch", tmp_path / "scratch")
    made = content_of(place.folder / "shards" / "1")
    assert made.pop(".lock") == b""
    assert content_of(tmp_path / "out") == made
    assert files_below(tmp_path / "scratch") == [".lock"]
    assert ".lock" not in files_below(tmp_path / "out")


def test_an_object_store_gets_whole_files_and_records_last(place, tmp_path, store):
    out = tmp_path / "bucket"
    env = {"LD_PRELOAD": str(store), "OBJECT_STORE": str(out)}
    for shard in range(_SHARDS):
        _make(place, shard, out / str(shard), "--scratch", tmp_path / f"scratch_{shard}", env=env)
    assert not [name for name in files_below(out) if name.endswith((".tmp", ".part", ".lock", ".spool"))]
    done = _merge(place, *sorted(out.iterdir()), out=tmp_path / "out")
    assert (done.code, done.err) == (0, "")
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")


def test_an_object_store_needs_the_scratch_disk(place, tmp_path, store):
    env = {"LD_PRELOAD": str(store), "OBJECT_STORE": str(tmp_path), **_NO_PROGRAMS}
    done = place("generate", "--plan", "plan", "--out", tmp_path / "out", "--quiet", env=env)
    assert done.code == 1
    assert done.err == f"veldt: cannot lock {tmp_path}/out/.lock: Operation not supported\n"


def _samples_of(folder: Path) -> dict[str, bytes]:
    """Every file in the tar files of an export."""
    content: dict[str, bytes] = {}
    for shard in sorted((folder / "train").iterdir()):
        with tarfile.open(shard) as tar:
            content |= {member.name: tar.extractfile(member).read() for member in tar}
    return content


def test_shards_exported_one_by_one_have_the_pictures_of_the_undivided_dataset(place, tmp_path, store):
    bucket = tmp_path / "bucket"
    env = {"LD_PRELOAD": str(store), "OBJECT_STORE": str(bucket)}
    found: dict[str, bytes] = {}
    for shard in range(_SHARDS):
        options = ["--unfinished", "--format", "webdataset", "--scratch", tmp_path / "scratch", "--quiet"]
        done = place("export", f"shards/{shard}", "--out", bucket / str(shard), *options, env=env)
        assert (done.code, done.out, done.err) == (0, "", "")
        samples = _samples_of(bucket / str(shard))
        assert not found.keys() & samples.keys()
        found |= samples
    done = place("export", "whole", "--format", "webdataset", "--out", tmp_path / "whole", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    whole = _samples_of(tmp_path / "whole")
    assert found.keys() == whole.keys()
    assert all(found[name] == whole[name] for name in whole if name.endswith(".png"))


def test_a_clip_without_its_record_is_made_again(place, tmp_path):
    _make(place, 1, tmp_path / "out", "--scratch", tmp_path / "scratch")
    clip = next((tmp_path / "out" / "clips").iterdir())
    (clip / "clip.json").unlink()
    (clip / "ir8" / "000001.png").unlink()
    (tmp_path / "scratch" / f"{clip.name}.part").mkdir()
    (tmp_path / "scratch" / f"{clip.name}.part" / "junk").touch()
    _make(place, 1, tmp_path / "out", "--scratch", tmp_path / "scratch")
    done = _merge(place, "shards/0", tmp_path / "out", "shards/2", out=tmp_path / "merged")
    assert (done.code, done.err) == (0, "")
    assert content_of(tmp_path / "merged") == content_of(place.folder / "whole")


# --- faults -----------------------------------------------------------------------------------------------------------

_ARRAY = {"SLURM_ARRAY_TASK_ID": "3", "SLURM_ARRAY_TASK_COUNT": "2", "SLURM_ARRAY_TASK_MAX": "5"}
FAULTS = {
    "nothing to make": ([], "config or --plan is required; see veldt generate --help"),
    "both": (
        ["config.json", "--plan", "plan"],
        "config and --plan exclude each other; see veldt generate --help",
    ),
    "a changed plan": (
        ["--plan", "plan", "--set", "seed=2"],
        "--set and --engine change a config, not a plan; give them to veldt plan",
    ),
    "another engine": (
        ["--plan", "plan", "--engine", "blender"],
        "--set and --engine change a config, not a plan; give them to veldt plan",
    ),
    "no plan": (
        ["--plan", "shards"],
        "--plan = shards; expected a folder that veldt plan wrote, with plan.json",
    ),
    "scratch without a plan": (
        ["config.json", "--scratch", "s"],
        "--scratch needs --plan, because a plan takes part of its place in --out",
    ),
    "kept passes": (
        ["--plan", "plan", "--scratch", "s", "--keep-passes"],
        "--keep-passes and --scratch exclude each other: passes are kept in --out",
    ),
    "no scheduler": (
        ["--plan", "plan", "--shard", "auto"],
        "--shard = auto; expected SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX or CI_NODE_INDEX in the environment",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_faulty_requests(place, name):
    arguments, message = FAULTS[name]
    check_fault(place("generate", *arguments, "--out", "never"), 2, message)
    assert not (place.folder / "never").exists()


def test_some_tasks_of_an_array_are_not_shards(place):
    done = place("generate", "--plan", "plan", "--shard", "auto", "--out", "never", env=_ARRAY)
    rule = "a whole array, from 0 to SLURM_ARRAY_TASK_COUNT - 1; for some of its tasks, give I/N"
    check_fault(done, 2, f"SLURM_ARRAY_TASK_ID of 2 = 3; expected {rule}")


def test_a_plan_whose_config_was_exchanged(place, tmp_path):
    shutil.copytree(place.folder / "plan", tmp_path / "plan")
    veldt = Veldt(tmp_path)
    config = veldt.read("plan/config.json")
    veldt.write("plan/config.json", config | {"seed": config["seed"] + 1})
    done = veldt("generate", "--plan", "plan", "--out", "never")
    _check_damaged(done, "plan/config.json")


def _copied_plan(place, to) -> Path:
    return Path(shutil.copytree(place.folder / "plan", to))


def _check_damaged(done, file) -> None:
    found = rf"veldt: {file} is damaged, or of another plan: its SHA-256 is \w{{64}}; checksums.json has \w{{64}};"
    assert (done.code, done.out) == (1, "")
    assert re.fullmatch(found + " run veldt plan again\n", done.err), done.err


@pytest.mark.parametrize("name", ["plan.json", "config.json", "scene.bin", "tracks/{}.bin"])
def test_a_damaged_plan_is_refused(place, tmp_path, name):
    made = [path.name for path in (place.folder / "shards" / "0" / "clips").iterdir()]
    name = name.format(made[0])
    plan = _copied_plan(place, tmp_path / "plan")
    flip_bit(plan / name)
    done = place("generate", "--plan", plan, "--shard", f"0/{_SHARDS}", "--out", tmp_path / "out", "--quiet")
    _check_damaged(done, plan / name)
    assert not (tmp_path / "out").exists()


def test_a_damaged_track_stops_only_the_shard_that_needs_it(place, tmp_path):
    other = next((place.folder / "shards" / "0" / "clips").iterdir()).name
    plan = _copied_plan(place, tmp_path / "plan")
    flip_bit(plan / "tracks" / f"{other}.bin")
    done = place("generate", "--plan", plan, "--shard", f"1/{_SHARDS}", "--out", tmp_path / "out", "--quiet")
    assert (done.code, done.err) == (0, "")


def test_a_damaged_plan_is_made_again(place, tmp_path):
    plan = _copied_plan(place, tmp_path / "plan")
    before = content_of(plan)
    flip_bit(plan / "scene.bin")
    (tmp_path / "plan.part").mkdir()
    (tmp_path / "plan.part" / "scene.bin").touch()
    assert place("plan", "config.json", "--out", plan, "--quiet").code == 0
    assert content_of(plan) == before
    assert not (tmp_path / "plan.part").exists()


def test_a_plan_with_another_output_is_not_planned_again(place, tmp_path):
    plan = _copied_plan(place, tmp_path / "plan")
    before = (plan / "scene.bin").stat().st_ino
    done = place("plan", "config.json", "--set", "weather.air_temperature_k=290", "--out", plan, "--quiet")
    assert (done.code, done.err) == (0, "")
    assert (plan / "scene.bin").stat().st_ino == before
    done = place("generate", "--plan", plan, "--shard", f"0/{_SHARDS}", "--out", tmp_path / "out", "--quiet")
    assert (done.code, done.err) == (0, "")


def test_two_plans_into_one_folder(place, tmp_path):
    runs = [
        subprocess.Popen(
            [PROGRAM, "plan", place.folder / "config.json", "--out", tmp_path / "plan", "--quiet"]
        )
        for _ in range(2)
    ]
    assert [run.wait() for run in runs] == [0, 0]
    assert content_of(tmp_path / "plan") == content_of(place.folder / "plan")
    assert not (tmp_path / "plan.part").exists()


def test_merge_refuses_shards_of_another_plan(place, tmp_path):
    veldt = Veldt(tmp_path)
    veldt.write("config.json", _config() | {"seed": 99})
    assert veldt("plan", "config.json", "--out", "plan", "--quiet").code == 0
    done = veldt("merge", "--plan", "plan", place.folder / "shards" / "0", "--out", "out")
    shard = place.folder / "shards" / "0"
    rule = "expected shards of one config"
    check_fault(done, 2, f"the plan and {shard} have different configs: seed is 99 here and 7 there; {rule}")


def test_numbers_of_shards_need_a_plan(place):
    done = place("merge", "--shards", 3, "shards/0", "--out", "never")
    check_fault(done, 2, "--shards needs --plan, which says what each shard makes")
