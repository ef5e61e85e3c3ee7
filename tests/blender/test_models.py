"""Models from the user's files, as far as plain Python reads them, and messages about unsuitable files."""

import json
import struct
from types import SimpleNamespace

import numpy as np
import pytest

from planner import assets, models
from planner.anatomy.bodies import body_of
from planner.config import ROOT
from planner.faults import ConfigError, ProcessLost
from planner.model_files import survey
from planner.model_meshes import ModelMeshes
from planner.anatomy.pose import Motion, Walker, pose

CUBE_OBJ = """v 0 0 0
v 2 0 0
v 2 1 0
v 0 1 -4
usemtl hide
f 1 2 3
usemtl horn
f 1 3 4
"""
WHERE = 'assets/species/okapi.json: model.file = "okapi{}"'


def glb(nodes=None, version=2, cut=0, **more) -> bytes:
    """A .glb file of one triangle in a box of 1 x 2 x 3 (its y up), of material `hide`."""
    gltf = {
        "asset": {"version": "2.0"},
        "nodes": nodes or [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"name": "hide"}],
        "accessors": [
            {"componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 3]}
        ],
    } | more
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    whole = b"glTF" + struct.pack("<III4s", version, 20 + len(text), len(text), b"JSON") + text
    return whole[: len(whole) - cut]


@pytest.fixture(name="place")
def _place(tmp_path, monkeypatch):
    """An assets folder of its own with the program's materials, in which species and plants can be put."""
    for kind in ("species", "plants"):
        (tmp_path / kind).mkdir()
    (tmp_path / "materials").symlink_to(ROOT / "assets" / "materials")
    monkeypatch.setattr(assets, "_folder", lambda kind: tmp_path / kind)
    for cached in (assets.names, assets.load):
        cached.cache_clear()
    yield tmp_path
    for cached in (assets.names, assets.load):
        cached.cache_clear()


def okapi(**model) -> dict:
    """A species with a model."""
    return {
        "category": "okapi",
        "material": "zebra",
        "source": {"size": "estimate"},
        "speed_m_s": 1.0,
        "variants": {"adult": {"share": 1, "size_range": [1.0, 1.0]}},
        "model": {"file": "okapi.obj", "forward": "x", "parts": {"hide": "", "horn": "head"}} | model,
    }


def bush(**more) -> dict:
    """A plant with a model."""
    numbers = dict.fromkeys(("cover_m2", "foot_m", "spacing_m", "clearance_m", "patch_m"), 1)
    ranges = {"scale_range": [1, 1], "slope_deg": [10, 20]}
    model = {"file": "okapi.obj", "forward": "x", "parts": {"hide": "", "horn": ""}}
    return {"material": "shrub", "source": {"size": "estimate"}, "model": model} | numbers | ranges | more


def put(folder, kind, data, file="okapi.obj", content=CUBE_OBJ.encode()):
    """Write an asset file okapi.json and a model's file."""
    (folder / kind / "okapi.json").write_text(data if isinstance(data, str) else json.dumps(data))
    if content is not None:
        (folder / kind / file).write_bytes(content)


def fault(kind="species") -> str:
    """The message about the asset okapi."""
    with pytest.raises(ConfigError) as found:
        assets.load(kind, "okapi")
    return str(found.value)


@pytest.mark.parametrize(
    "forward, size", [("x", [2, 4, 1]), ("-x", [2, 4, 1]), ("y", [4, 2, 1]), ("-y", [4, 2, 1])]
)
def test_an_obj_is_as_long_as_it_reaches_forward(place, forward, size):
    # The file's y is up: 2 along x, 1 high, and 4 from z = -4 to 0, which is y = 0 to 4 with z up.
    put(place, "species", okapi(forward=forward, scale=0.5))
    model = assets.load("species", "okapi")["model"]
    assert model["size_m"] == [0.5 * side for side in size]
    assert model["path"] == str(place / "species" / "okapi.obj")


def test_an_obj_may_have_tabs_between_its_words(tmp_path):
    (tmp_path / "a.obj").write_text(CUBE_OBJ.replace(" ", "\t"))
    (tmp_path / "b.obj").write_text(CUBE_OBJ)
    tabs, blanks = survey(tmp_path / "a.obj"), survey(tmp_path / "b.obj")
    assert (tabs.materials, tabs.box_m.tolist()) == (blanks.materials, blanks.box_m.tolist())


