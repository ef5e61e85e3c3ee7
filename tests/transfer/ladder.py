#!/usr/bin/env python3
"""How well does a detector trained on a config's frames find people in real ones?

    tests/transfer/ladder.py CONFIG --real ANNOTATIONS.json FOLDER --out OUT

Generates the dataset, exports its labels as people draw them, trains a small detector on it from several seeds, with no
real frames, a few, and many, and beside it on those real frames alone. Real frames are split by the order of their
names: every other one is for training, the rest judges. Everything that exists in OUT already is kept. Needs
python3-torch and python3-opencv; each training takes minutes on two cores. Results and how to read them:
thermal_core/TRANSFER.md.
"""

from __future__ import annotations

import argparse
import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch

from detector import Detector, detect, train
from frames import Frame, read_frames
from scores import scores_of

_VELDT = Path(__file__).resolve().parents[2] / "build" / "release" / "bin" / "veldt"
_RATE, _FINE_RATE = 3e-3, 1e-3
_FINE_STEPS = 0.4  # of the steps, on real frames after frames of the dataset
_KEYS = ("ap50", "ap30", "recall50")


@dataclass(frozen=True)
class Ladder:
    """What is trained and judged, and where it is kept."""

    out: Path
    steps: int
    made: list[Frame]
    real: list[Frame]
    judged: list[Frame]

    def scores(self, count: int, seed: int, with_made: bool) -> dict[str, float]:
        """The figures of a detector trained with `count` real frames."""
        name = f"{'veldt_' if with_made else ''}real_{count}_seed_{seed}"
        file = self.out / "scores" / f"{name}.json"
        if not file.exists():
            detector = self._trained(name, count, seed, with_made)
            found = [detect(detector, frame.file) for frame in self.judged]
            truth_px = [frame.boxes_px for frame in self.judged]
            ap50, recall = scores_of(found, truth_px, 0.5)
            ap30, _ = scores_of(found, truth_px, 0.3)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(json.dumps({"ap50": ap50, "ap30": ap30, "recall50": recall}), encoding="utf-8")
        return json.loads(file.read_text(encoding="utf-8"))

    def _trained(self, name: str, count: int, seed: int, with_made: bool) -> Detector:
        some = np.random.default_rng(0).permutation(len(self.real))[:count]
        real = [self.real[k] for k in sorted(some)]
        weights = self.out / "weights" / f"{name}.pt"
        if not weights.exists():
            weights.parent.mkdir(parents=True, exist_ok=True)
            if with_made and count > 0:
                self._trained(f"veldt_real_0_seed_{seed}", 0, seed, True)
                start = self.out / "weights" / f"veldt_real_0_seed_{seed}.pt"
                detector = train(real, round(_FINE_STEPS * self.steps), seed, _FINE_RATE, start)
            else:
                detector = train(self.made if with_made else real, self.steps, seed, _RATE)
            torch.save(detector.state_dict(), weights)
        detector = Detector()
        detector.load_state_dict(torch.load(weights))
        return detector.eval()


def _made_frames(options: argparse.Namespace) -> list[Frame]:
    """The frames of the config at all places, generated and exported where that was not done before."""
    seed = json.loads(options.config.read_text(encoding="utf-8")).get("seed", 1)
    frames = []
    for place in range(options.places):
        name = "" if place == 0 else f"_{place + 1}"
        data, export = options.out / f"dataset{name}", options.out / f"export{name}"
        of_place = ["--set", f"seed={seed + place}"] if place > 0 else []
        subprocess.run([options.veldt, "generate", options.config, "--out", data, *of_place], check=True)
        style = ["--format", "coco", "--box-style", options.box_style]
        subprocess.run([options.veldt, "export", data, *style, "--out", export, "--quiet"], check=True)
        frames += read_frames(export / "annotations.json", export)
    return frames


def _print_table(ladder: Ladder, counts: list[int], seeds: list[int]) -> None:
    print(
        f"{len(ladder.made)} frames made, {len(ladder.real)} real ones to train with, {len(ladder.judged)} judge"
    )
    print(
        "| real frames | made | AP50 | AP30 | found at one false alarm a frame | seeds |\n|---|---|---|---|---|---|"
    )
    for count in counts:
        for with_made in (True, False) if count > 0 else (True,):
            scores = [ladder.scores(count, seed, with_made) for seed in seeds]
            cells = []
            for key in _KEYS:
                values = np.array([each[key] for each in scores])
                cells.append(f"{values.mean():.3f} ± {values.std(ddof=1) if len(values) > 1 else 0:.3f}")
            print(
                f"| {count} | {'yes' if with_made else 'no'} | {' | '.join(cells)} | {len(seeds)} |",
                flush=True,
            )


def main() -> None:
    """Generate, train and judge."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("config", type=Path)
    parser.add_argument("--real", nargs=2, type=Path, required=True, metavar=("LABELS", "FOLDER"))
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--steps", type=int, default=2500)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--ladder", type=int, nargs="+", default=[0, 14, 80], help="numbers of real frames")
    parser.add_argument("--places", type=int, default=1, help="of the config, each with another seed")
    parser.add_argument("--box-style", choices=("drawn", "visible"), default="drawn")
    parser.add_argument("--veldt", type=Path, default=_VELDT)
    options = parser.parse_args()
    frames = read_frames(*options.real)
    ladder = Ladder(options.out, options.steps, _made_frames(options), frames[0::2], frames[1::2])
    _print_table(ladder, options.ladder, options.seeds)


if __name__ == "__main__":
    main()
