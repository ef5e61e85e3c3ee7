"""Draw a map of the ground of a config's scene, without Blender.

    python3 draw_map.py --config FILE --out FOLDER [--points FILE]

Writes place.png, a map of the whole scene. With --points, also writes window.png, the ground around the given points:
FILE holds a JSON list of [x_m, y_m, ground_m], where ground_m is the known height of the ground or water there, or
null. Prints one JSON object: the south-west corner and the side of each picture in metres, and off_m, the largest
difference between the given heights and those of the scene.
A fault in the config prints one line on stderr and exits with code 2. Any other failure prints a traceback whose last
line has the exception, its location and a hint, and exits with code 1.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))  # python3 -I omits it

# pylint: disable=wrong-import-position
from planner.failures import reported_imports, run

with reported_imports():
    import numpy as np

    from planner.config import load
    from planner.images import write_rgb
    from planner.land.road_plan import plan_road
    from planner.land.terrain import Terrain, build_terrain
    from planner.plants.density import plan_density
    from planner.preview.ground_picture import draw_ground, whole_place, window_round

PLACE_PX, WINDOW_PX = 320, 640


def main(arguments: list[str]) -> int:
    """Run the command and return its exit code."""
    parser = argparse.ArgumentParser(prog="draw_map.py", description="Draw the place of a dataset config.")
    parser.add_argument("--config", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True, help="folder for the pictures")
    parser.add_argument(
        "--points", type=Path, help="points to draw the ground around, and to compare heights at"
    )
    options = parser.parse_args(arguments)
    return run(lambda: print(json.dumps(draw(load(options.config), options.out, _points(options.points)))))


def draw(config: dict, out: Path, points_m: np.ndarray) -> dict:
    """Write the maps of a config's scene and return their corners and sides; points_m (n, 3) may be empty."""
    settings, seed = config["scene"]["terrain"], config["seed"]
    terrain = build_terrain(settings, seed)
    terrain = terrain.with_road(plan_road(settings["road"], terrain, seed))
    views = {"place": (whole_place(terrain), PLACE_PX)}
    if len(points_m) > 0:
        views["window"] = (window_round(points_m[:, :2]), WINDOW_PX)
    areas = plan_density(terrain, settings, seed)
    answer = {"off_m": _off_m(terrain, points_m)}
    for name, (window, side_px) in views.items():
        write_rgb(out / f"{name}.png", draw_ground(terrain, areas, window, side_px))
        answer[name] = asdict(window)
    return answer


def _points(file: Path | None) -> np.ndarray:
    given = json.loads(file.read_text(encoding="utf-8")) if file else []
    return np.array(given, float).reshape(-1, 3)


def _off_m(terrain: Terrain, points_m: np.ndarray) -> float:
    x_m, y_m, ground_m = points_m[np.isfinite(points_m[:, 2])].T
    return float(np.abs(terrain.surface_m(x_m, y_m) - ground_m).max(initial=0.0))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