def test_a_model_is_posed_as_one_piece(place):
    put(place, "species", okapi())
    body = body_of(assets.load("species", "okapi"), "adult")
    count = 5
    slope = SimpleNamespace(height_m=lambda x, y: 0.2 * x + 0.1 * y)
    along = lambda d: (np.outer(d, [1.0, 0.0]), np.tile([1.0, 0.0], (count, 1)))
    walked = np.linspace(0, 3, count)
    posed = pose(
        Walker(body, 1.5, 1.0, 0.0, along, slope), Motion(walked, walked, np.ones(count), np.zeros(count))
    )
    turns = posed.rotation[:, 0]
    np.testing.assert_allclose(
        turns @ np.swapaxes(turns, 1, 2), np.tile(np.eye(3), (count, 1, 1)), atol=1e-12
    )
    # On a plane it slides: its origin is on the ground, and it stays as it is turned.
    np.testing.assert_allclose(
        posed.position_m[:, 0] - posed.position_m[0, 0], np.outer(walked, [1, 0, 0.2]), atol=1e-12
    )
    np.testing.assert_allclose(turns, np.tile(turns[0], (count, 1, 1)), atol=1e-12)
    assert turns[0][2, 0] > 0.19  # it looks uphill


@pytest.mark.parametrize("forward, axis", [("x", [1, 0]), ("-x", [-1, 0]), ("y", [0, 1]), ("-y", [0, -1])])
def test_the_forward_axis_of_the_file_becomes_x(forward, axis):
    turned = models.in_body_axes(np.array([[*axis, 0.0], [0, 0, 1]]), {"forward": forward, "scale": 3.0})
    assert turned.tolist() == [[3, 0, 0], [0, 0, 3]]


def test_a_glb_is_measured_through_its_nodes(tmp_path):
    # A quarter turn about the file's y sends (x, z) to (z, -x); then twice as large, and 10 up, which is its y.
    half = np.sqrt(0.5)
    parent = {"children": [1], "translation": [0, 10, 0], "rotation": [0, half, 0, half], "scale": [2, 2, 2]}
    (tmp_path / "a.glb").write_bytes(glb([parent, {"mesh": 0}]))
    found = survey(tmp_path / "a.glb")
    assert found.materials == ("hide",)
    np.testing.assert_allclose(
        found.box_m, [[0, 0, 10], [6, 2, 14]], atol=1e-12
    )  # y of Blender is -z of the file


def test_a_model_larger_than_any_tree_is_refused(place):
    put(place, "species", okapi(scale=1000))
    assert fault() == (
        f"{WHERE.format('.obj')}, 2000 x 4000 x 1000 m large; expected at most 200 m each way, with model.scale in"
        " metres per unit of the file"
    )


def test_a_body_is_a_box_where_plans_need_one(place):
    put(place, "species", okapi())
    data = assets.load("species", "okapi")
    body = body_of(data, "adult")
    points = body.rest().points_m
    assert body.parts == ("", "head")
    assert np.array([points.min(axis=0), points.max(axis=0)]).tolist() == [[-1, -2, 0], [1, 2, 1]]
    assert body.leg_m == 0.5
    mesh = body.bones[0].mesh
    corners = mesh.points_m[mesh.triangles]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    middles = corners.mean(axis=1) - [0, 0, 0.5]
    assert ((outward * middles).sum(axis=1) > 0).all()
    assert (outward / 2).sum(axis=0).tolist() == [0, 0, 0] and len(mesh.triangles) == 12


def test_a_plant_with_a_model_needs_no_form(place):
    put(place, "plants", bush())
    assert assets.load("plants", "okapi")["variants"] == 1


def test_a_blend_needs_its_size(place):
    put(place, "species", okapi(file="okapi.blend"), "okapi.blend", b"BLENDER-v304")
    assert fault() == (
        "assets/species/okapi.json: model.size_m is missing; expected [length, width, height], since only Blender can"
        ' measure "okapi.blend"'
    )
    put(place, "species", okapi(file="okapi.blend", size_m=[2, 1, 1.5]))
    assert assets.load("species", "okapi")["model"]["size_m"] == [2, 1, 1.5]


FILES = {
    "empty": (".obj", b"", "it is empty"),
    "missing": (".obj", None, "No such file or directory"),
    "no faces": (".obj", b"v 0 0 0\n", "it has no faces"),
    "bad point": (".obj", b"v 0 a 0\nf 1 1 1\n", '"v 0 a 0" is not a point'),
    "not glb": (".glb", b"PK\x03\x04 some archive of another kind", "it does not begin as a .glb file does"),
    "old glb": (".glb", glb(version=1), "it is glTF 1, not 2"),
    "glb cut short": (".glb", glb(cut=8), f"it is cut short: {len(glb()) - 8} of {len(glb())} bytes"),
    "glb without JSON": (".glb", glb().replace(b"JSON", b"BIN\0"), "its first chunk is not JSON"),
    "glb without mesh": (".glb", glb(nodes=[{"name": "x"}]), "it has no mesh"),
    "flat": (".obj", b"v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", "it is 1 x 1 x 0 units large"),
    "endless": (".obj", b"v inf 0 0\nv 1 1 0\nv 0 0 1\nf 1 2 3\n", '"v inf 0 0" is not a point'),
    "glb in circles": (
        ".glb",
        glb(nodes=[{"children": [1]}, {"children": [2]}, {"children": [1], "mesh": 0}]),
        "its description of meshes is inconsistent",
    ),
    "torn glb": (".glb", glb(accessors=[]), "its description of meshes is inconsistent"),
    "glb of normalized floats": (
        ".glb",
        glb(accessors=[{"componentType": 5126, "normalized": True, "min": [0, 0, 0], "max": [1, 1, 1]}]),
        "its description of meshes is inconsistent",
    ),
    "glb compressed otherwise": (
        ".glb",
        glb(extensionsRequired=["EXT_meshopt_compression"]),
        "it requires EXT_meshopt_compression, and of shapes only KHR_mesh_quantization and KHR_draco_mesh_compression"
        " are supported",
    ),
    "glb with instances": (
        ".glb",
        glb(nodes=[{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}}]),
        "it has instances of EXT_mesh_gpu_instancing, which are not supported",
    ),
    "not blend": (".blend", b"PK\x03\x04", "it does not begin as a .blend file does"),
}


