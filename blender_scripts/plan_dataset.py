"""Checks what a config means and plans its dataset, without Blender.

    python3 plan_dataset.py --config FILE [--json]

Prints what each clip will show. A fault in the config: one line on stderr, exit code 2.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from veldt.config import load
from veldt.faults import ConfigError
from veldt.plan import plan_dataset
from veldt.world import plan_world


def main(arguments: list[str]) -> int:
    """Runs the command and returns its exit code."""
    parser = argparse.ArgumentParser(prog="plan_dataset.py", description="Checks and plans a dataset config.")
    parser.add_argument("--config", type=Path, required=True)
    parser.add_argument("--json", action="store_true", help="print the plan as one JSON object")
    options = parser.parse_args(arguments)
    try:
        plan = plan_dataset(plan_world(load(options.config)))
    except ConfigError as error:
        print(error, file=sys.stderr)
        return 2
    print(json.dumps(plan) if options.json else in_words(plan))
    return 0


def in_words(plan: dict) -> str:
    """The plan as a few lines of text."""
    lines = [
        f'{clip["id"]}: {clip["frames"]} frames, {clip["duration_s"]:g} s, actors in {clip["frames_with_actors"]},'
        f' {clip["min_agl_m"]:.1f} to {clip["max_agl_m"]:.1f} m above ground'
        for clip in plan["clips"]
    ]
    return "\n".join([*lines, f'{plan["objects"]} actors, {plan["plants"]} plants'])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
