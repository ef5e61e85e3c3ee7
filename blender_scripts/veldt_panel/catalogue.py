# SPDX-License-Identifier: GPL-3.0-or-later
"""Contents of the program's assets: kinds of objects with their category and material, materials, camera presets. No
bpy.
"""

from __future__ import annotations

import functools
import json
import re
from dataclasses import dataclass
from pathlib import Path

# As `veldt inspect` guesses; tests/cli/test_panel_names.py compares the two.
_GROUNDS = ("soil", "wet_soil", "grass", "road")
_OTHER_WORDS = {
    **dict.fromkeys(("person", "people", "man", "woman", "poacher", "ranger", "pedestrian"), "human"),
    **dict.fromkeys(("ground", "terrain", "floor", "plane", "dirt", "sand"), "soil"),
    **dict.fromkeys(("car", "jeep"), "pickup"),
    **dict.fromkeys(("lake", "river"), "water"),
    **{"hippo": "hippopotamus", "rhino": "rhinoceros", "truck": "lorry", "mud": "wet_soil"},
    **{"tree": "acacia", "bush": "shrub", "stone": "rock"},
}


@dataclass(frozen=True)
class Thing:
    """A kind of object. `kind` is a class of the manifest; category and species are empty except for actors."""

    kind: str
    material: str
    category: str = ""
    species: str = ""


@dataclass(frozen=True)
class Preset:
    """Picture of a camera preset; the focal length is over the size of a pixel."""

    width_px: int
    height_px: int
    focal_px: float


@dataclass(frozen=True)
class Catalogue:
    """All assets that the panel offers, by name."""

    things: dict[str, Thing]
    materials: tuple[str, ...]
    presets: dict[str, Preset]


@functools.lru_cache(maxsize=4)
def read_catalogue(home: Path) -> Catalogue:
    """The assets of a program, in `home`/assets. OSError or ValueError if they cannot be read."""
    assets = home / "assets"
    materials = tuple(sorted(file.stem for file in (assets / "materials").glob("*.json")))
    presets = {name: _preset(content["camera"]) for name, content in _documents(assets / "sensors")}
    return Catalogue(_things(assets), materials, presets)


def guess(things: dict[str, Thing], name: str) -> Thing | None:
    """A likely kind for an object's name: by its first known word, pairs of words before single ones."""
    words = words_of(name)
    for first, second in zip(words, words[1:]):
        if found := _find(things, f"{first}_{second}"):
            return found
    return next(filter(None, (_find(things, word) for word in words)), None)


def words_of(name: str) -> list[str]:
    """The words of a name, in lower case: "Elephant_bull.001" and "elephantBull" have elephant and bull."""
    return [word.lower() for word in re.findall(r"[A-Z]+[a-z]*|[a-z]+", name)]


def _find(things: dict[str, Thing], word: str) -> Thing | None:
    for form in (word, word[:-1] if word.endswith("s") else word):
        if found := things.get(_OTHER_WORDS.get(form, "")) or things.get(form):
            return found
    return None


def _things(assets: Path) -> dict[str, Thing]:
    things = {
        name: Thing("actor", content["material"], content["category"], name)
        for name, content in _documents(assets / "species")
    }
    for kind in ("structures", "plants"):
        for name, content in _documents(assets / kind):
            things[name] = Thing("plant", _main_material(content))
    things |= {ground: Thing("ground", ground) for ground in _GROUNDS}
    return things | {"water": Thing("water", "water")}


def _main_material(content: dict) -> str:
    """Main material of a plant or structure: its own, or the first of those seen from above."""
    if "material" in content:
        return content["material"]
    slot = next(iter(content["materials"].values()))
    return slot[0] if isinstance(slot, list) else slot


def _preset(camera: dict) -> Preset:
    focal_px = camera["focal_length_m"] / (camera["pixel_pitch_um"] * 1e-6)
    return Preset(camera["width_px"], camera["height_px"], focal_px)


def _documents(folder: Path) -> list[tuple[str, dict]]:
    files = sorted(folder.glob("*.json"))
    return [(file.stem, json.loads(file.read_text(encoding="utf-8"))) for file in files]
