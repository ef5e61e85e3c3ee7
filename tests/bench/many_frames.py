"""Measure merging and validating a dataset of many frames.

    python3 tests/bench/many_frames.py [--clips 2000] [--frames 500] [--shards 4] [--labels 3.6] [--folder DIR]

Makes one clip with the built program (VELDT_PROGRAM, or the release build), and shards in which every clip has links to
its pictures, and labels, poses and records of its own. Prints time and peak memory of each command as rows of the table
in configs/SCALE.md. Needs a file system with hard links; a million frames need 8 GB of disk space and seven minutes.
"""

from __future__ import annotations

import argparse
import errno
import hashlib
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

# pylint: disable=wrong-import-position
from configs import tiny
from program import PROGRAM


@dataclass(frozen=True)
class Size:
    """Of the dataset."""

    clips: int
    frames: int  # of each clip
    shards: int
    labels: float  # of each frame

    def clip_name(self, place: int) -> str:
        """The id of a clip."""
        return f"clip_{place:06d}"


class Model:
    """A clip that the program has made, of which all others are copies with changes."""

    def __init__(self, folder: Path, frames: int):
        config = tiny()
        config["camera"] = {"width_px": 64, "height_px": 48, "pixel_pitch_um": 100}
        config["render"] = {"actor_layer": True, "engine": "embree"}
        config["clips"] = [config["clips"][0] | {"id": "model", "frames": frames}]
        (folder / "config.json").write_text(json.dumps(config), encoding="utf-8")
        run("generate", folder / "config.json", "--out", folder / "model")
        self.clip = folder / "model" / "clips" / "model"
        self.dataset = _read(folder / "model" / "dataset.json")
        self.record = _read(self.clip / "clip.json")
        self.labels = _read(self.clip / "labels.json")
        self.poses = (self.clip / "frames.jsonl").read_text(encoding="utf-8").splitlines()


def run(*command) -> tuple[float, float]:
    """Run the program to its end. Returns seconds, and the peak memory in MB."""
    started_s = time.monotonic()
    words = [str(PROGRAM), *map(str, command), "--quiet"]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL) as process:
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(words)} ended with {process.returncode}")
    return time.monotonic() - started_s, used.ru_maxrss * 1024 / 1e6


def make_shards(model: Model, size: Size, folder: Path) -> list[Path]:
    """Shards, each with every so many clips of the dataset."""
    shards = [folder / f"shard_{number}" for number in range(size.shards)]
    records = []
    for place in range(size.clips):
        clip = shards[place % size.shards] / "clips" / size.clip_name(place)
        records.append(_make_clip(model, size, clip))
    for number, shard in enumerate(shards):
        document = _dataset(model, size, records, number)
        (shard / "dataset.json").write_text(json.dumps(document, indent=2), encoding="utf-8")
    return shards


def _make_clip(model: Model, size: Size, clip: Path) -> dict:
    """Write a clip, and return its entry in dataset.json."""
    for name in ("ir8", "ir16"):
        (clip / name).mkdir(parents=True)
    files = dict(model.record["files"])
    for name in files:
        if name.endswith((".png", ".mp4")):
            _link(model.clip / name, clip / name)
    numbers = random.Random(clip.name)
    count = round(size.frames * size.labels)
    files["frames.jsonl"] = _write(clip / "frames.jsonl", _poses(model, numbers))
    files["labels.json"] = _write(clip / "labels.json", _labels(model, clip.name, count, numbers))
    record = model.record | {"clip": clip.name, "annotations": count, "files": files}
    sum_of_record = _write(clip / "clip.json", json.dumps(record, indent=2) + "\n")
    kept = {key: record[key] for key in ("season", "frames", "annotations", "pixels_sha256")}
    return {"id": clip.name, "status": "done", **kept, "record_sha256": sum_of_record}


def _link(file: Path, to: Path) -> None:
    """A link to a file, or from now on to a copy where it has as many links as it may have."""
    try:
        os.link(file, to)
    except OSError as error:
        if error.errno != errno.EMLINK:
            raise
        shutil.copy(file, to)
        os.replace(to, file)
        os.link(file, to)


