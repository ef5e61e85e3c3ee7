"""What the stand-ins for GitHub Actions and GitLab share: they do what a file of either says, step by step.

What they do not know is an error, so that no key, action or expression is in a file that has not been tried.
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import yaml

# Runs a command in a folder as a user, or as the image's, and returns its exit code.
Run = Callable[[list[str], Path, dict, str | None], int]


@dataclass
class Night:
    """How a pipeline went: exit codes of the steps of each job, or of its tries, and which jobs failed."""

    codes: dict[str, list[int]] = field(default_factory=dict)
    failed: set[str] = field(default_factory=set)


@dataclass
class Service:
    """A user's repository with a file of the service, and what the service keeps."""

    file: Path
    repository: Path
    kept: Path  # artifacts of the night, and caches of all nights
    run: Run

    def __post_init__(self):
        self.pipeline = yaml.safe_load(self.file.read_text(encoding="utf-8"))
        self.artifacts = self.kept / "artifacts"
        self.caches = self.kept / "caches"

    def start_night(self) -> None:
        """Artifacts are those of one night."""
        shutil.rmtree(self.artifacts, ignore_errors=True)
        self.artifacts.mkdir(parents=True)
        self.caches.mkdir(exist_ok=True)

    def workspace(self, job: str) -> Path:
        """A new machine for a job."""
        folder = self.kept / "workspaces" / job
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder

    def config_hash(self, name: str) -> str:
        """Hash of a file in the repository."""
        return hashlib.sha256((self.repository / name).read_bytes()).hexdigest()


def run_here(program: Path) -> Run:
    """Runs commands on this machine, with the folder of `program` first on PATH."""

    def run(command: list[str], folder: Path, env: dict, _user: str | None) -> int:
        path = f"{program.parent}:/usr/bin:/bin"
        return subprocess.run(command, cwd=folder, env={"PATH": path, **env}, check=False).returncode

    return run


def run_in_image(root: Path, default_user: str) -> Run:
    """Runs commands in an unpacked image, whose /data becomes the folder; it belongs to the user by then."""

    def run(command: list[str], folder: Path, env: dict, user: str | None) -> int:
        ids = user or default_user
        _give(folder, ids)
        words = ["HOME=/tmp", "PATH=/usr/local/bin:/usr/bin:/bin", *(f"{k}={v}" for k, v in env.items())]
        inside = ["chroot", f"--userspec={ids}", "--groups=", str(root), "env", "-i", *words]
        subprocess.run(["mount", "--bind", folder, root / "data"], check=True)
        try:
            script = [*inside, "sh", "-c", 'cd /data && exec "$@"', "sh", *command]
            return subprocess.run(script, check=False).returncode
        finally:
            subprocess.run(["umount", root / "data"], check=True)

    return run


def _give(folder: Path, ids: str) -> None:
    """Gives a folder to a user, as both services do before a step."""
    subprocess.run(["chown", "--recursive", "--no-dereference", ids, folder], check=True)
