"""The nights of `configs/ci`, step by step, by stand-ins for GitHub and GitLab.

With VELDT_IMAGE_ROOT, the folder of an unpacked image, the steps run in it, as VELDT_IMAGE_USER where the file names no
user; tests/fresh/container.sh does that.
"""

import json
import os
import shlex
from pathlib import Path

import pytest
import yaml

from ci_services import Service, run_here, run_in_image
from configs import tiny
from datasets import content_of
from github_actions import GitHub
from gitlab_ci import GitLab
from program import PROGRAM, ROOT

_IMAGE = os.environ.get("VELDT_IMAGE_ROOT")
_FILES = ROOT / "configs" / "ci"
_SERVICES = {"github": GitHub, "gitlab": GitLab}
_SHARDS = 4

here_only = pytest.mark.skipif(_IMAGE is not None, reason="a stand-in for the program cannot be in an image")


def _config() -> dict:
    """Five clips, so that a shard has two."""
    config = tiny() | {"render": {"engine": "embree"}}
    first = config["clips"][0]
    config["clips"] = [first | {"id": f"clip_{k}", "frames": 2, "start_s": k / 2} for k in range(5)]
    return config


def _service_in(folder: Path, name: str, file: Path) -> Service:
    """A service whose user has a config and the file."""
    repository = folder / "repository"
    (repository / "configs").mkdir(parents=True)
    (repository / "configs" / "nightly.json").write_text(json.dumps(_config()), encoding="utf-8")
    (folder / "bin").mkdir()
    (folder / "bin" / "veldt").symlink_to(PROGRAM)
    run = run_here(folder / "bin" / "veldt")
    if _IMAGE:
        run = run_in_image(Path(_IMAGE), os.environ["VELDT_IMAGE_USER"])
    return _SERVICES[name](file, repository, folder / "kept", run)


@pytest.fixture(params=sorted(_SERVICES), name="service")
def _service(request, tmp_path) -> Service:
    return _service_in(tmp_path, request.param, _FILES / f"{request.param}.yml")


def _let_fail(service: Service, shard: int, code: int, times: int) -> None:
    """Generate of one shard ends with `code` so many times, and works from then on."""
    program = service.kept.parent / "bin" / "veldt"
    counted = shlex.quote(str(service.kept.parent / "failures"))
    program.unlink()
    # 0 to 3 for GitHub, `auto` with 1 to 4 for GitLab
    program.write_text(
        f"""#!/bin/sh
case "$1 $* $CI_NODE_INDEX" in
"generate "*" --shard {shard}/{_SHARDS} "* | "generate "*" {shard + 1}")
  echo failure >>{counted}
  [ "$(wc -l <{counted})" -gt {times} ] || exit {code} ;;
esac
exec {shlex.quote(str(PROGRAM))} "$@"
""",
        encoding="utf-8",
    )
    program.chmod(0o755)


def _failures(service: Service) -> int:
    return len((service.kept.parent / "failures").read_text(encoding="utf-8").splitlines())


def _dataset(service: Service) -> Path:
    """What the last job leaves: on GitHub in an artifact of its own."""
    below = service.artifacts / "dataset"
    return below / "dataset" if isinstance(service, GitLab) else below


def _report(service: Service) -> Path:
    name = "dataset" if isinstance(service, GitLab) else "report"
    return service.artifacts / name / "report.html"


def _undivided(service: Service) -> Path:
    folder = service.workspace("undivided")
    command = ["veldt", "generate", "config.json", "--out", "whole", "--quiet"]
    (folder / "config.json").write_text(json.dumps(_config()), encoding="utf-8")
    assert service.run(command, folder, {}, None) == 0
    return folder / "whole"


def _visible(folder: Path) -> dict:
    """A dataset without its plan, and without its lock, which GitHub's artifacts leave out."""
    return {k: v for k, v in content_of(folder).items() if not k.startswith(("plan/", "."))}


