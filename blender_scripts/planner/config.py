"""Read a resolved config: checked by the `veldt` command, with all defaults.

The command checks types and ranges; `checks` checks values against each other.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from .faults import ConfigError

ROOT = Path(__file__).resolve().parents[2]
MAPS = ("heightmap", "density_map")  # of scene.terrain, each with a file


def load(path: Path) -> dict:
    """The resolved config at `path`, or on standard input for "-". ConfigError if it cannot be read as JSON."""
    try:
        content = sys.stdin.buffer.read() if str(path) == "-" else Path(path).read_bytes()
        return json.loads(content)
    except OSError as error:
        raise ConfigError(f"config = {path}; expected a readable file ({error.strerror})") from error
    except ValueError as error:
        raise ConfigError(f"config = {path}; expected JSON ({error})") from error


def input_files(config: dict) -> list[Path]:
    """The user's files that a config names, in the order in which it names them."""
    terrain = config["scene"]["terrain"]
    plans = [entry["flight"] for entry in (*config["clips"], *config["flights"]) if "flight" in entry]
    given = (*(terrain.get(name) for name in MAPS), *(plan.get("waypoints") for plan in plans))
    return [Path(name) for name in dict.fromkeys(entry["file"] for entry in given if entry is not None)]
