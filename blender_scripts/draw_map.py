"""Draws the ground of a config's place from above, without Blender.

    python3 draw_map.py --config FILE --out FOLDER [--points FILE]

Writes place.png, all of the place. FILE of --points holds a JSON list of [x_m, y_m, ground_m], places with the height
that the ground or the water is known to have there, or null: window.png then is the ground round them. Prints one JSON
object: for each picture its south-west corner and side in metres, and off_m, how far those heights are off this place's
at most.
A fault in the config: one line on stderr, exit code 2.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path

import numpy as np

from veldt.config import load
from veldt.faults import ConfigError
from veldt.land.road_plan import plan_road
from veldt.land.terrain import Terrain, build_terrain
from veldt.plants.density import plan_density
from veldt.png_files import rgb_png
from veldt.preview.ground_picture import draw_ground, whole_place, window_round

PLACE_PX, WINDOW_PX = 320, 640


def main(arguments: list[str]) -> int:
    """Runs the command and returns its exit code."""
    parser = argparse.ArgumentParser(prog="draw_map.py", description="Draws the place of a dataset config.")
    parser.add_argument("--config", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True, help="folder for the pictures")
    parser.add_argument("--points", type=Path, help="places to draw the ground round, and to compare it at")
    options = parser.parse_args(arguments)
    try:
        answer = draw(load(options.config), options.out, _points(options.points))
    except ConfigError as error:
        print(error, file=sys.stderr)
        return 2
    print(json.dumps(answer))
    return 0


def draw(config: dict, out: Path, points_m: np.ndarray) -> dict:
    """Writes the pictures of a config's place and tells where they are; points_m (n, 3) may be none."""
    settings, seed = config["scene"]["terrain"], config["seed"]
    terrain = build_terrain(settings, seed)
    terrain = terrain.with_road(plan_road(settings["road"], terrain, seed))
    views = {"place": (whole_place(terrain), PLACE_PX)}
    if len(points_m) > 0:
        views["window"] = (window_round(points_m[:, :2]), WINDOW_PX)
    areas = plan_density(terrain, settings, seed)
    answer = {"off_m": _off_m(terrain, points_m)}
    for name, (window, side_px) in views.items():
        (out / f"{name}.png").write_bytes(rgb_png(draw_ground(terrain, areas, window, side_px)))
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
