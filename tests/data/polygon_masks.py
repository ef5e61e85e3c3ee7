"""Computes polygon_masks.csv: masks of polygons as pycocotools makes them (needs pycocotools 2.0.11).

Each row is a picture's size, its polygons and the mask's compressed run lengths: `merge(frPyObjects(…))`. Polygons
have corners on whole pixels, between them, outside of the picture and at the same place; they are slanted, steep,
thin, nested, apart and crossing themselves.
"""

import math
import random
from pathlib import Path

from pycocotools import mask

SEED = 20260711
KINDS = 12


def _random(draw: random.Random, width: int, height: int, margin: float, digits: int) -> list[float]:
    corners = draw.randint(3, 9)
    places = [
        (draw.uniform(-margin, width + margin), draw.uniform(-margin, height + margin))
        for _ in range(corners)
    ]
    return [round(value, digits) for place in places for value in place]


def _star(draw: random.Random, width: int, height: int) -> list[float]:
    corners = draw.randint(5, 40)
    rays = [(k * 2 * math.pi / corners, draw.uniform(0.2, 0.6)) for k in range(corners)]
    return [
        round(value, 2)
        for angle, length in rays
        for value in (width * (0.5 + length * math.cos(angle)), height * (0.5 + length * math.sin(angle)))
    ]


def _cases() -> list[tuple[int, int, list[list[float]]]]:
    draw = random.Random(SEED)
    cases = [
        (64, 48, [[10, 8, 30, 8, 30, 38, 10, 38]]),
        (64, 48, [[0, 0, 64, 0, 64, 48, 0, 48]]),  # the whole picture
        (5, 4, [[1, 1, 1, 1, 1, 1]]),  # nothing
        (5, 4, [[-9, -9, -5, -9, -5, -5]]),  # nothing inside
        (9, 7, [[1, 1, 4, 1, 4, 4, 1, 4], [4, 1, 7, 1, 7, 4, 4, 4]]),  # beside each other
        (9, 7, [[1, 1, 8, 1, 8, 6, 1, 6], [3, 2, 5, 2, 5, 4, 3, 4]]),  # one in the other
        (9, 7, [[2.5, 0, 2.5, 7, 3.5, 7, 3.5, 0]]),
        (9, 7, [[0.3, 0.3, 0.7, 0.3, 0.7, 0.7, 0.3, 0.7]]),
        (9, 7, [[-0.75, 2, 5, 2.2, 5, 6, -0.75, 5]]),
        (9, 7, [[4, -0.7, 8, 3, 4, 7.6, 0, 3]]),
    ]
    for _ in range(KINDS):
        width, height = draw.randint(1, 70), draw.randint(1, 60)
        cases.append((width, height, [_random(draw, width, height, 0, 0)]))
        cases.append((width, height, [_random(draw, width, height, 0, 2)]))
        cases.append((width, height, [_random(draw, width, height, 30, 2)]))
        cases.append((width, height, [_random(draw, width, height, 3000, 1)]))
        cases.append((width, height, [_star(draw, width, height)]))
        cases.append((width, height, [_random(draw, width, height, 5, 1) for _ in range(draw.randint(2, 4))]))
    return cases


def main() -> None:
    """Write the table beside this file."""
    lines = [
        "# Masks of polygons, as pycocotools 2.0.11 makes them; written by polygon_masks.py.",
        "width_px,height_px,polygons,counts",
    ]
    for width, height, polygons in _cases():
        counts = mask.merge(mask.frPyObjects(polygons, height, width))["counts"].decode()
        assert "," not in counts
        text = ";".join(" ".join(f"{value:g}" for value in polygon) for polygon in polygons)
        lines.append(f"{width},{height},{text},{counts}")
    Path(__file__).with_suffix(".csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