def test_a_night_makes_the_dataset_of_an_undivided_run_and_its_report(service):
    night = service.night()
    assert not night.failed
    assert len(night.codes) == _SHARDS + 2
    assert _visible(_dataset(service)) == _visible(_undivided(service))
    assert "<html" in _report(service).read_text(encoding="utf-8")


def test_the_second_night_keeps_the_plan(service):
    service.night()
    before = _planned(service)
    assert not service.night().failed
    assert _planned(service) == before


def _planned(service: Service) -> tuple:
    """When the plan was made that a night used: copies keep the time. It is in the only cache."""
    (cached,) = service.caches.rglob("plan.json")
    used = service.kept / "workspaces" / "plan" / "plan" / "plan.json"
    assert used.stat().st_mtime_ns == cached.stat().st_mtime_ns
    return cached.relative_to(service.caches), cached.stat().st_mtime_ns


def test_another_config_is_planned_anew(service):
    service.night()
    changed = _config() | {"seed": 8}
    (service.repository / "configs" / "nightly.json").write_text(json.dumps(changed), encoding="utf-8")
    assert not service.night().failed
    assert len(list(service.caches.rglob("plan.json"))) == 2
    assert json.loads((_dataset(service) / "dataset.json").read_text(encoding="utf-8"))["config"]["seed"] == 8


@here_only
def test_code_75_is_tried_again(service):
    _let_fail(service, 1, 75, times=2)
    assert not service.night().failed
    assert _failures(service) == 3
    assert _visible(_dataset(service)) == _visible(_undivided(service))


@here_only
def test_code_75_is_tried_three_times_in_all(service):
    _let_fail(service, 1, 75, times=9)
    assert "shard" in service.night().failed
    assert _failures(service) == 3


@here_only
@pytest.mark.parametrize("code", [1, 2])
def test_codes_1_and_2_fail_at_once(service, code):
    _let_fail(service, 1, code, times=9)
    night = service.night()
    assert {"shard", "dataset"} <= night.failed
    assert _failures(service) == 1


@here_only
def test_after_code_3_the_other_clips_are_merged_and_reported(service, capfd):
    _let_fail(service, 1, 3, times=9)
    night = service.night()
    assert "dataset" in night.failed
    assert ("shard" in night.failed) == isinstance(service, GitHub)  # a warning on GitLab
    assert _failures(service) == 1
    assert 3 in night.codes["dataset"]
    assert f"veldt: run these of {_SHARDS} shards again: 1" in capfd.readouterr().err
    assert _report(service).exists()


@here_only
def test_a_config_with_a_mistake_ends_the_night(service):
    (service.repository / "configs" / "nightly.json").write_text("{}", encoding="utf-8")
    night = service.night()
    assert (night.codes["plan"][-1], list(night.codes)) == (2, ["plan"])


def test_the_matrix_has_all_shards():
    github = yaml.safe_load((_FILES / "github.yml").read_text(encoding="utf-8"))
    shards = github["jobs"]["shard"]["strategy"]["matrix"]["shard"]
    assert shards == list(range(github["env"]["SHARDS"]))


@here_only
@pytest.mark.parametrize(
    "name, known, unknown",
    [
        ("github", "actions/checkout@", "actions/unknown@"),
        ("github", "retention-days:", "unknown:"),
        ("github", "matrix.shard }}", "matrix.unknown }}"),
        ("github", "!cancelled()", "unknown()"),
        ("gitlab", "needs:", "unknown:"),
        ("gitlab", "stage: shards", "stage: unknown"),
    ],
)
def test_what_the_stand_ins_do_not_know_is_an_error(tmp_path, name, known, unknown):
    text = (_FILES / f"{name}.yml").read_text(encoding="utf-8")
    file = tmp_path / "changed.yml"
    file.write_text(text.replace(known, unknown), encoding="utf-8")
    with pytest.raises((AssertionError, AttributeError, KeyError, TypeError), match="unknown"):
        _service_in(tmp_path, name, file).night()
