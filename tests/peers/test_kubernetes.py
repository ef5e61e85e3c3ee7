"""The jobs that `veldt cluster kubernetes` writes against the published schemas of Kubernetes' own objects."""

import kubernetes_validate
import pytest
import yaml

from configs import tiny
from program import Veldt

# maxFailedIndexes and backoffLimitPerIndex work without a switch since 1.33.
_VERSIONS = ("1.33", "1.37")


@pytest.fixture(scope="module", name="jobs")
def _jobs(tmp_path_factory) -> list[dict]:
    veldt = Veldt(tmp_path_factory.mktemp("kubernetes"))
    veldt.write("config.json", tiny())
    assert veldt("plan", "config.json", "--out", "plan", "--quiet").code == 0
    done = veldt("cluster", "kubernetes", "plan")
    assert (done.code, done.err) == (0, "")
    return list(yaml.safe_load_all(done.out))


@pytest.mark.parametrize("version", _VERSIONS)
def test_both_jobs_follow_the_schema(jobs, version):
    assert [job["kind"] for job in jobs] == ["Job", "Job"]
    for job in jobs:
        kubernetes_validate.validate(job, version, strict=True)


def test_the_schema_would_notice(jobs):
    jobs[0]["spec"]["completionz"] = jobs[0]["spec"].pop("completions")
    with pytest.raises(kubernetes_validate.ValidationError, match="completionz"):
        kubernetes_validate.validate(jobs[0], _VERSIONS[0], strict=True)
