#!/usr/bin/env python3
"""How well does a detector trained on a config's frames find people in real ones?

    tests/transfer/ladder.py CONFIG --real ANNOTATIONS.json FOLDER --out OUT

Generates the dataset, exports its labels as people draw them, trains a small detector on it from several seeds, with
no real frames, a few, and many, and beside it on those real frames alone. Real frames are split by the order of their
names: every other one is for training, the rest judges. --also judges by other frames, too; --chain draws what
cameras and links do after the sensor while it trains, with the package `veldt` (VELDT_HOME=$PWD
PYTHONPATH=$PWD/build/release/python). Everything that exists in OUT already is kept. Needs python3-torch and
python3-opencv; each training takes minutes on two cores. Results and how to read them: thermal_core/TRANSFER.md.
"""

from __future__ import annotations

import argparse
import hashlib
import itertools
import json
import multiprocessing
import os
import subprocess
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch

from detector import Detector, detect, train
from frames import Chain, Crops, Frame, read_frames
from scores import enlarged, scores_of

_VELDT = Path(__file__).resolve().parents[2] / "build" / "release" / "bin" / "veldt"
_RATE, _FINE_RATE = 3e-3, 1e-3
_FINE_STEPS = 0.4  # of the steps, on real frames after frames of the dataset
KEYS = ("ap50", "ap30", "recall50")


@dataclass(frozen=True)
class Training:
    """A detector that is trained with some real frames, and with the dataset before them or without it."""

    count: int
    seed: int
    with_made: bool

    @property
    def name(self) -> str:
        """Of its files."""
        return f"{'veldt_' if self.with_made else ''}real_{self.count}_seed_{self.seed}"

    @property
    def start(self) -> Training | None:
        """What it goes on from."""
        return Training(0, self.seed, True) if self.with_made and self.count > 0 else None


@dataclass(frozen=True)
class Judge:
    """Real frames that judge, and how much larger people drew their boxes than those of the real frames above."""

    name: str
    frames: list[Frame]
    box_scale: float = 1.0

    def scores(self, detector: Detector) -> dict[str, float]:
        """The figures of a detector."""
        found = [enlarged(detect(detector, frame.file), self.box_scale) for frame in self.frames]
        truth_px = [frame.boxes_px for frame in self.frames]
        ap50, recall = scores_of(found, truth_px, 0.5)
        ap30, _ = scores_of(found, truth_px, 0.3)
        return {"ap50": ap50, "ap30": ap30, "recall50": recall}


@dataclass(frozen=True)
class Draws:
    """What cameras and links do after the sensor, drawn `per_frame` times for each frame made, or 0: for each crop."""

    settings: Path
    per_frame: int

    @property
    def name(self) -> str:
        """Of a training's files: one with other settings is another."""
        digest = hashlib.sha256(self.settings.read_bytes()).hexdigest()[:8]
        return f"_{self.settings.stem}_{digest}_{self.per_frame}"

    def chain(self, seed: int) -> Chain:
        """Of a training. The package is needed only here."""
        import veldt  # pylint: disable=import-outside-toplevel

        # pylint: disable-next=no-member
        return veldt.VideoChain(json.loads(self.settings.read_text(encoding="utf-8")), seed=seed)


@dataclass(frozen=True)
class Ladder:
    """What is trained and judged, and where it is kept."""

    out: Path
    steps: int
    made: list[Frame]
    real: list[Frame]
    judges: list[Judge]
    draws: Draws | None = None

    def train(self, training: Training) -> None:
        """Keep the weights of a training, whose start is kept already."""
        weights = self._weights(training)
        if weights.exists():
            return
        crops = self._crops(training)
        if training.start is not None:
            steps = round(_FINE_STEPS * self.steps)
            detector = train(crops, steps, training.seed, _FINE_RATE, self._weights(training.start))
        else:
            detector = train(crops, self.steps, training.seed, _RATE)
        weights.parent.mkdir(parents=True, exist_ok=True)
        part = weights.with_suffix(".part")
        torch.save(detector.state_dict(), part)
        part.replace(weights)

    def scores(self, training: Training, judge: Judge) -> dict[str, float]:
        """The figures of a training by one judge."""
        file = self.out / "scores" / f"{self._name(training)}_{judge.name}.json"
        if not file.exists():
            detector = Detector()
            detector.load_state_dict(torch.load(self._weights(training)))
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(json.dumps(judge.scores(detector.eval())), encoding="utf-8")
        return json.loads(file.read_text(encoding="utf-8"))

    def _crops(self, training: Training) -> Crops:
        if training.count > 0:
            return Crops(self._some_real(training), training.seed)
        if self.draws is None:
            return Crops(self.made, training.seed)
        return Crops(self.made, training.seed, self.draws.chain(training.seed), self.draws.per_frame)

    def _name(self, training: Training) -> str:
        return training.name + (self.draws.name if self.draws and training.with_made else "")

    def _weights(self, training: Training) -> Path:
        return self.out / "weights" / f"{self._name(training)}.pt"

    def _some_real(self, training: Training) -> list[Frame]:
        some = np.random.default_rng(0).permutation(len(self.real))[: training.count]
        return [self.real[k] for k in sorted(some)]


Work = tuple[Ladder, Training]


