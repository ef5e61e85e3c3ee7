"""What the program hands to its planner: a config that it has checked and filled in."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from pathlib import Path

from program import PROGRAM

# In place of Python: keeps its standard input, and fails.
_STAND_IN = '#!/bin/sh\ncat > "$(dirname "$0")/handed.json"\nexit 1\n'


def resolve(config: dict) -> dict:
    """The part of a config that its plan depends on, resolved. With it the config's own `render`, which plans ignore.

    ValueError with the program's message if it refuses the config.
    """
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "config.json"
        file.write_text(json.dumps(config), encoding="utf-8")
        return load(file)


def load(file: Path) -> dict:
    """The same for a config in a file, which may name other files relative to its folder."""
    with tempfile.TemporaryDirectory() as folder:
        python = Path(folder) / "python"
        python.write_text(_STAND_IN, encoding="utf-8")
        python.chmod(0o755)
        environment = {**os.environ, "VELDT_PYTHON": str(python)}
        command = [PROGRAM, "validate", file, "--progress", "none"]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        handed = Path(folder) / "handed.json"
        if not handed.exists():
            raise ValueError(done.stderr)
        planned = json.loads(handed.read_text(encoding="utf-8"))
    given = json.loads(Path(file).read_text(encoding="utf-8"))
    planned["render"] = {"supersample": 1, "actor_layer": False} | given.get("render", {}) | planned["render"]
    return planned
