"""A stand-in for GitLab, with a runner that has the docker executor."""

from __future__ import annotations

import shutil
from pathlib import Path

from ci_services import Night, Service


class GitLab(Service):
    """A repository with a pipeline. Its jobs are all keys but the global ones."""

    def night(self) -> Night:
        """All jobs, in the order of the file, which is one of their needs."""
        self.start_night()
        night = Night()
        for name, job in self.pipeline.items():
            if name in ("variables", "workflow", "default", "stages"):
                continue
            known = {"stage", "needs", "cache", "script", "artifacts", "parallel", "allow_failure"}
            assert set(job) <= known, set(job) - known
            assert job["stage"] in self.pipeline["stages"], job["stage"]
            if night.failed & set(job.get("needs", [])):
                night.failed.add(name)
                continue
            for index in range(1, job.get("parallel", 1) + 1):
                self._run_job(name, job, index, night)
        return night

    def _run_job(self, name: str, job: dict, index: int, night: Night) -> None:
        default = self.pipeline["default"]
        assert set(default) == {"image", "retry"} and default["image"]["entrypoint"] == [""]
        env = {key: str(value) for key, value in self.pipeline["variables"].items()}
        title = name
        if "parallel" in job:
            title = f"{name} {index}/{job['parallel']}"
            env |= {"CI_NODE_INDEX": str(index), "CI_NODE_TOTAL": str(job["parallel"])}
        codes = night.codes[title] = []
        while len(codes) <= default["retry"]["max"]:
            codes.append(self._try(title, job, env))
            if codes[-1] not in default["retry"]["exit_codes"]:
                break
        if codes[-1] and codes[-1] not in job.get("allow_failure", {}).get("exit_codes", []):
            night.failed.add(name)

    def _try(self, title: str, job: dict, env: dict) -> int:
        folder = self.workspace(title.replace("/", "_"))
        shutil.copytree(self.repository, folder, dirs_exist_ok=True)
        cache = self._cache(job)
        for source in [cache] if cache else []:
            shutil.copytree(source, folder, dirs_exist_ok=True)
        for need in job.get("needs", []):
            for artifact in self.artifacts.glob(f"{need}*"):
                shutil.copytree(artifact, folder, dirs_exist_ok=True)
        # How the runner gives a script to bash, line by line.
        script = "set -eo pipefail\n" + "\n".join(job["script"])
        code = self.run(["bash", "-c", script], folder, env, None)
        if code == 0 and cache:
            _copy_paths(folder, job["cache"]["paths"], cache)
        if code == 0 or job["artifacts"].get("when") == "always":
            _copy_paths(folder, job["artifacts"]["paths"], self.artifacts / title.replace("/", "_"))
        return code

    def _cache(self, job: dict) -> Path | None:
        if "cache" not in job:
            return None
        key = job["cache"]["key"]
        folder = self.caches / "-".join([key["prefix"], *map(self.config_hash, key["files"])])
        folder.mkdir(exist_ok=True)
        return folder


def _copy_paths(folder: Path, paths: list[str], target: Path) -> None:
    for path in paths:
        if (folder / path).is_file():
            target.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(folder / path, target / path)
        elif (folder / path).exists():
            shutil.copytree(folder / path, target / path, dirs_exist_ok=True)
