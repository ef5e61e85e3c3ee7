"""`inspect --starter-manifest` writes a manifest to fill in, and `convert` names the values still missing."""

import json

import jsonschema
import numpy as np
import pytest

import mattes
from foreign_passes import ELEPHANT, GROUND, write_colours, write_cryptomatte, write_png
from pictures import write_exr
from program import ROOT

FOCAL_PX = 4.167  # of 3 px: 50 mm before 36 mm
CAMERA = {"width_px": 3, "height_px": 2, "fx_px": FOCAL_PX, "fy_px": FOCAL_PX, "cx_px": 1.5, "cy_px": 1.0}
INDEX = np.array([[0, 1, 1], [1, 1, 7]])
NAMES = sorted(file.stem for file in (ROOT / "assets" / "materials").glob("*.json"))
MATERIALS = ", ".join(NAMES[:40]) + f", … ({len(NAMES)} in all)"  # as messages list many names
GUESSED = [
    "guessed; check these",
    "  camera.fx_px = camera.fy_px = 4.167 (50 mm before 36 mm, Blender's usual lens)",
    "  frame_rate_hz = 24 (Blender's default)",
]


@pytest.fixture(name="folder")
def _folder(veldt):
    """An empty folder."""
    (veldt.folder / "r").mkdir()
    return veldt.folder / "r"


def _write_indices(folder, count=2):
    for k in range(count):
        write_exr(folder / f"f_{k + 1:04}.exr", {"ViewLayer.IndexOB.X": INDEX + 8 * k * (INDEX == 7)})


def _begin(veldt, *arguments):
    """Write a starter manifest; return it and the lines printed about it."""
    done = veldt("inspect", "r", "--starter-manifest", "r/manifest.json", "--progress", "none", *arguments)
    assert (done.code, done.err) == (0, "")
    document = veldt.read("r/manifest.json")
    jsonschema.validate(document, veldt.read(ROOT / "configs" / "schema" / "manifest.schema.json"))
    return document, done.out.split("\n\n")[1].splitlines()


def test_of_an_index_plane(veldt, folder):
    """The manifest lists the indices of all frames: 7 is only in the first, 15 only in the second."""
    _write_indices(folder)
    document, lines = _begin(veldt)
    assert document == {
        "format": "veldt-passes",
        "version": 1,
        "clip": "r",
        "camera": CAMERA,
        "frame_rate_hz": 24.0,
        "sequence": "f_####.exr",
        "objects": [
            {"index": 1, "name": "object_1", "class": "ground", "material": "soil"},
            *(
                {
                    "index": index,
                    "name": f"object_{index}",
                    "class": "actor",
                    "material": "FILL IN",
                    "category": "FILL IN",
                    "track_id": track,
                }
                for index, track in ((7, 1), (15, 2))
            ),
        ],
        "materials": [],
    }
    assert lines == [
        "r/manifest.json: starter manifest",
        *GUESSED,
        "  objects[0]: object_1 is ground, soil (it covers most)",
        "to fill in",
        "  objects[1]: material and category of object_7 (1 px)",
        "  objects[2]: material and category of object_15 (1 px)",
        "then",
        "  veldt convert r --out dataset",
    ]


def test_what_is_left_to_fill_in_is_named(veldt, folder):
    _write_indices(folder)
    _begin(veldt)
    done = veldt("convert", "r", "--out", "out")
    assert done.err == (
        f'veldt: r/manifest.json: objects[1].material, objects[2].material = "FILL IN"; expected one of {MATERIALS}\n'
        'veldt: r/manifest.json: objects[1].category, objects[2].category = "FILL IN"; expected a category such as'
        " human or elephant, or a class other than actor\n"
    )
    assert (done.code, done.out) == (1, "")


def test_filled_in_it_converts(veldt, folder):
    _write_indices(folder)
    document, _ = _begin(veldt)
    for entry in document["objects"][1:]:
        entry |= {"material": "elephant", "category": "elephant"}
    veldt.write("r/manifest.json", document)
    done = veldt("convert", "r", "--out", "out", "--progress", "none")
    assert (done.code, done.out, done.err) == (0, "out: 1 clip made, 2 frames\n", "")


