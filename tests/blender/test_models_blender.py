"""Models written by Blender are read back unchanged, and unreadable ones are rejected before rendering."""

import json
import shutil
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import configs
import rendering
from pictures import read_planes
from processes import PATIENCE_S
from program import Veldt
from rendering import BLENDER
from scenes import tiny
from test_models import bush, glb, okapi
from planner.config import ROOT

pytestmark = pytest.mark.blender


# A long box of material `hide` (2 x 0.5 x 1, facing -y, its middle off the origin), under a parent that is moved and
# turned, mirrored by a modifier; on it a small one, scaled by -1, of material `horn`, at the end it faces.
MAKE = """
import bpy, sys, math
folder = sys.argv[-1]
for thing in list(bpy.data.objects): bpy.data.objects.remove(thing)
def box(name, size, at, material):
    bpy.ops.mesh.primitive_cube_add(size=1)
    thing = bpy.context.object
    thing.name, thing.scale, thing.location = name, size, at
    if material: thing.data.materials.append(bpy.data.materials.new(material))
    return thing
body = box("body", (0.25, 2, 1), (3.125, 5, 2.5), "hide")
mirror = body.modifiers.new("both sides", "MIRROR")
bpy.ops.object.empty_add(location=(3, 0, 0))
mirror.mirror_object = bpy.context.object
horn = box("horn", (-0.5, 0.2, 0.5), (3, 4.1, 3.25), "horn")
bpy.ops.wm.save_as_mainfile(filepath=folder + "/okapi.blend")
bpy.ops.export_scene.gltf(filepath=folder + "/okapi.glb", export_apply=True)
bpy.ops.wm.obj_export(filepath=folder + "/okapi.obj")
"""
SIZE_M = [2.0, 0.5, 1.5]  # length along y, width of both mirrored halves, height up to the horn's top
READ = """
import json, sys
sys.path.insert(0, sys.argv[-3])
import bpy
from planner import assets, faults
from veldt_bl.models import _everything, load
def folder(kind): return __import__("pathlib").Path(sys.argv[-2]) / kind
assets._folder = folder
known = _everything()
bpy.data.materials.new("hide")  # as if the scene had one of that name
before = _everything()
try:
    mesh = load("assets/species/okapi.json", assets.load("species", "okapi"))
    result = {"points": mesh.points_m.tolist(), "triangles": mesh.triangles.tolist(), "slot": mesh.slot.tolist()}
except faults.ConfigError as error:
    result = {"error": str(error)}
result["left"] = len(_everything() - before)
json.dump(result, open(sys.argv[-1], "w"))
"""


