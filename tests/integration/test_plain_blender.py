"""The example of thermal_core/PASSES.md, from plain Blender to a dataset, with the commands printed there."""

import json
import os
import re
import shlex
import subprocess
from pathlib import Path

import numpy as np
import pytest

from pictures import read_grey
from program import ROOT, Veldt

ONE_CLIP = "dataset: 1 clip made, 3 frames\n"


class Tutorial:
    """The code blocks of the page's example."""

    def __init__(self):
        text = (ROOT / "thermal_core" / "PASSES.md").read_text(encoding="utf-8")
        section = text[text.index("## Example: plain Blender") : text.index("\n## Clips and frames")]
        blocks = re.findall(r"^```(\w*)\n(.*?)^```$", section, re.MULTILINE | re.DOTALL)
        self.script = next(code for language, code in blocks if language == "python")
        self.objects = json.loads(f"[{next(code for language, code in blocks if language == 'json')}]")
        self.commands = [
            shlex.split(line) for language, code in blocks if not language for line in code.splitlines()
        ]

    def command(self, *beginning: str) -> list[str]:
        """The first command that begins so."""
        return next(line for line in self.commands if tuple(line[: len(beginning)]) == beginning)


def _render(folder: Path, blender: str, script: str) -> None:
    (folder / "scene.py").write_text(script, encoding="utf-8")
    command = Tutorial().command("blender")
    done = subprocess.run(
        [blender, *command[1:], "--python-exit-code", "1"],
        cwd=folder,
        env={**os.environ, "PWD": str(folder)},  # by which Blender finds files, as from a shell
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0 and (folder / "passes").exists(), done.stdout + done.stderr


def _changed(script: str, old: str, new: str) -> str:
    assert script.count(old) == 1
    return script.replace(old, new)


def _made(veldt, *command):
    done = veldt(*command[1:], "--progress", "none")
    assert done.err == "" and done.code == 0
    return done.out


def _write_over(veldt, changes: list[dict]) -> None:
    """Make the edits that the page asks the user to make."""
    manifest = veldt.read("passes/manifest.json")
    by_index = {change["index"]: change for change in changes}
    manifest["objects"] = [by_index.pop(entry["index"], entry) for entry in manifest["objects"]]
    assert not by_index
    veldt.write("passes/manifest.json", manifest)


@pytest.fixture(scope="module", name="rendered")
def _rendered(tmp_path_factory, blender) -> Veldt:
    veldt = Veldt(tmp_path_factory.mktemp("tutorial"))
    _render(veldt.folder, blender, Tutorial().script)
    return veldt


def test_from_a_plain_blender_to_a_dataset(rendered):
    tutorial = Tutorial()
    output = _made(rendered, *tutorial.command("veldt", "inspect"))
    assert "object index" in output
    assert output.split("\n\n")[1].splitlines()[0] == "passes/manifest.json: starter manifest"
    convert = tutorial.command("veldt", "convert")
    unedited = rendered(*convert[1:])
    assert unedited.code == 1
    assert re.findall(r'^veldt: passes/manifest.json: (.* = "FILL IN")', unedited.err, re.MULTILINE) == [
        'objects[1].material, objects[2].material = "FILL IN"',
        'objects[1].category, objects[2].category = "FILL IN"',
    ]
    _write_over(rendered, tutorial.objects)
    assert _made(rendered, *convert) == ONE_CLIP
    labels = rendered.read("dataset/annotations.json")
    names = {category["id"]: category["name"] for category in labels["categories"]}
    assert (
        sorted(names[label["category_id"]] for label in labels["annotations"])
        == ["elephant"] * 3 + ["human"] * 3
    )
    _check_pixels(rendered, labels)


def _check_pixels(rendered, labels) -> None:
    """Labels are the pixels of the index pass, and each of those things has the grey of its material."""
    index = {
        entry["index"]: entry["pixels"] for entry in rendered("inspect", "passes", "--json").json()["objects"]
    }
    first = [label for label in labels["annotations"] if label["image_id"] == 1]
    assert sorted(label["area"] for label in first) == sorted([index[2], index[3]])
    frame = read_grey(rendered.folder / "dataset" / "clips" / "passes" / "ir8" / "000000.png")
    assert frame.shape == (512, 640)
    x, y, width, height = (int(edge) for edge in max(first, key=lambda label: label["area"])["bbox"])
    inside = frame[y + height // 3 : y + 2 * height // 3, x + width // 3 : x + 2 * width // 3]
    assert np.median(inside) > np.median(frame[-100:]) + 20  # an elephant on a winter night's soil


def test_the_other_commands_of_the_tutorial(rendered):
    command = next(line for line in Tutorial().commands if "physical" in line)
    if not (rendered.folder / "passes" / "manifest.json").exists():
        _made(rendered, *Tutorial().command("veldt", "inspect"))
    _write_over(rendered, Tutorial().objects)
    done = rendered(*command[1:], "--progress", "none")
    assert (done.code, done.out.splitlines()[0]) == (0, "physical: 1 clip made, 3 frames")


def test_with_a_cryptomatte_for_an_index(veldt, blender):
    """Categories are guessed from names: here only the object called big is left to fill in."""
    script = _changed(Tutorial().script, "use_pass_object_index =", "use_pass_cryptomatte_object =")
    script = _changed(script, '"small"', '"Poacher.001"')
    _render(veldt.folder, blender, script)
    output = _made(veldt, *Tutorial().command("veldt", "inspect"))
    assert "cryptomatte ViewLayer.CryptoObject, of 3 frames" in output
    manifest = veldt.read("passes/manifest.json")
    assert manifest["cryptomatte"] == "ViewLayer.CryptoObject"
    objects = {entry["name"]: entry for entry in manifest["objects"]}
    assert {name: entry["class"] for name, entry in objects.items()} == {
        "field": "ground",
        "big": "actor",
        "Poacher.001": "actor",
    }
    assert objects["Poacher.001"]["material"] == "human"
    _write_over(veldt, [objects["big"] | {"material": "elephant", "category": "elephant"}])
    assert _made(veldt, *Tutorial().command("veldt", "convert")) == ONE_CLIP
    assert len(veldt.read("dataset/annotations.json")["annotations"]) == 6


def test_of_two_view_layers_one_is_chosen(veldt, blender):
    script = _changed(
        Tutorial().script,
        "if bpy.app.version",
        'other = scene.view_layers.new("Other")\nother.use_pass_object_index = True\nif bpy.app.version',
    )
    _render(veldt.folder, blender, script)
    inspect = Tutorial().command("veldt", "inspect")
    several = veldt(*inspect[1:])
    assert several.code == 1 and "several layers: Other, ViewLayer" in several.err
    assert not (veldt.folder / "passes" / "manifest.json").exists()
    _made(veldt, *inspect, "--layer", "Other")
    assert veldt.read("passes/manifest.json")["layer"] == "Other"
    _write_over(veldt, Tutorial().objects)
    assert _made(veldt, *Tutorial().command("veldt", "convert")) == ONE_CLIP