def test_values_known_from_names_are_filled_in(veldt, folder):
    """With recognised names the first conversion needs no editing."""
    write_cryptomatte(folder / "f.exr", {"thin wire": "Acacia.002"})
    document, lines = _begin(veldt)
    assert document["cryptomatte"] == "ViewLayer.CryptoObject"
    assert document["sequence"] == "f.exr"
    assert document["objects"] == [
        {"index": 1, "name": "soil", "class": "ground", "material": "soil", "mattes": ["Ground"]},
        {
            "index": 2,
            "name": "Elephant.001",
            "class": "actor",
            "material": "elephant",
            "category": "elephant",
            "species": "elephant",
            "track_id": 1,
        },
        {"index": 3, "name": "acacia", "class": "plant", "material": "acacia", "mattes": ["Acacia.002"]},
    ]
    assert lines == [
        "r/manifest.json: starter manifest",
        *GUESSED,
        "  objects[0]: soil is ground, soil (by the name Ground)",
        "  objects[1]: Elephant.001 is actor, elephant (by the name Elephant.001)",
        "  objects[2]: acacia is plant, acacia (by the name Acacia.002)",
        "then",
        "  veldt convert r --out dataset",
    ]
    done = veldt("convert", "r", "--out", "out", "--progress", "none")
    assert (done.code, done.out, done.err) == (0, "out: 1 clip made, 1 frame\n", "")


def test_of_colours(veldt, folder):
    write_colours(folder / "a.png")
    document, _ = _begin(veldt)
    objects = [
        (entry["index"], entry["name"], entry["class"], entry["colour"]) for entry in document["objects"]
    ]
    assert objects == [
        (1, "colour_00ff00", "ground", list(GROUND)),
        (2, "colour_ff0000", "actor", list(ELEPHANT)),
    ]
    document["objects"][1] |= {"material": "elephant", "category": "elephant"}
    veldt.write("r/manifest.json", document)
    assert veldt("convert", "r", "--out", "out", "--quiet").code == 0


def test_of_greys(veldt, folder):
    write_png(folder / "1.png", INDEX.astype(np.uint8))
    document, _ = _begin(veldt)
    assert [entry["index"] for entry in document["objects"]] == [1, 7]
    assert document["sequence"] == "#.png"


