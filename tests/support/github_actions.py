"""A stand-in for GitHub Actions."""

from __future__ import annotations

import fnmatch
import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from ci_services import Night, Service


class GitHub(Service):
    """A repository with a workflow. The actions known are methods here, with their inputs as arguments."""

    def night(self) -> Night:
        """All jobs, in the order of the file, which is one of their needs."""
        self.start_night()
        night = Night()
        for name, job in self.pipeline["jobs"].items():
            known = {"needs", "if", "runs-on", "container", "env", "strategy", "steps"}
            assert set(job) <= known, set(job) - known
            wanted = {
                "!cancelled() && needs.plan.result == 'success'": "plan" not in night.failed,
                "success()": not night.failed & set(_listed(job.get("needs", []))),
            }
            if wanted[_expression(job.get("if", "success()"))]:
                for matrix in self._matrix(job):
                    self._run_job(name, job, matrix, night)
            else:
                night.failed.add(name)
        return night

    def _matrix(self, job: dict) -> Iterator[dict]:
        strategy = job.get("strategy", {})
        assert strategy in (
            {},
            {"fail-fast": False, "matrix": {"shard": strategy.get("matrix", {}).get("shard")}},
        )
        for shard in strategy["matrix"]["shard"] if strategy else [None]:
            yield {} if shard is None else {"matrix.shard": shard}

    def _run_job(self, name: str, job: dict, matrix: dict, night: Night) -> None:
        values = {"vars.VELDT_IMAGE": "veldt"} | matrix
        user = re.fullmatch(r"--user (\d+)", job["container"]["options"])[1]
        assert self._fill(job["container"]["image"], values) == "veldt"
        title = f"{name} {matrix['matrix.shard']}" if matrix else name
        machine = _Machine(self.workspace(title), f"{user}:{user}", values)
        env = {k: self._fill(str(v), values) for k, v in (self.pipeline["env"] | job.get("env", {})).items()}
        codes = night.codes[title] = []
        for step in job["steps"]:
            wanted = {"!cancelled()": True, "success()": not any(codes)}
            if not wanted[_expression(step.get("if", "success()"))]:
                continue
            codes.append(self._step(step, machine, env))
        if any(codes):
            night.failed.add(name)
        else:
            machine.save_caches()

    def _step(self, step: dict, machine: _Machine, env: dict) -> int:
        assert set(step) <= {"id", "if", "run", "uses", "with"}, step
        if "uses" in step:
            action = step["uses"].split("@")[0].removeprefix("actions/").replace("-", "_")
            inputs = {
                k.replace("-", "_"): self._fill(str(v), machine.values)
                for k, v in step.get("with", {}).items()
            }
            getattr(self, f"_{action}")(machine, **inputs)
            return 0
        output = machine.folder / "output"
        output.touch()
        script = machine.folder / "step.sh"
        script.write_text(self._fill(step["run"], machine.values), encoding="utf-8")
        code = self.run(
            ["sh", "-e", "step.sh"], machine.folder, env | {"GITHUB_OUTPUT": "output"}, machine.user
        )
        for name, value in re.findall(r"^(\w+)=(.*)$", output.read_text(encoding="utf-8"), re.MULTILINE):
            machine.values[f"steps.{step['id']}.outputs.{name}"] = value
        output.unlink()
        script.unlink()
        return code

    def _fill(self, text: str, values: dict) -> str:
        known = values | {"hashFiles(env.CONFIG)": self.config_hash(self.pipeline["env"]["CONFIG"])}
        return re.sub(r"\$\{\{ (.*?) \}\}", lambda found: str(known[found[1]]), text)

    # The actions, with the inputs known.

    def _checkout(self, machine: _Machine) -> None:
        shutil.copytree(self.repository, machine.folder, dirs_exist_ok=True)

    def _cache(self, machine: _Machine, path: str, key: str) -> None:
        if (self.caches / key).exists():
            shutil.copytree(self.caches / key, machine.folder / path)
        else:
            machine.missed.append((machine.folder / path, self.caches / key))

    def _upload_artifact(
        self,
        machine: _Machine,
        name: str,
        path: str,
        overwrite: str,
        retention_days: str,
        compression_level: str = "",
    ) -> None:
        """Files alone, without hidden ones."""
        assert retention_days.isdigit() and compression_level in ("", "0")
        source, target = machine.folder / path, self.artifacts / name
        if target.exists():
            assert overwrite == "True", f"{name} exists already"
            shutil.rmtree(target)
        for file in [source] if source.is_file() else source.rglob("*"):
            inner = Path(file.name) if file == source else file.relative_to(source)
            if file.is_file() and not any(part.startswith(".") for part in inner.parts):
                (target / inner).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, target / inner)

    def _download_artifact(self, machine: _Machine, path: str, name: str = "", pattern: str = "") -> None:
        if name:
            shutil.copytree(self.artifacts / name, machine.folder / path)
        for artifact in sorted(self.artifacts.iterdir()) if pattern else []:
            if fnmatch.fnmatch(artifact.name, pattern):
                shutil.copytree(artifact, machine.folder / path / artifact.name)


@dataclass
class _Machine:
    """Where one job of GitHub's runs."""

    folder: Path
    user: str
    values: dict
    missed: list[tuple[Path, Path]] = field(default_factory=list)

    def save_caches(self) -> None:
        """After a job that succeeded, what was not in a cache."""
        for folder, cache in self.missed:
            shutil.copytree(folder, cache)


def _expression(text: str) -> str:
    return text.removeprefix("${{ ").removesuffix(" }}")


def _listed(names) -> list[str]:
    return [names] if isinstance(names, str) else names
