"""Check the meaning of a config and plan its dataset, without Blender.

    python3 plan_dataset.py --config FILE [--json] [--processes N] [--events-fd N]

Prints what each clip will show. Each clip or flight is an event when it is planned: `planned`, with `id`, `done` and
`total`. A fault in the config prints one line on stderr and exits with code 2. Any other failure prints a traceback
whose last line has the exception, its place and a hint, and exits with code 1.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))  # python3 -I leaves it out

# pylint: disable=wrong-import-position
from veldt.failures import reported_imports, run

with reported_imports():
    from veldt.config import load
    from veldt.events import Events
    from veldt.plan import plan_dataset
    from veldt.workers import in_order
    from veldt.world import plan_world


def main(arguments: list[str]) -> int:
    """Run the command and return its exit code."""
    parser = argparse.ArgumentParser(prog="plan_dataset.py", description="Check and plan a dataset config.")
    parser.add_argument("--config", type=Path, required=True, help="a file, or - for standard input")
    parser.add_argument("--json", action="store_true", help="print the plan as one JSON object")
    parser.add_argument("--processes", type=int, default=1, help="plan this many flights at once")
    parser.add_argument("--events-fd", type=int, help="write progress here, one JSON object per line")
    options = parser.parse_args(arguments)
    return run(lambda: _plan(options))


def _plan(options: argparse.Namespace) -> None:
    events = Events(options.events_fd)

    def each(act: Callable, entries: list) -> Iterator:
        for k, result in enumerate(in_order(act, entries, options.processes)):
            events.report("planned", id=entries[k]["id"], done=k + 1, total=len(entries))
            yield result

    plan = plan_dataset(plan_world(load(options.config)), each)
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