def test_materials_are_to_fill_in(veldt, folder):
    write_exr(folder / "1.exr", {"S.IndexOB.X": INDEX, "S.IndexMA.X": INDEX // 2})
    document, lines = _begin(veldt)
    assert document["materials"] == [{"index": 3, "material": "FILL IN"}]
    assert "  materials[0]: material of material index 3 (1 px)" in lines


def test_the_only_channel_of_whole_numbers_is_taken(veldt, folder):
    write_exr(folder / "1.exr", {"id.V": INDEX, "half.V": INDEX / 2})
    document, lines = _begin(veldt)
    assert document["channels"] == {"object_index": "id.V"}
    assert [entry["index"] for entry in document["objects"]] == [1, 7]
    assert '  channels.object_index = "id.V" (it holds whole numbers)' in lines


def test_a_layer_is_named(veldt, folder):
    write_exr(folder / "1.exr", {"Near.IndexOB.X": INDEX, "Far.IndexOB.X": INDEX * 2})
    document, _ = _begin(veldt, "--layer", "Far")
    assert document["layer"] == "Far"
    assert [entry["index"] for entry in document["objects"]] == [2, 14]


def test_frames_that_no_pattern_can_say_are_listed(veldt, folder):
    for name in ("b.exr", "a.exr"):
        write_exr(folder / name, {"IndexOB.X": INDEX})
    document, _ = _begin(veldt)
    assert "sequence" not in document
    assert document["frames"] == [{"file": "a.exr", "time_s": 0.0}, {"file": "b.exr", "time_s": 1 / 24}]


def test_elsewhere_and_for_a_folder_of_any_name(veldt):
    (veldt.folder / "shot 1").mkdir()
    _write_indices(veldt.folder / "shot 1")
    done = veldt("inspect", "shot 1/f_#.exr", "shot 1/f_0001.exr", "--starter-manifest", "m.json", "--quiet")
    assert done.code == 2  # f_#.exr is of numbers without zeros before them
    done = veldt("inspect", "shot 1/f_####.exr", "--starter-manifest", "m.json", "--quiet")
    assert (done.code, done.err) == (0, "")
    assert done.out.splitlines()[-1] == '  veldt convert "shot 1" --manifest m.json --out dataset'
    assert veldt.read("m.json")["clip"] == "shot_1"


def test_a_manifest_beside_is_not_asked(veldt, folder):
    _write_indices(folder)
    veldt.write("r/manifest.json", "{")
    assert veldt("inspect", "r", "--starter-manifest", "m.json", "--quiet").code == 0


def test_json_is_json_and_writes_it_too(veldt, folder):
    _write_indices(folder)
    done = veldt("inspect", "r", "--starter-manifest", "m.json", "--json", "--quiet")
    assert done.json()["frames_read"] == 2
    assert veldt.read("m.json")["clip"] == "r"


def _write_mattes(folder, sidecar):
    """Two objects, whose names a file beside the passes may have."""
    names = np.array([["", "field", "field"], ["field", "field", "cow"]], dtype=object)
    texts = mattes.texts_of(None) | {
        next(iter(mattes.texts_of(None))).rsplit("/", 1)[0] + "/manif_file": sidecar
    }
    planes = mattes.planes_of([(names, (names != "").astype(np.float32))], "ViewLayer.CryptoObject")
    mattes.write_exr_with_texts(folder / "1.exr", planes, texts)


def test_names_of_mattes_may_be_in_a_file_beside(veldt, folder):
    _write_mattes(folder, "names.json")
    hashes = {name: f"{mattes.murmur_hash(name):08x}" for name in ("field", "cow")}
    (folder / "names.json").write_text(json.dumps(hashes), encoding="utf-8")
    document, _ = _begin(veldt)
    assert [entry["name"] for entry in document["objects"]] == ["field", "cow"]
    (folder / "manifest.json").unlink()
    (folder / "names.json").write_text(json.dumps({"field": hashes["field"]}), encoding="utf-8")
    document, lines = _begin(veldt)
    assert [entry["name"] for entry in document["objects"]] == ["field"]
    assert any(hashes["cow"] in line for line in lines[lines.index("to fill in") :])


def test_mattes_without_names_are_said_to_be_objects(veldt, folder):
    _write_mattes(folder, "names.json")
    done = veldt("inspect", "r", "--starter-manifest", "m.json", "--quiet")
    why = 'cryptomatte ViewLayer.CryptoObject: manif_file = "names.json": cannot read r/names.json: no such file'
    rule = "expected their names in it, or in objects of a manifest.json of your own"
    assert (done.code, done.err) == (1, f"veldt: r/1.exr: 2 objects without names; {why}; {rule}\n")
    assert not (veldt.folder / "m.json").exists()


def test_an_index_that_was_written_as_a_picture_is_taken(veldt, folder):
    write_exr(folder / "1.exr", {name: INDEX for name in "RGB"})
    document, lines = _begin(veldt)
    assert document["channels"] == {"object_index": "R"}
    assert '  channels.object_index = "R" (it holds whole numbers)' in lines


def test_more_than_twenty_copies_are_one_object(veldt, folder):
    copies = {f"Leaf.{k:03}": 0x3E000000 + k for k in range(1, 22)}
    write_cryptomatte(folder / "1.exr", {"thin wire": "Leaf"}, more=copies)
    document, _ = _begin(veldt)
    assert [(entry["name"], entry.get("mattes")) for entry in document["objects"]] == [
        ("Leaf", ["Leaf", "Leaf.*"]),
        ("soil", ["Ground"]),
        ("Elephant.001", None),
    ]


FAULTS = {
    "a file that is there": (
        {"IndexOB.X": INDEX},
        "there.json",
        2,
        "--starter-manifest = there.json; expected a file that does not exist yet",
    ),
    "nothing but sky": (
        {"IndexOB.X": INDEX * 0},
        "m.json",
        1,
        "r/1.exr: no objects, only sky (index 0); expected an index of 1 and more for each object",
    ),
    "no objects": (
        {"R": INDEX},
        "m.json",
        1,
        "r/1.exr: no object index channel; expected one such as Scene.IndexOB.X; the file has: R",
    ),
    "several layers": (
        {"A.IndexOB.X": INDEX, "B.IndexOB.X": INDEX},
        "m.json",
        1,
        'r/1.exr: IndexOB is in several layers: A, B; expected the manifest\'s "layer" to name one, or --layer',
    ),
    "a folder that is not there": (
        {"IndexOB.X": INDEX},
        "none/m.json",
        2,
        "--starter-manifest = none/m.json; expected a file in an existing folder",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_fault(veldt, folder, name):
    planes, file, code, message = FAULTS[name]
    write_exr(folder / "1.exr", planes)
    veldt.write("there.json", "mine")
    done = veldt("inspect", "r", "--starter-manifest", file, "--quiet")
    assert (done.code, done.err) == (code, f"veldt: {message}\n")
    assert not (veldt.folder / "m.json").exists()
    assert (veldt.folder / "there.json").read_text(encoding="utf-8") == "mine"


def test_a_manifest_cannot_be_read_and_begun(veldt, folder):
    _write_indices(folder)
    done = veldt("inspect", "r", "--manifest", "a.json", "--starter-manifest", "b.json")
    assert (done.code, done.err) == (
        2,
        "veldt: --manifest excludes --starter-manifest; see veldt inspect --help\n",
    )
