"""Plan a dataset: check a resolved config, cut its flights into clips, and bake its scene. No Blender.

    python3 plan_scene.py --config FILE [--out DIR [--preview] [--earlier DIR] [--blender PROGRAM]]
            [--processes N] [--events-fd N]

Prints the plan as JSON. With --out, writes it to DIR/plan.json, with the baked scene in DIR/scene.json and
DIR/scene.bin, and the track of each clip in DIR/tracks. The config is one that `veldt` has resolved. Each planned clip
or flight is an event: `planned`, with `id`, `done` and `total`. A fault in the config prints one line on stderr and
exits with code 2. Any other failure prints a traceback whose last line has the exception, its location and a hint, and
exits with code 1.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))  # python3 -I omits it

# pylint: disable=wrong-import-position
from planner.failures import reported_imports, run

with reported_imports():
    from planner.bake.folder import bake_plan, plan
    from planner.config import load
    from planner.events import Events
    from planner.model_meshes import ModelMeshes
    from planner.workers import Cores


def main(arguments: list[str]) -> int:
    """Run the command and return its exit code."""
    parser = argparse.ArgumentParser(prog="plan_scene.py", description="Check, plan and bake a dataset.")
    parser.add_argument(
        "--config", type=Path, required=True, help="resolved; a file, or - for standard input"
    )
    parser.add_argument("--out", type=Path, help="write the plan and its baked scene into this empty folder")
    parser.add_argument("--preview", action="store_true", help="also bake what a preview needs")
    parser.add_argument("--earlier", type=Path, help="an earlier plan, whose models are used again")
    parser.add_argument("--blender", default="", help="Blender, to read models of other programs")
    parser.add_argument("--processes", type=int, default=1, help="work with this many processes")
    parser.add_argument("--events-fd", type=int, help="write progress here, one JSON object per line")
    options = parser.parse_args(arguments)
    return run(lambda: _plan(options))


def _plan(options: argparse.Namespace) -> None:
    events = Events(options.events_fd)
    config, cores = load(options.config), Cores(options.processes)

    def planned(name: str, done: int, total: int) -> None:
        events.report("planned", id=name, done=done, total=total)

    if options.out is None:
        print(json.dumps(plan(config, cores, planned)))
        return
    earlier = options.earlier / "models" if options.earlier else None
    models = ModelMeshes(options.out / "models", earlier, options.blender)
    print(json.dumps(bake_plan(config, options.out, models, cores, planned, options.preview)))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