def _write(file: Path, text: str) -> str:
    """Write a file, and return its SHA-256."""
    content = text.encode()
    file.write_bytes(content)
    return hashlib.sha256(content).hexdigest()


def _poses(model: Model, numbers: random.Random) -> str:
    """frames.jsonl, from another height."""
    height = f'"agl_m":{numbers.uniform(30, 120):.6f}'
    return "".join(re.sub(r'"agl_m":[\d.]+', height, line) + "\n" for line in model.poses)


def _labels(model: Model, clip: str, count: int, numbers: random.Random) -> str:
    """labels.json with so many labels, distributed over the frames."""
    video = model.labels["videos"][0] | {"name": clip}
    document = model.labels | {"videos": [video], "annotations": []}
    own = {"id": "@id", "image_id": "@image", "track_id": "@track", "bbox": "@box"}
    label = json.dumps(model.labels["annotations"][0] | own, indent=2)
    labels = []
    for k in range(count):
        text = label.replace('"@id"', str(k + 1)).replace('"@track"', str(k % 7 + 1))
        text = text.replace('"@image"', str(k * len(document["images"]) // count + 1))
        labels.append(text.replace('"@box"', f"[{numbers.randrange(60)}, {numbers.randrange(44)}, 4, 4]"))
    return json.dumps(document, indent=2).removesuffix("[]\n}") + "[" + ",\n".join(labels) + "]\n}\n"


def _dataset(model: Model, size: Size, records: list[dict], number: int) -> dict:
    """The dataset.json of a shard: it knows all clips, and has made its own."""
    own = [
        record if place % size.shards == number else {"id": record["id"], "status": "pending"}
        for place, record in enumerate(records)
    ]
    template = model.dataset["config"]["clips"][0]
    clips = [template | {"id": record["id"]} for record in records]
    mine = [record for record in own if record["status"] == "done"]
    totals = {key: sum(record[key] for record in mine) for key in ("frames", "annotations")}
    document = model.dataset | totals | {"status": "unfinished", "clips": own}
    document.pop("annotations_sha256")
    return document | {"config": model.dataset["config"] | {"clips": clips}}


def _read(file: Path) -> dict:
    return json.loads(file.read_text(encoding="utf-8"))


def measure(size: Size, folder: Path) -> str:
    """Make the shards, merge and validate them, and return the table."""
    shards = make_shards(Model(folder, size.frames), size, folder)
    whole = folder / "whole"
    rows = ["| | time | most memory |", "|---|---|---|"]
    for name, command in (("merge", ("merge", *shards, "--out", whole)), ("validate", ("validate", whole))):
        seconds, megabytes = run(*command)
        rows.append(f"| `veldt {name}` | {seconds:.0f} s | {megabytes:.0f} MB |")
    sizes = {name: (whole / name).stat().st_size / 1e6 for name in ("dataset.json", "annotations.json")}
    document = _read(whole / "dataset.json")
    assert (document["status"], document["frames"]) == ("complete", size.clips * size.frames)
    rows.append(f"{document['frames']} frames with {document['annotations']} labels")
    rows += [f"`{name}`: {megabytes:.1f} MB" for name, megabytes in sizes.items()]
    return "\n".join(rows)


def main() -> None:
    """Measure in a temporary folder."""
    parser = argparse.ArgumentParser(description="Measures merging and validating of many frames.")
    parser.add_argument("--clips", type=int, default=2000)
    parser.add_argument("--frames", type=int, default=500, help="of each clip")
    parser.add_argument("--shards", type=int, default=4)
    parser.add_argument("--labels", type=float, default=3.6, help="of each frame")
    parser.add_argument("--folder", type=Path, help="make the temporary folder here")
    options = parser.parse_args()
    size = Size(options.clips, options.frames, options.shards, options.labels)
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        print(measure(size, Path(folder)))


if __name__ == "__main__":
    main()
