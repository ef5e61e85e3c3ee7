"""The parts of the Blender extension that need no Blender: names, targets, manifest, and the rules for extensions."""

import json
import subprocess
import sys
import tomllib
from types import SimpleNamespace

import jsonschema
import pytest

from planner.config import ROOT
from veldt_panel.catalogue import Preset, Thing, guess, read_catalogue, words_of
from veldt_panel.manifest import Frame, Intrinsics, Lens, build_manifest, clip_name, intrinsics_of
from veldt_panel.program import Progress, ProgramError, find_program, parse_progress, run
from veldt_panel.targets import Indices, Target, copy_of, owner_of, target_of

EXTENSION = ROOT / "blender_scripts" / "veldt_panel"
SHIFTED = ((1.0, 0.0, 0.0, 5.0), (0.0, 1.0, 0.0, 6.0), (0.0, 0.0, 1.0, 7.0), (0.0, 0.0, 0.0, 1.0))
TURNED = ((0.0, -1.0, 0.0, 1.0), (1.0, 0.0, 0.0, 2.0), (0.0, 0.0, 1.0, 3.0), (0.0, 0.0, 0.0, 1.0))


def _holder(name, kind="unset", parent=None, target=""):
    said = SimpleNamespace(kind=kind, material="m", category="c", species="s", target=target)
    return SimpleNamespace(name=name, parent=parent, veldt=said)


def test_the_nearest_assignment_holds():
    rig = _holder("rig", "actor")
    body = _holder("body", parent=rig)
    saddle = _holder("saddle", "plant", parent=body)
    strap = _holder("strap", parent=saddle)
    herd = _holder("herd", "ground")
    around = {"lone": [herd], "body": [herd]}

    def owner(thing):
        found = owner_of(thing, lambda each: around.get(each.name, []))
        return found and found.name

    assert [owner(each) for each in (rig, body, saddle, strap)] == ["rig", "rig", "saddle", "saddle"]
    assert (owner(_holder("lone")), owner(_holder("other"))) == ("herd", None)


def test_what_is_not_assigned_is_the_rest_and_background_of_one_material_is_one_target():
    assert target_of(None, "soil") == Target("unassigned_soil", "ground", "soil")
    assert target_of(_holder("a", "plant"), "soil") == target_of(_holder("b", "plant"), "soil")
    assert target_of(_holder("a", "actor"), "soil") != target_of(_holder("b", "actor"), "soil")
    assert target_of(_holder("a", "actor", target="x"), "") == target_of(
        _holder("b", "actor", target="x"), ""
    )


def test_indices_and_tracks_count_from_one():
    indices = Indices()
    cow = Target("cow", "actor", "cattle", "cattle", "cattle")
    soil = Target("soil", "ground", "soil")
    assert [indices.index_of(each) for each in (soil, cow, copy_of(cow, "field", (2, 7)), cow)] == [
        1,
        2,
        3,
        2,
    ]
    assert indices.objects() == [
        {"index": 1, "name": "soil", "class": "ground", "material": "soil"},
        {
            **{"index": 2, "name": "cow", "class": "actor", "material": "cattle", "category": "cattle"},
            **{"track_id": 1, "species": "cattle"},
        },
        {
            **{
                "index": 3,
                "name": "cow_field_2_7",
                "class": "actor",
                "material": "cattle",
                "category": "cattle",
            },
            **{"track_id": 2, "species": "cattle"},
        },
    ]


def test_more_targets_than_indices():
    indices = Indices()
    for number in range(32767):
        indices.index_of(Target(str(number), "actor", "m", "c"))
    with pytest.raises(ValueError, match=r"^targets = 32768; expected at most 32767$"):
        indices.index_of(Target("one more", "actor", "m", "c"))


@pytest.mark.parametrize(
    "lens, size, expected",
    [
        (Lens(50, 36, 24, "AUTO"), (640, 512), (50 / 36 * 640, 320, 256)),
        (Lens(50, 36, 24, "AUTO"), (512, 640), (50 / 36 * 640, 256, 320)),
        (Lens(50, 36, 24, "VERTICAL"), (640, 512), (50 / 24 * 512, 320, 256)),
        (Lens(50, 36, 24, "HORIZONTAL", 0.1, 0.2), (640, 512), (50 / 36 * 640, 256, 384)),
    ],
)
def test_intrinsics(lens, size, expected):
    found = intrinsics_of(lens, *size)
    assert (found.fx_px, found.cx_px, found.cy_px) == pytest.approx(expected, rel=1e-15)
    assert found.fy_px == found.fx_px