@pytest.mark.parametrize("name", FILES)
def test_an_unreadable_file(place, name):
    suffix, content, reason = FILES[name]
    put(place, "species", okapi(file=f"okapi{suffix}"), f"okapi{suffix}", content)
    assert fault() == f"{WHERE.format(suffix)}; expected a readable {suffix} file ({reason})"


def test_a_folder_is_not_a_model(place):
    put(place, "species", okapi(), content=None)
    (place / "species" / "okapi.obj").mkdir()
    assert fault() == f"{WHERE.format('.obj')}; expected a readable .obj file (Is a directory)"


ENTRIES = {
    "suffix": (
        {"file": "okapi.fbx"},
        'model.file = "okapi.fbx"; expected a file ending in .glb, .obj, .blend',
    ),
    "unknown part": (
        {"parts": {"hide": "", "horn": "heed"}},
        'model.parts["horn"] = "heed"; expected a part of its material: head, legs, mane, tail, or "" for the'
        ' material\'s own temperature; did you mean "head"?',
    ),
    "unmapped": (
        {"parts": {"hide": "", "horns": "head"}},
        'model.file = "okapi.obj": "horn" has no part; expected it in model.parts, which has hide, horns;'
        ' did you mean "horns"?',
    ),
}


@pytest.mark.parametrize("name", ENTRIES)
def test_an_invalid_entry(place, name):
    change, message = ENTRIES[name]
    put(place, "species", okapi(**change))
    assert fault() == f"assets/species/okapi.json: {message}"


def _without(data: dict, *keys: str) -> dict:
    return {key: value for key, value in data.items() if key not in keys}


ASSETS = {
    "neither bones nor model": ("species", _without(okapi(), "model"), "gait is missing; expected a value"),
    "model with bones": (
        "species",
        okapi() | {"bones": {}},
        "bones is given; expected none, since a model from a file is rigid",
    ),
    "material": (
        "species",
        okapi() | {"material": "zebrra"},
        'material = "zebrra"; expected a material: {materials}; did you mean "zebra"?',
    ),
    "plant without form": ("plants", _without(bush(), "model"), "form is missing; expected a value"),
    "form's own key": (
        "plants",
        _without(bush(), "model") | {"form": "rock", "variants": 1, "height_m": 1, "crown_diameter_m": 1},
        "limbs is missing; expected a value",
    ),
    "empty file": ("species", " \n", "the file is empty; expected JSON"),
    "no JSON": (
        "species",
        '{\n "a": 1,,\n}',
        "expected JSON (Expecting property name enclosed in double quotes: line 2 column 9 (char 10))",
    ),
    "a list": ("plants", "[]", "expected a JSON object"),
}


@pytest.mark.parametrize("name", ASSETS)
def test_an_invalid_asset_file(place, name):
    kind, data, message = ASSETS[name]
    put(place, kind, data)
    assert fault(kind) == f"assets/{kind}/okapi.json: " + message.replace(
        "{materials}", ", ".join(assets.names("materials"))
    )


def test_an_asset_file_that_is_missing(place):
    assert (
        place and fault() == "assets/species/okapi.json: expected a readable file (No such file or directory)"
    )


@pytest.mark.parametrize("kind", ["species", "plants", "materials"])
def test_all_assets_of_the_program_are_valid(kind):
    for name in assets.names(kind):
        assets.load(kind, name)


@pytest.mark.parametrize(
    "end, fault, message",
    [
        ("kill -9 $$", ProcessLost, r"okapi\.json: Blender was killed by signal 9 \(Killed\)"),
        ("echo no memory >&2; exit 1", RuntimeError, "Blender failed to read the model: no memory"),
    ],
)
def test_a_blender_that_reads_no_model_to_its_end(tmp_path, end, fault, message):
    (tmp_path / "a.obj").write_text(CUBE_OBJ)
    blender = tmp_path / "blender"
    blender.write_text(f"#!/bin/sh\n{end}\n")
    blender.chmod(0o755)
    meshes = ModelMeshes(tmp_path / "meshes", None, str(blender))
    with pytest.raises(fault, match=message):
        meshes.mesh("okapi.json", {"model": {"file": "a.obj", "path": str(tmp_path / "a.obj")}})
