"""Draw the speed-error front of `veldt bench --suite radiance --json` as an SVG.

    build/release/bin/veldt bench --json > bench.json
    python3 tests/bench/plot_front.py bench.json thermal_core/accuracy.svg

Needs matplotlib (python3-matplotlib).
"""

from __future__ import annotations

import json
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "veldt"  # the same drawing gives the same file

from matplotlib import pyplot  # pylint: disable=wrong-import-position

_GROUPS = ("temperature to radiance", "radiance to temperature")
_LEAST_MK = 1e-11  # where a reference, whose error against itself is 0, is drawn


def draw(rows: list[dict], out: str) -> None:
    """One panel per group: ns per pixel on x, worst error in mK on y, dominated points in grey."""
    figure, panels = pyplot.subplots(1, len(_GROUPS), figsize=(10, 4.2))
    for panel, group in zip(panels, _GROUPS):
        members = [row for row in rows if row["group"] == group]
        for row in members:
            point = (row["ns_per_pixel"], max(row["worst_mk"], _LEAST_MK))
            panel.plot(*point, "o", color="0.6" if row["dominated"] else "C3")
            panel.annotate(row["name"], point, textcoords="offset points", xytext=(6, 4), fontsize=7)
        front = sorted(
            (row["ns_per_pixel"], max(row["worst_mk"], _LEAST_MK)) for row in members if not row["dominated"]
        )
        panel.plot(*zip(*front), color="C3", linewidth=0.8)
        panel.set(xscale="log", yscale="log", title=group, xlabel="ns a pixel", ylabel="worst error [mK]")
        panel.margins(0.25)
        panel.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(out, metadata={"Date": None})


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        draw(json.load(file)["rows"], sys.argv[2])
