"""Datasets for reports, and the content of a report's page, read with Python's HTML parser."""

from __future__ import annotations

import json
from html.parser import HTMLParser
from pathlib import Path

import numpy as np

import configs
import passes
from program import Veldt
from resolved import resolve
from planner.land.road_plan import plan_road
from planner.land.terrain import Terrain, build_terrain

CLIPS = configs.CLIPS
_VOID = {"meta", "link", "img", "br", "input"}


class Page(HTMLParser):
    """Elements of a page in order, each [tag, attributes, text]."""

    def __init__(self, file: Path):
        super().__init__()
        self.elements: list[list] = []
        self._open: list[list] = []
        self.feed(file.read_text(encoding="utf-8"))
        self.close()

    def handle_starttag(self, tag, attrs):
        self.elements.append([tag, dict(attrs), ""])
        if tag not in _VOID:
            self._open.append(self.elements[-1])

    def handle_endtag(self, tag):
        while self._open.pop()[0] != tag:
            pass

    def handle_data(self, data):
        if self._open:
            self._open[-1][2] += data

    def all(self, tag: str) -> list[tuple[dict, str]]:
        """Attributes and text of all elements of a kind."""
        return [(attributes, text) for name, attributes, text in self.elements if name == tag]

    @property
    def figures(self) -> dict:
        """What the page's charts are drawn from."""
        (text,) = (text for attributes, text in self.all("script") if attributes.get("id") == "figures")
        return json.loads(text)


def terrain_of(config: dict) -> Terrain:
    """The place of a config."""
    settings, seed = config["scene"]["terrain"], config["seed"]
    terrain = build_terrain(settings, seed)
    return terrain.with_road(plan_road(settings["road"], terrain, seed))


def flown_config(change=None) -> dict:
    """The tiny place, seen by the camera of the made-up passes."""
    config = configs.tiny(change)
    config["camera"] = {
        "width_px": passes.WIDTH,
        "height_px": passes.HEIGHT,
        "focal_length_m": 0.003,  # 30 pixels
        "pixel_pitch_um": 100,
    }
    for clip in config["clips"]:
        clip["frames"] = passes.FRAMES
    return config


def write_flights(veldt: Veldt, config: dict) -> list[Path]:
    """Passes of the config's clips: `down` flies north looking down, 40 m above the ground; `side` east."""
    terrain = terrain_of(resolve(config))
    folders = []
    for clip, step in zip(CLIPS, ((0.0, 5.0), (5.0, 0.0))):
        folder = passes.write_clip(veldt.folder / clip, clip)
        manifest = passes.manifest(clip)
        for k, frame in enumerate(manifest["frames"]):
            x_m, y_m = 20.0 + k * step[0], -10.0 + k * step[1]
            z_m = float(terrain.surface_m(np.array([x_m]), np.array([y_m]))[0]) + 40.0
            frame["camera_to_world"] = [1, 0, 0, x_m, 0, -1, 0, y_m, 0, 0, -1, z_m, 0, 0, 0, 1]
            frame["agl_m"] = 40.0
        passes.write_manifest(folder, manifest)
        folders.append(folder)
    return folders


def make_dataset(veldt: Veldt, config: dict | None = None, out: str = "out") -> Path:
    """A dataset of two clips: of the made-up passes alone, or flown over a config's place."""
    if config is None:
        folders = [passes.write_clip(veldt.folder / clip, clip) for clip in CLIPS]
        options = []
    else:
        folders = write_flights(veldt, config)
        options = ["--config", veldt.write("config.json", config)]
    done = veldt("convert", *folders, "--out", out, "--quiet", *options)
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt.folder / out


def change(file: Path, how) -> None:
    """Rewrite a JSON file after applying `how`."""
    document = json.loads(file.read_text(encoding="utf-8"))
    how(document)
    file.write_text(json.dumps(document), encoding="utf-8")
