"""The Blender extension, in a real Blender of 4.2 and later: from a .blend of somebody else's to a dataset."""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from configs import tiny
from pictures import read_grey
from processes import PATIENCE_S
from program import PROGRAM, ROOT, Veldt

EXTENSION = ROOT / "blender_scripts" / "veldt_panel"
SUPPORT = ROOT / "tests" / "support"
BLENDS = ROOT / "tests" / "data" / "blends"
HUMAN, CUBES = BLENDS / "HUMAN.blend", BLENDS / "CubeHierarchy_248.blend"
# A box ends at a pixel's border, whose centre is in the target: at most half a pixel outside of it. Inside, pixel
# centres of the next column lie within a pixel of the end; a corner of 53 degrees and more is a pixel wide a pixel
# further in, and contains one there.
OUTSIDE_PX, INSIDE_PX = 0.5, 2.0
PRESETS = ", ".join(sorted(file.stem for file in (ROOT / "assets" / "sensors").glob("*.json")))


@pytest.fixture(scope="module", name="recent")
def _recent(blender) -> str:
    """A Blender that knows extensions."""
    said = subprocess.run([blender, "--version"], capture_output=True, text=True, check=True).stdout
    version = tuple(map(int, re.search(r"Blender (\d+)\.(\d+)", said).groups()))
    if version < (4, 2):
        pytest.skip(f"extensions need Blender 4.2 or later, and this is {version[0]}.{version[1]}")
    return blender


class Session:
    """Blender with the extension, in a folder of its own."""

    def __init__(self, blender: str, folder: Path):
        self.blender, self.folder = blender, folder
        extensions = folder / "user" / "extensions" / "user_default"
        shutil.copytree(EXTENSION, extensions / "veldt_panel", ignore=shutil.ignore_patterns("__pycache__"))

    def run(self, script: str, *arguments) -> None:
        """Run a script of tests/support to its end."""
        command = [self.blender, "-b", "--factory-startup", "--python-exit-code", "1", "-t", "2"]
        done = subprocess.run(
            [*command, "--python", SUPPORT / script, "--", *map(str, arguments)],
            env={
                **{key: value for key, value in os.environ.items() if not key.startswith("VELDT_")},
                "BLENDER_USER_RESOURCES": str(self.folder / "user"),
                "PYTHONPATH": str(SUPPORT),
                "PYTHONDONTWRITEBYTECODE": "1",
            },
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
        )
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]

    def case(self, name: str, *arguments) -> dict:
        """What a case of panel_session.py returns."""
        self.run("panel_session.py", name, self.folder, PROGRAM, *arguments)
        return json.loads((self.folder / "result.json").read_text(encoding="utf-8"))

    def labels(self) -> list[dict]:
        """The boxes of the dataset as the truth has them."""
        found = json.loads((self.folder / "dataset" / "annotations.json").read_text(encoding="utf-8"))
        categories = {each["id"]: each["name"] for each in found["categories"]}
        frames = {each["id"]: each["frame_index"] for each in found["images"]}
        return [
            {
                "frame": frames[each["image_id"]] + 1,
                "category": categories[each["category_id"]],
                "track": each["track_id"],
                "box": _corners(each["bbox"]),
            }
            for each in found["annotations"]
        ]

    def check_valid(self) -> None:
        """The dataset is complete and unchanged."""
        done = Veldt(self.folder)("validate", "dataset")
        assert (done.code, done.err) == (0, "")


def _corners(bbox: list[float]) -> list[float]:
    x, y, width, height = bbox
    return [x, y, x + width, y + height]


@pytest.fixture(name="session")
def _session(recent, tmp_path) -> Session:
    return Session(recent, tmp_path)


def _check_boxes(labels: list[dict], truth: list[dict], size_px: tuple[int, int]) -> None:
    """Each true box has one label of its category in its frame, and each label is one of these.

    Those of a category are paired from left to right.
    """

    def ordered(boxes: list[dict], name: str) -> list[tuple]:
        return sorted((each["frame"], each[name].split()[0], each["box"]) for each in boxes)

    found, expected = ordered(labels, "category"), ordered(truth, "target")
    assert [each[:2] for each in found] == [each[:2] for each in expected]
    low, high = np.zeros(4), np.array([*size_px, *size_px], float)
    inwards = np.array([1, 1, -1, -1])
    for (frame, name, label), (_, _, true) in zip(found, expected):
        off_px = (np.array(label) - np.clip(true, low, high)) * inwards
        assert np.all(off_px >= -OUTSIDE_PX) and np.all(off_px <= INSIDE_PX), (frame, name, label, true)


