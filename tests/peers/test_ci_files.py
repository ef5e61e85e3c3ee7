"""The files of `configs/ci` against the schemas that are published for them."""

import subprocess
import sys

import pytest

from program import ROOT

_FILES = ROOT / "configs" / "ci"
_SCHEMAS = {"github.yml": "vendor.github-workflows", "gitlab.yml": "vendor.gitlab-ci"}


def _check(file, schema: str) -> subprocess.CompletedProcess:
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", schema, file]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_there_is_a_schema_for_each_file():
    assert {file.name for file in _FILES.iterdir()} == set(_SCHEMAS)


@pytest.mark.parametrize("name", _SCHEMAS)
def test_the_file_follows_the_schema(name):
    done = _check(_FILES / name, _SCHEMAS[name])
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    "name, part, wrong",
    [
        ("github.yml", "runs-on: ubuntu-latest", "runs: ubuntu-latest"),
        ("github.yml", "fail-fast: false", "fail-late: false"),
        ("github.yml", "contents: read", "contents: some"),
        ("gitlab.yml", "max: 2", "max: 3"),
        ("gitlab.yml", "exit_codes: [75]", "exit_codes: [temporary]"),
        ("gitlab.yml", "when: always", "when: sometimes"),
    ],
)
def test_the_schema_would_notice(tmp_path, name, part, wrong):
    text = (_FILES / name).read_text(encoding="utf-8")
    assert part in text
    (tmp_path / name).write_text(text.replace(part, wrong), encoding="utf-8")
    done = _check(tmp_path / name, _SCHEMAS[name])
    assert done.returncode == 1
    assert "Schema validation errors" in done.stdout
