"""The commands in the files of `configs/ci`, by the shells of GitHub and GitLab; tests/peers has the files' schemas."""

import json
import os
import subprocess

import pytest
import yaml

from configs import tiny
from datasets import content_of
from program import PROGRAM, ROOT

_SHELLS = {"github": ["sh", "-e", "-c"], "gitlab": ["bash", "-eo", "pipefail", "-c"]}
_SHARDS = 4


def _pipeline(service: str) -> dict:
    return yaml.safe_load((ROOT / "configs" / "ci" / f"{service}.yml").read_text(encoding="utf-8"))


def _scripts(service: str, job: str) -> list[str]:
    if service == "gitlab":
        return ["\n".join(_pipeline(service)[job]["script"])]
    return [step["run"] for step in _pipeline(service)["jobs"][job]["steps"] if "run" in step]


@pytest.fixture(name="codes_of")
def _codes_of(tmp_path):
    """Runs a job's commands and returns their exit codes."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "veldt").symlink_to(PROGRAM)
    common = {"PATH": f"{tmp_path}/bin:/usr/bin:/bin", "CONFIG": "config.json", "SHARDS": str(_SHARDS)}

    def codes_of(service: str, job: str, **variables: str) -> list[int]:
        env = common | {"GITHUB_OUTPUT": "output", "CI_NODE_TOTAL": str(_SHARDS)} | variables
        commands = [[*_SHELLS[service], script] for script in _scripts(service, job)]
        return [subprocess.run(one, cwd=tmp_path, env=env, check=False).returncode for one in commands]

    return codes_of


@pytest.fixture(name="let_end")
def _let_end(tmp_path, codes_of):  # pylint: disable=unused-argument # it makes the folder
    """Has a stand-in for the program end with one code after the other; the other function lists its commands."""
    program, calls = tmp_path / "bin" / "veldt", tmp_path / "calls"

    def let_end(*codes: int) -> None:
        (tmp_path / "codes").write_text("".join(f"{code}\n" for code in codes), encoding="utf-8")
        program.unlink()
        script = '#!/bin/sh\necho "$1" >>calls\nexit "$(sed -n "$(wc -l <calls)p" codes)"\n'
        program.write_text(script, encoding="utf-8")
        program.chmod(0o755)

    return let_end, lambda: calls.read_text(encoding="utf-8").split()


@pytest.mark.parametrize("service", _SHELLS)
def test_a_night_makes_the_dataset_of_an_undivided_run_and_its_report(service, codes_of, veldt):
    config = tiny() | {"render": {"engine": "embree"}}
    config["clips"] = [
        config["clips"][0] | {"id": f"clip_{k}", "frames": 2, "start_s": k / 2} for k in range(5)
    ]
    veldt.write("config.json", json.dumps(config))
    folder = veldt.folder
    assert not any(codes_of(service, "plan"))
    for k in range(_SHARDS):
        assert codes_of(service, "shard", SHARD=str(k), CI_NODE_INDEX=str(k + 1)) == [0]
        if service == "github":  # each shard comes in an artifact of its own
            os.renames(folder / "shard", folder / "shards" / str(k))
    assert not any(codes_of(service, "dataset"))
    assert "<html" in (folder / "report.html").read_text(encoding="utf-8")
    assert veldt("generate", "config.json", "--out", "whole", "--quiet").code == 0
    made, whole = (content_of(folder / name) for name in ("dataset", "whole"))
    assert made == {name: content for name, content in whole.items() if not name.startswith("plan/")}


@pytest.mark.parametrize(
    "codes, tries", [([75, 75, 0], 3), ([75, 75, 75, 0], 3), ([1, 0], 1), ([2, 0], 1), ([3, 0], 1)]
)
def test_a_shard_on_github_is_tried_again_after_code_75(codes, tries, codes_of, let_end):
    let, calls = let_end
    let(*codes)
    assert codes_of("github", "shard", SHARD="0") == [codes[tries - 1]]
    assert calls() == ["generate"] * tries


@pytest.mark.parametrize("code, then", [(0, ["validate"]), (3, [])])
def test_a_merge_on_gitlab_is_reported_whatever_clips_failed(code, then, codes_of, let_end):
    let, calls = let_end
    let(code, 0, 0)
    assert codes_of("gitlab", "dataset") == [code]
    assert calls() == ["merge", "report", *then]


def test_the_matrix_has_all_shards():
    github = _pipeline("github")
    assert github["jobs"]["shard"]["strategy"]["matrix"]["shard"] == list(range(github["env"]["SHARDS"]))
