"""Check the meaning of a config and plan its dataset, without Blender.

    python3 plan_dataset.py --config FILE [--json]

Prints what each clip will show. A fault in the config prints one line on stderr and exits with code 2. Any other
failure prints a traceback whose last line has the exception, its place and a hint, and exits with code 1.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))  # python3 -I leaves it out

# pylint: disable=wrong-import-position
from veldt.failures import reported_imports, run

with reported_imports():
    from veldt.config import load
    from veldt.plan import plan_dataset
    from veldt.world import plan_world


def main(arguments: list[str]) -> int:
    """Run the command and return its exit code."""
    parser = argparse.ArgumentParser(prog="plan_dataset.py", description="Check and plan a dataset config.")
    parser.add_argument("--config", type=Path, required=True, help="a file, or - for standard input")
    parser.add_argument("--json", action="store_true", help="print the plan as one JSON object")
    options = parser.parse_args(arguments)
    return run(lambda: _plan(options))


def _plan(options: argparse.Namespace) -> None:
    plan = plan_dataset(plan_world(load(options.config)))
    print(json.dumps(plan) if options.json else in_words(plan))


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