def train_all(work: list[Work], at_once: int) -> None:
    """Keep the weights of trainings and of what they start from. Each has its share of the cores."""
    first = _distinct([(ladder, each.start or each) for ladder, each in work])
    then = [(ladder, each) for ladder, each in work if each.start]
    threads = max(1, len(os.sched_getaffinity(0)) // at_once)
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(at_once, spawn, torch.set_num_threads, (threads,)) as pool:
        for stage in (first, then):
            for done in [pool.submit(ladder.train, each) for ladder, each in stage]:
                done.result()


def _distinct(work: list[Work]) -> list[Work]:
    return list({(ladder.out, each): (ladder, each) for ladder, each in work}.values())


def made_frames(options: argparse.Namespace) -> list[Frame]:
    """The frames of a config at all places, generated and exported where that was not done before.

    options: config, out, places, box_style and veldt, as main() reads them.
    """
    seed = json.loads(options.config.read_text(encoding="utf-8")).get("seed", 1)
    frames = []
    for place in range(options.places):
        name = "" if place == 0 else f"_{place + 1}"
        data, export = options.out / f"dataset{name}", options.out / f"export{name}"
        of_place = ["--set", f"seed={seed + place}"] if place > 0 else []
        subprocess.run([options.veldt, "generate", options.config, "--out", data, *of_place], check=True)
        style = ["--format", "coco", "--box-style", options.box_style]
        if options.like and options.box_style == "drawn":
            style += ["--like", options.like]
        subprocess.run([options.veldt, "export", data, *style, "--out", export, "--quiet"], check=True)
        frames += read_frames(export / "annotations.json", export)
    return frames


def _rows(counts: list[int]) -> list[tuple[int, bool]]:
    """Numbers of real frames, each with the dataset before them and without it."""
    return [(count, with_made) for count in counts for with_made in ((True, False) if count > 0 else (True,))]


def _cells(scores: list[dict[str, float]]) -> list[str]:
    """Mean and deviation of each figure over the seeds."""
    values = np.array([[each[key] for key in KEYS] for each in scores])
    deviations = values.std(axis=0, ddof=1) if len(values) > 1 else np.zeros(len(KEYS))
    return [f"{mean:.3f} ± {deviation:.3f}" for mean, deviation in zip(values.mean(axis=0), deviations)]


def _print_table(ladder: Ladder, counts: list[int], seeds: list[int]) -> None:
    print(f"{len(ladder.made)} frames made, {len(ladder.real)} real ones to train with")
    print(
        "| judged by | real frames | made | AP50 | AP30 | found at one false alarm a frame | seeds |\n"
        "|---|---|---|---|---|---|---|"
    )
    for judge, (count, with_made) in itertools.product(ladder.judges, _rows(counts)):
        scores = [ladder.scores(Training(count, seed, with_made), judge) for seed in seeds]
        made = "yes" if with_made else "no"
        row = (f"{len(judge.frames)} {judge.name}", count, made, *_cells(scores), len(seeds))
        print(f"| {' | '.join(map(str, row))} |", flush=True)


def judges_of(options: argparse.Namespace) -> list[Judge]:
    """The odd half of --real, and the frames of each --also."""
    also = [
        Judge(name, read_frames(Path(labels), Path(folder)), float(scale))
        for name, labels, folder, scale in options.also
    ]
    return [Judge("real", read_frames(*options.real)[1::2]), *also]


def draws_of(options: argparse.Namespace) -> Draws | None:
    """Of --chain."""
    return Draws(options.chain, options.draws) if options.chain else None


def parser_of(description: str) -> argparse.ArgumentParser:
    """The options that the scripts of this folder have in common."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("config", type=Path)
    parser.add_argument("--real", nargs=2, type=Path, required=True, metavar=("LABELS", "FOLDER"))
    parser.add_argument(
        "--also",
        nargs=4,
        action="append",
        default=[],
        metavar=("NAME", "LABELS", "FOLDER", "SCALE"),
        help="judge by these frames, too, with detections SCALE times as large",
    )
    parser.add_argument(
        "--chain", type=Path, metavar="FILE", help="settings of veldt.VideoChain, drawn while it trains"
    )
    parser.add_argument(
        "--draws", type=int, default=0, help="of --chain for each frame made; 0: for each crop (default)"
    )
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--steps", type=int, default=2500)
    parser.add_argument("--places", type=int, default=1, help="of the config, each with another seed")
    parser.add_argument(
        "--at-once", type=int, default=2, help="trainings side by side (default: %(default)s)"
    )
    parser.add_argument("--veldt", type=Path, default=_VELDT)
    return parser


def main() -> None:
    """Generate, train and judge."""
    parser = parser_of(__doc__)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--ladder", type=int, nargs="+", default=[0, 14, 80], help="numbers of real frames")
    parser.add_argument("--box-style", choices=("drawn", "visible"), default="drawn")
    parser.add_argument("--like", help="draw boxes as in this set: see veldt export --like")
    options = parser.parse_args()
    real = read_frames(*options.real)[0::2]
    ladder = Ladder(
        options.out, options.steps, made_frames(options), real, judges_of(options), draws_of(options)
    )
    rows = _rows(options.ladder)
    work = [(ladder, Training(n, seed, made)) for n, made in rows for seed in options.seeds]
    train_all(work, options.at_once)
    _print_table(ladder, options.ladder, options.seeds)


if __name__ == "__main__":
    main()
