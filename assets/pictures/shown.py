"""What the pictures of the pages show, as far as it can be made again in seconds.

A frame depends on those before it in its clip, so the first one alone stands for a clip. The ray caster draws it: its
pixels do not depend on the machine.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple, Protocol

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))

# pylint: disable=wrong-import-position
from numpy_settings import REPRODUCIBLE
from program import PROGRAM
from resolved import load


def veldt(*arguments: object) -> None:
    """Run the program in the repository's root. CalledProcessError if it fails, which it says on standard error."""
    command = [PROGRAM, *map(str, arguments), "--quiet"]
    subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)


class Shown(Protocol):
    """Something that is shown; pictures may share it."""

    def command(self) -> list[str]:
        """What makes it, but for the folder."""

    def make(self, folder: Path) -> dict[str, str | int]:
        """Make it in a folder that does not exist yet: checksums, and figures, by name."""


class Frames(NamedTuple):
    """The first frames of a config's clips, or of some of them; settings may save time."""

    config: str
    settings: tuple[str, ...] = ()
    clips: tuple[str, ...] = ()

    def command(self) -> list[str]:
        """See Shown."""
        clips = json.loads((ROOT / self.config).read_text(encoding="utf-8"))["clips"]
        cuts = (f"clips[{k}].frames=1" for k, clip in enumerate(clips) if clip["frames"] > 1)
        settings, chosen = [*self.settings, *cuts], ",".join(self.clips)
        return [
            *("veldt", "generate", self.config, "--engine", "embree"),
            *(("--clips", chosen) if chosen else ()),
            *(("--set", *settings) if settings else ()),
        ]

    def make(self, folder: Path) -> dict[str, str | int]:
        """pixels_sha256 by clip."""
        veldt(*self.command()[1:], "--out", folder)
        index = json.loads((ROOT / folder / "dataset.json").read_text(encoding="utf-8"))
        return {clip["id"]: clip["pixels_sha256"] for clip in index["clips"] if "pixels_sha256" in clip}


class Map(NamedTuple):
    """A config's place from above, as the program passes it to Blender."""

    config: str

    def command(self) -> list[str]:
        """See Shown."""
        return ["python3", "assets/pictures/map_checksums.py", self.config]

    def make(self, folder: Path) -> dict[str, str | int]:
        """SHA-256 of the map's parts, and how many plants and actors it shows."""
        folder.mkdir()
        resolved = folder / "config.json"
        resolved.write_text(json.dumps(load(ROOT / self.config)), encoding="utf-8")
        script = [sys.executable, "-B", *self.command()[1:-1], resolved, folder]
        done = subprocess.run(
            script, cwd=ROOT, env=os.environ | REPRODUCIBLE, stdout=subprocess.PIPE, text=True, check=True
        )
        return json.loads(done.stdout)


class Day(NamedTuple):
    """The chart of the temperatures of some surfaces over a config's days."""

    config: str
    surfaces: tuple[str, ...]

    def command(self) -> list[str]:
        """See Shown."""
        return ["veldt", "heat", self.config, "--surfaces", ",".join(self.surfaces)]

    def make(self, folder: Path) -> dict[str, str | int]:
        """SHA-256 of its text."""
        folder.mkdir()
        veldt(*self.command()[1:], "--plot", folder / "day.svg")
        return {"day.svg": hashlib.sha256((folder / "day.svg").read_bytes()).hexdigest()}