def _blender(folder: Path, script: str, *arguments: str) -> None:
    (folder / "script.py").write_text(script)
    command = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "-t", "1", "--python"]
    done = subprocess.run(
        [*command, str(folder / "script.py"), "--", *arguments],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture(scope="module", name="made")
def _made(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("made")
    _blender(folder, MAKE, str(folder))
    return folder


def _load(made: Path, folder: Path, suffix: str, **model) -> dict:
    """Blender's result for a model: one of the files made, or what `folder` has instead."""
    species = folder / "species"
    species.mkdir(exist_ok=True)
    file = f"okapi{suffix}"
    if not (species / file).exists():
        shutil.copy(made / file, species)
    if not (folder / "materials").exists():
        (folder / "materials").symlink_to(ROOT / "assets" / "materials")
    (species / "okapi.json").write_text(json.dumps(okapi(file=file, forward="-y", size_m=SIZE_M, **model)))
    _blender(folder, READ, str(ROOT / "blender_scripts"), str(folder), str(folder / "result.json"))
    return json.loads((folder / "result.json").read_text())


@pytest.mark.parametrize("suffix", [".blend", ".glb", ".obj"])
def test_a_model_comes_back_as_it_was(made, tmp_path, suffix):
    result = _load(made, tmp_path, suffix)
    assert "error" not in result, result
    points, triangles, slot = (np.array(result[key]) for key in ("points", "triangles", "slot"))
    # Six digits in .obj, floats in the others; the numbers are below 8 m.
    np.testing.assert_allclose(points.min(axis=0), [-1, -0.25, 0], atol=1e-5)
    np.testing.assert_allclose(points.max(axis=0), [1, 0.25, 1.5], atol=1e-5)
    horn = points[triangles[slot == 1]]
    np.testing.assert_allclose(horn.reshape(-1, 3).min(axis=0), [0.8, -0.25, 1.0], atol=1e-5)
    np.testing.assert_allclose(horn.reshape(-1, 3).max(axis=0), [1.0, 0.25, 1.5], atol=1e-5)
    hide = points[triangles[slot == 0]].reshape(-1, 3)
    np.testing.assert_allclose(hide.max(axis=0), [1.0, 0.25, 1.0], atol=1e-5)
    for corners in (points[triangles[slot == 1]], points[triangles[slot == 0]]):
        volume = np.linalg.det(corners - corners.reshape(-1, 3).mean(axis=0)).sum() / 6
        assert volume > 0, "faces look inward"
    assert result["left"] == 0


def test_a_glb_and_an_obj_are_measured_alike_without_blender(made):
    # pylint: disable=import-outside-toplevel
    from planner.model_files import survey

    for suffix in (".glb", ".obj"):
        found = survey(made / f"okapi{suffix}")
        np.testing.assert_allclose(np.ptp(found.box_m, axis=0), [0.5, 2.0, 1.5], atol=1e-5)
        assert sorted(found.materials) == ["hide", "horn"]


def _quantized_glb() -> bytes:
    """A box of SIZE_M whose positions are 16-bit integers, normalized, scaled by its node."""
    signs = np.array([[i, j, k, 0] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
    sides = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
    sides += [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    points, faces = (32767 * signs).astype("<i2").tobytes(), np.array(sides, "<u2").tobytes()
    position = {"bufferView": 0, "componentType": 5122, "normalized": True, "count": 8, "type": "VEC3"}
    length, width, height = SIZE_M
    more = {
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "accessors": [
            position | {"min": [-32767] * 3, "max": [32767] * 3},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 64, "byteStride": 8},
            {"buffer": 0, "byteOffset": 64, "byteLength": 72},
        ],
        "buffers": [{"byteLength": 136}],
        "extensionsUsed": ["KHR_mesh_quantization"],
        "extensionsRequired": ["KHR_mesh_quantization"],
    }
    text = glb([{"mesh": 0, "scale": [width / 2, height / 2, length / 2]}], **more)
    chunk = struct.pack("<I4s", 136, b"BIN\0") + points + faces
    return text[:8] + struct.pack("<I", len(text) + len(chunk)) + text[12:] + chunk


def test_a_quantized_glb_is_as_large_as_it_was(made, tmp_path):
    # pylint: disable=import-outside-toplevel
    from planner.model_files import survey

    file = tmp_path / "species" / "okapi.glb"
    file.parent.mkdir()
    file.write_bytes(_quantized_glb())
    np.testing.assert_allclose(np.ptp(survey(file).box_m, axis=0), [0.5, 2.0, 1.5], atol=1e-12)
    result = _load(made, tmp_path, ".glb")
    assert "error" not in result, result
    np.testing.assert_allclose(np.ptp(result["points"], axis=0), SIZE_M, atol=1e-5)


def test_faults_that_only_blender_can_find(made, tmp_path):
    file = 'assets/species/okapi.json: model.file = "okapi'
    assert _load(made, tmp_path, ".blend", parts={"hide": "", "horns": "head"})["error"] == (
        f'{file}.blend": "horn" has no part; expected it in model.parts, which has hide, horns; did you mean "horns"?'
    )
    assert _load(made, tmp_path, ".blend", scale=2.0)["error"] == (
        f'{file}.blend"; expected model.size_m = [4.000, 1.000, 3.000], which it is, not [2.000, 0.500, 1.500] m'
    )
    whole = (made / "okapi.blend").read_bytes()
    (tmp_path / "species" / "okapi.blend").write_bytes(whole[: len(whole) // 50])
    error = _load(made, tmp_path, ".blend")
    assert error["error"].startswith(f'{file}.blend"; expected '), error
    assert error["left"] == 0


def _home(folder: Path, made: Path) -> Path:
    """The program with a species and a plant that are models."""
    for name in ("assets", "blender_scripts"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "configs").symlink_to(ROOT / "configs")
    for kind, suffix, data in (
        ("species", ".glb", okapi(file="okapi.glb", forward="-y")),
        ("plants", ".obj", bush()),
    ):
        shutil.copy(made / f"okapi{suffix}", folder / "assets" / kind)
        (folder / "assets" / kind / "okapi.json").write_text(json.dumps(data))
    return folder


def _with_models(config: dict) -> None:
    config["scene"]["groups"][0]["species"] = "okapi"
    config["scene"]["plants"] = {"okapi": {"per_ha": 100}}


def _config() -> dict:
    return tiny(_with_models)


def _check_models_are_seen(plan: Path, passes: Path) -> None:
    scene = json.loads((plan / "scene.json").read_text())
    actors = {entry["index"]: entry for entry in scene["objects"] if entry.get("species") == "okapi"}
    plant = next(entry["index"] for entry in scene["objects"] if entry["name"] == "okapi")
    seen = {
        int(index)
        for frame in range(3)
        for clip in ("side", "down")
        for index in np.unique(read_planes(passes / clip / f"{frame:06d}.exr")["Scene.IndexOB.X"])
    }
    assert actors.keys() & seen and plant in seen
    box = np.array(next(iter(actors.values()))["bounds_m"])
    assert (np.ptp(box, axis=0) >= SIZE_M).all()
    assert {"index", "material", "part"} in [set(entry) for entry in scene["materials"]]


def test_a_model_is_rendered(made, tmp_path, monkeypatch):
    home = _home(tmp_path / "home", made)
    monkeypatch.setattr(rendering, "ROOT", home)
    run = rendering.render(tmp_path, _config())
    assert run.code == 0, run.log
    _check_models_are_seen(run.plan, run.out)


def test_the_ray_caster_draws_the_models_that_blender_reads(made, tmp_path):
    home = {"VELDT_HOME": str(_home(tmp_path / "home", made))}
    veldt = Veldt(tmp_path)
    veldt.write("config.json", configs.tiny(_with_models) | {"render": {}})
    arguments = ("render", "config.json", "--out", "out", "--progress", "none")
    done = veldt(*arguments, env=home | {"PATH": "/nonexistent"})
    assert done.code == 1 and "only Blender can read it, and it is missing" in done.err
    done = veldt(*arguments, "--blender", BLENDER, env=home)
    assert (done.code, done.err) == (0, "") and done.out.startswith("engine: embree ")
    _check_models_are_seen(veldt.folder / "out" / "plan", veldt.folder / "out" / "passes")


def test_a_broken_file_stops_everything_before_it_is_rendered(made, tmp_path):
    home = _home(tmp_path / "home", made)
    (home / "assets" / "species" / "okapi.glb").write_bytes(b"")
    (tmp_path / "config.json").write_text(json.dumps(_config()))
    script = home / "blender_scripts" / "plan_scene.py"
    done = subprocess.run(
        [sys.executable, str(script), "--config", str(tmp_path / "config.json")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        'assets/species/okapi.json: model.file = "okapi.glb"; expected a readable .glb file (it is empty)\n'
    )
