"""The extension for Blender guesses from names what `inspect` guesses from those of a cryptomatte."""

import sys

import numpy as np

import mattes
from program import ROOT

sys.path.append(str(ROOT / "blender_scripts"))

from veldt_panel.catalogue import _OTHER_WORDS, guess, read_catalogue  # pylint: disable=wrong-import-position

WHOLE = (
    "Elephants.001",
    "bigRhino",
    "AcaciaTree",
    "house_metal_b",
    "wet_soil.003",
    "HUTRound",
    "Cube.002",
    "Lamp",
)


def _guesses_of_inspect(veldt, names: list[str]) -> dict[str, tuple]:
    """Class, material and category by name, from a starter manifest."""
    folder = veldt.folder / "passes"
    folder.mkdir()
    rank = (np.array([names]), np.ones((1, len(names)), np.float32))
    mattes.write_exr_with_texts(folder / "000000.exr", mattes.planes_of([rank]), mattes.texts_of(names))
    done = veldt("inspect", "passes", "--starter-manifest", "passes/manifest.json")
    assert done.code == 0, done.err
    return {
        name: (entry["class"], entry["material"], entry.get("category", ""))
        for entry in veldt.read("passes/manifest.json")["objects"]
        for name in entry.get("mattes", [entry["name"]])
    }


def test_guesses_are_those_of_inspect(veldt):
    things = read_catalogue(ROOT).things
    names = sorted({*things, *_OTHER_WORDS, *WHOLE})
    expected = _guesses_of_inspect(veldt, names)
    assert set(expected) == set(names)
    found = {name: guess(things, name) for name in names}
    unknown = ("actor", "FILL IN", "FILL IN")
    assert {
        name: unknown if thing is None else (thing.kind, thing.material, thing.category)
        for name, thing in found.items()
    } == expected
