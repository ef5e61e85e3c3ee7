"""Draw the speed-error front of `veldt bench --suite truth --json` as an SVG.

    build/release/bin/veldt bench --suite truth --json > truth.json
    python3 tests/bench/plot_truth.py truth.json thermal_core/truth.svg

Needs matplotlib (python3-matplotlib).
"""

from __future__ import annotations

import json
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "veldt"  # the same drawing gives the same file

from matplotlib import pyplot  # pylint: disable=wrong-import-position

_GROUPS = {"sampling, still": "nothing moves", "sampling, moving": "camera at 12 m/s, person walks"}
_FIGURES = {"rms mK": "error over the target's pixels [mK rms]", "scatter %": "scatter of the signal [%]"}


def _front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Points that no other one beats in both time and error, by time."""
    best: list[tuple[float, float]] = []
    for point in sorted(points):
        if not best or point[1] < best[-1][1]:
            best.append(point)
    return best


def draw(rows: list[dict], out: str) -> None:
    """One panel per figure: ms per frame on x, error on y, one colour per group."""
    figure, panels = pyplot.subplots(1, len(_FIGURES), figsize=(10, 4.2))
    for panel, (key, label) in zip(panels, _FIGURES.items()):
        for colour, (group, legend) in zip(("C0", "C3"), _GROUPS.items()):
            members = [row for row in rows if row["group"] == group]
            points = [(row["figures"]["ms/frame"], row["figures"][key]) for row in members]
            panel.plot(*zip(*points), "o", color=colour)
            panel.plot(*zip(*_front(points)), color=colour, linewidth=0.8, label=legend)
            if group != "sampling, still":
                continue  # at the same times
            for row, point in zip(members, points):
                place = (-10, -13) if row["name"].startswith("adaptive") else (6, 4)
                panel.annotate(row["name"], point, textcoords="offset points", xytext=place, fontsize=7)
        panel.set(xscale="log", yscale="log", xlabel="ms a frame", ylabel=label)
        panel.margins(0.2)
        panel.grid(alpha=0.3)
        panel.legend(fontsize=8)
    figure.suptitle("A person at 122 m, against the truth")
    figure.tight_layout()
    figure.savefig(out, metadata={"Date": None})


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        draw(json.load(file)["rows"], sys.argv[2])