def test_a_file_of_somebody_else(session):
    """Tobias Rittig's person, of 2010: assigned, rendered, converted and shown, and the file is as it was."""
    result = session.case("human", HUMAN)
    assert result["after"] == result["before"]
    session.check_valid()
    labels = session.labels()
    _check_boxes(labels, result["boxes"], (800, 600))
    assert {(each["category"], each["track"]) for each in labels} == {("human", 1)} and len(labels) == 2
    first = session.folder / "dataset" / "clips" / "clip" / "ir8" / "000000.png"
    assert result["image"] == ["SEQUENCE", str(first), [800, 600]]
    x0, y0, x1, y1 = map(int, labels[0]["box"])
    frame = read_grey(first)
    assert np.median(frame[(y0 + y1) // 2, x0:x1]) > np.median(frame[:, :20]) + 20  # warmer than the sky


def test_parts_with_a_common_parent_are_one_target(session):
    result = session.case("hierarchy", CUBES)
    assert result["assigned"] == ["Cube1"] and result["cubes"] == 10
    assert result["after"] == result["before"]
    session.check_valid()
    _check_boxes(session.labels(), result["boxes"], (800, 600))
    manifest = json.loads((session.folder / "passes" / "clip" / "manifest.json").read_text(encoding="utf-8"))
    assert [entry["name"] for entry in manifest["objects"]] == ["unassigned_soil", "Cube1"]


def test_rigs_instances_particles_and_settings_of_a_stranger(session):
    """Each instance of an actor is a target; depth of field, blur, borders and compositors do not reach the passes."""
    blend = session.folder / "strange.blend"
    session.run("stranger_scene.py", blend)
    result = session.case("stranger", blend)
    assert {name: kind for name, kind in result["kinds"].items() if kind != "unset"} == {
        **{"Elephant_rig": "actor", "zebra_model": "actor", "Tree": "plant"},
        **dict.fromkeys(("Plane.001", "Plane.002", "Plane.003"), "ground"),
    }
    assert result["after"] == result["before"]
    session.check_valid()
    labels = session.labels()
    _check_boxes(labels, result["boxes"], (640, 512))
    tracks = {}
    for each in labels:
        tracks.setdefault(each["track"], set()).add(each["category"])
    assert sorted(map(sorted, tracks.values())) == [["elephant"], *3 * [["impala"]], *2 * [["zebra"]]]
    first, second, _ = [each["box"] for each in labels if each["category"] == "elephant"]
    assert second[0] > first[0] + 10  # it walks to the right


def test_what_goes_wrong_is_said_and_nothing_is_lost(session):
    result = session.case("faults", HUMAN)
    errors = result["errors"]
    folder = session.folder
    convert = errors.pop("convert")
    assert errors == {
        "no passes": f"{folder}/passes/clip: no passes; expected those that Render Passes makes",
        "no frames": f"{folder}: no frames; expected a dataset, which Make Dataset makes",
        "no config": "config is missing; expected a file",
        "preset": f'camera preset = "boson"; expected one of {PRESETS}',
        "time": 'time of day = "3 am"; expected HH:MM, such as 03:00',
        "range": "frames = 3 to 2; expected the last at or after the first",
        "camera": "scene.camera is missing; expected a camera",
        "ortho": "camera Camera = ORTHO; expected PERSP",
        "in the way": f"{folder}/passes/clip: not a folder of passes; expected passes, or nothing",
        "category": 'category = ""; expected one for an actor',
        "material": 'material = "skin"; expected a file in assets/materials',
        "program": "program = OUT/no_program; expected a program that can be run: see Preferences",
    }
    assert convert.startswith("veldt convert ended with exit code ") and '"nothing"' in convert
    assert result["after"] == result["before"] == result["stopped"]
    assert result["part"] == ["000000.exr"]  # it was stopped in the middle
    assert result["left"] == ["clip"] and "000002.exr" in result["kept"]  # and the earlier passes are whole


def test_the_manifests_cameras_see_what_blenders_see(recent, tmp_path):
    cases = Session(recent, tmp_path).case("lenses", HUMAN)["cases"]
    assert len(cases) == 12
    for case in cases:
        camera, pose = case["camera"], np.reshape(case["camera_to_world"], (4, 4))
        points = np.c_[case["points"], np.ones(len(case["points"]))] @ np.linalg.inv(pose).T
        x = camera["cx_px"] + camera["fx_px"] * points[:, 0] / points[:, 2]
        y = camera["cy_px"] + camera["fy_px"] * points[:, 1] / points[:, 2]
        # Blender's matrices are of single precision: about 8 roundings of 6e-8 of 1000 px, times 10 m of distance.
        assert np.allclose(np.c_[x, y, points[:, 2]], case["seen_px"], rtol=0, atol=5e-3)


def test_the_panels_in_every_state(session):
    result = session.case("panels", CUBES)
    shown = result["shown"]
    assert "11 not assigned: soil" in shown["nothing assigned"] and "…" in shown["nothing assigned"]
    assert "No active object" in shown["nothing assigned"]
    assert (
        "Cube1: not assigned itself" in shown["actor"] and "Unit scale is not 1: no depth" in shown["actor"]
    )
    assert {"[category]", "[is_one]", "[frame_start]", "[frame_end]"} <= set(shown["actor"])
    assert not {"[category]", "[frame_start]"} & set(shown["nothing assigned"]) - {"[category]"}
    assert "Cube1: elephant" in shown["assigned"] and not any(
        "not assigned" in line for line in shown["assigned"]
    )
    assert "passes: frame 2 50%" in shown["running"] and "Esc stops it" in shown["running"]
    assert shown["failed"].count("one") == 1 and "two" in shown["failed"]
    assert {"veldt was not found yet", "[program]"} <= set(shown["no program"])
    assert shown["preferences"] == ["[program]", "(Find Program)", "Not found yet"]
    assert result["is_gone"]


def test_a_dataset_of_a_config(session):
    config = session.folder / "config.json"
    config.write_text(json.dumps(tiny()), encoding="utf-8")
    result = session.case("config", config)
    assert re.match(r".*/generated: \d+ clips? made", result["message"])
    assert Path(result["image"]).is_file() and "/generated/clips/" in result["image"]


def test_blenders_own_tool_accepts_the_extension(session):
    (session.folder / "zip").mkdir()
    source = session.folder / "user" / "extensions" / "user_default" / "veldt_panel"
    result = session.case("package", source)
    assert [code for code, _ in result["done"]] == [0, 0], result["done"]
    assert result["files"] == ["veldt_panel-0.1.0.zip"]