def test_the_manifest_follows_its_schema():
    indices = Indices()
    index = indices.index_of(Target("cow", "actor", "cattle", "cattle", "cattle"))
    made = build_manifest(
        "clip", 24, 2, Intrinsics(640, 512, 900.0, 900.0, 320.0, 256.0), indices.objects(),
        [Frame("000000.exr", 0.0, SHIFTED, {index: TURNED})],
    )  # fmt: skip
    schema = json.loads((ROOT / "configs" / "schema" / "manifest.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(made)
    frame = made["frames"][0]
    assert frame["camera_to_world"] == [1, 0, 0, 5, 0, -1, 0, 6, 0, 0, -1, 7, 0, 0, 0, 1]
    assert frame["actors"] == [
        {"index": 1, "position_m": [1, 2, 3], "heading_rad": pytest.approx(1.5707963267948966)}
    ]


def test_names_of_clips():
    assert [clip_name(text) for text in ("a b.c", "--x", "", "-" * 9, "n" * 300)] == [
        *("a_b_c", "x", "clip", "clip", "n" * 200)
    ]


def test_what_the_assets_know():
    known = read_catalogue(ROOT)
    assert known.things["pickup"] == Thing("actor", "truck", "vehicle", "pickup")
    assert known.things["water"] == Thing("water", "water")
    assert "soil" in known.materials and "pickup" not in known.materials
    assert known.presets["boson_640_14mm"] == Preset(640, 512, pytest.approx(0.01345 / 12e-6))


def test_guesses_by_names():
    things = read_catalogue(ROOT).things
    assert words_of("Elephant_bull.001") == ["elephant", "bull"] and words_of("elephantBull") == [
        "elephant",
        "bull",
    ]
    known = {"Elephants.003": "elephant", "the_Poacher": "human", "RiverBed": "water", "Granary": "thatch"}
    assert {name: guess(things, name).material for name in known} == known
    assert guess(things, "Cube.001") is None


def test_progress_and_messages():
    line = '{"clip": "a", "frames_done": 1, "frames_total": 4, "frames_per_s": 2, "left_s": 1.5}'
    assert parse_progress(line, "convert") == Progress(0.25, "convert: a 1/4 frames")
    assert parse_progress('{"event": "remade", "clip": "a"}', "convert") == Progress(0, "convert: remade")
    assert parse_progress("veldt: no", "convert") is None and parse_progress("3", "convert") is None


def _program(folder, body: str) -> str:
    file = folder / "veldt"
    file.write_text(f"#!{sys.executable}\n{body}\n", encoding="utf-8")
    file.chmod(0o755)
    return str(file)


def test_a_command_that_fails_says_why(tmp_path):
    file = _program(tmp_path, "import sys; print('veldt: bad', file=sys.stderr); sys.exit(2)")
    with pytest.raises(ProgramError, match=r"^veldt convert ended with exit code 2: veldt: bad$"):
        list(run(file, ["convert"]))


def test_a_stopped_job_stops_its_command(tmp_path):
    file = _program(tmp_path, "import time; time.sleep(3600)")
    job = run(file, ["convert"])
    assert next(job).text == "convert"
    job.close()
    assert subprocess.run(["pgrep", "-f", file], capture_output=True, check=False).returncode == 1


def test_programs_that_are_not_veldt(tmp_path):
    file = _program(tmp_path, "print('hello')")
    with pytest.raises(ProgramError, match=r"veldt doctor = no answer \(.*\); expected the program veldt$"):
        find_program(file)


def test_the_extensions_manifest_follows_blenders_rules():
    """Of docs.blender.org/manual/en/4.2/advanced/extensions: required keys, lengths, and permissions with reasons."""
    said = tomllib.loads((EXTENSION / "blender_manifest.toml").read_text(encoding="utf-8"))
    required = {
        "schema_version",
        "id",
        "version",
        "name",
        "tagline",
        "maintainer",
        "type",
        "blender_version_min",
        "license",
    }
    assert required <= set(said)
    assert (said["schema_version"], said["type"], said["id"]) == ("1.0.0", "add-on", EXTENSION.name)
    assert said["license"] == ["SPDX:GPL-3.0-or-later"]
    assert tuple(map(int, said["blender_version_min"].split("."))) >= (4, 2, 0)
    assert 0 < len(said["tagline"]) <= 64 and said["tagline"][-1].isalnum()
    assert set(said["permissions"]) == {"files"}
    assert all(0 < len(reason) <= 64 and reason[-1].isalnum() for reason in said["permissions"].values())


def test_every_module_says_its_licence():
    files = sorted(EXTENSION.glob("*.py"))
    assert files and "GNU GENERAL PUBLIC LICENSE" in (EXTENSION / "LICENSE").read_text(encoding="utf-8")
    for file in files:
        assert file.read_text(encoding="utf-8").startswith("# SPDX-License-Identifier: GPL-3.0-or-later\n")
