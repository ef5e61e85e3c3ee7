#!/usr/bin/env python3
"""What is each part of Veldt worth to a detector of people? Trains on a config without one part at a time.

    tests/transfer/ablation.py CONFIG --real ANNOTATIONS.json FOLDER --out OUT

Each part has a folder in OUT with its config and all that ladder.py keeps, so a run continues where it was interrupted.
All datasets are made before the first training. Results: thermal_core/TRANSFER.md.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from pathlib import Path

from ladder import KEYS, Ladder, Training, draws_of, judges_of, made_frames, parser_of, train_all

_CLUTTER = ("stone", "stump", "chimney", "dung_pile", "hare", "francolin", "milestone")
_TIGHT = ("formation", "behaviours", "behaviour", "spacing_m")
_MIDNIGHT = "00:00"


def fixed(value):
    """A value of a config with every distribution in it replaced by its middle, or by its first choice."""
    if isinstance(value, list):
        return [fixed(each) for each in value]
    if not isinstance(value, dict):
        return value
    if "uniform" in value:
        low, high = value["uniform"]
        return _MIDNIGHT if isinstance(low, str) else (low + high) / 2
    if "normal" in value:
        return value["normal"][0]
    if "choice" in value:
        return fixed(value["choice"][0])
    of_keys = {key: fixed(each) for key, each in value.items()}
    return {key: each for key, each in of_keys.items() if each is not None}


def _without_heat(config: dict) -> None:
    config["scene"]["temperatures"] = "table_1"


def _without_ground(config: dict) -> None:
    config["terms"] = config.get("terms", {}) | {"variation": "off", "place": "off"}


def _without_clutter(config: dict) -> None:
    plants = config["scene"]["plants"]
    config["scene"]["plants"] = {name: plants[name] for name in plants if name not in _CLUTTER}


def _without_bodies(config: dict) -> None:
    for group in config["scene"]["groups"]:
        if group["species"] in ("villager", "human"):
            for key in _TIGHT:
                group.pop(key, None)
            group["species"] = "human"


def _without_camps(config: dict) -> None:
    config["scene"]["sites"] = []


def _without_variety(config: dict) -> None:
    for section in ("sensor", "weather", "output", "camera"):
        config[section] = fixed(config.get(section, {}))
    for clip in config["clips"]:
        clip["season"] = fixed(clip["season"])


def _without_blur(config: dict) -> None:
    config["sensor"]["optics"] = {"psf": "gaussian", "blur_sigma_px": 0}
    config["terms"] = config.get("terms", {}) | {"smear": "off"}


def _without_codec(config: dict) -> None:
    config["output"].pop("codec", None)


def _without_processing(config: dict) -> None:
    config["sensor"].pop("processing", None)


def _without_headroom(config: dict) -> None:
    for agc in config["sensor"]["agc"]["choice"]:
        agc.pop("black_level", None)
        agc.pop("white_level", None)


def _without_link(config: dict) -> None:
    config["output"].pop("link", None)


def _all_parts(_config: dict) -> None:
    pass


PARTS: dict[str, Callable[[dict], None]] = {
    "nothing": _all_parts,
    "heat_balance": _without_heat,
    "ground": _without_ground,
    "warm_clutter": _without_clutter,
    "bodies_and_groups": _without_bodies,
    "camps": _without_camps,
    "variety": _without_variety,
    "motion_and_psf": _without_blur,
    "processing": _without_processing,
    "headroom": _without_headroom,
    "link": _without_link,
    "codec": _without_codec,
    "box_style": _all_parts,
}
_STYLES = {"box_style": "visible"}


def _with_absolute_files(value, folder: Path):
    """The same, with each {"file": …} that lies in a folder given by its whole path."""
    if isinstance(value, list):
        return [_with_absolute_files(each, folder) for each in value]
    if not isinstance(value, dict):
        return value
    found = {key: _with_absolute_files(each, folder) for key, each in value.items()}
    if isinstance(found.get("file"), str):
        found["file"] = str((folder / found["file"]).resolve())
    return found


def _config_without(part: str, config: Path, out: Path) -> Path:
    """The config without a part, written to a folder of its own."""
    document = json.loads(config.read_text(encoding="utf-8"))
    PARTS[part](document)
    document.pop("$schema", None)
    file = out / part / "config.json"
    file.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps(_with_absolute_files(document, config.parent), indent=2)
    file.write_text(text + "\n", encoding="utf-8")
    return file


def _ladder_without(part: str, options: argparse.Namespace) -> Ladder:
    """The frames of the config without a part, and what they are judged by."""
    out = options.out / part
    config = _config_without(part, options.config, options.out)
    style = _STYLES.get(part, "drawn")
    made = made_frames(
        argparse.Namespace(**vars(options) | {"config": config, "out": out, "box_style": style})
    )
    return Ladder(out, options.steps, made, [], judges_of(options), draws_of(options))


def main() -> None:
    """Leave out one part after another."""
    names = list(PARTS)
    parser = parser_of(__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--without", nargs="+", choices=names, default=names, help="parts to leave out")
    options = parser.parse_args()
    training = Training(0, options.seed, True)
    ladders = {part: _ladder_without(part, options) for part in options.without}
    train_all([(ladder, training) for ladder in ladders.values()], options.at_once)
    print("| without | judged by | AP50 | AP30 | found at one false alarm a frame |\n|---|---|---|---|---|")
    for part, ladder in ladders.items():
        for judge in ladder.judges:
            scores = ladder.scores(training, judge)
            cells = " | ".join(f"{scores[key]:.3f}" for key in KEYS)
            print(f"| {part.replace('_', ' ')} | {judge.name} | {cells} |")


if __name__ == "__main__":
    main()
