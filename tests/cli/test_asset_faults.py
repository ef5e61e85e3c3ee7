"""Files of species, plants, structures and sites are checked against their schema before anything is planned."""

import copy
import json

import jsonschema
import pytest

from configs import tiny
from program import ROOT, Veldt, check_fault

KINDS = ("species", "plants", "structures", "sites")
SCHEMA = json.loads((ROOT / "configs" / "schema" / "asset.schema.json").read_text())
DRAWN = json.loads((ROOT / "assets" / "species" / "lion.json").read_text())
RIGID = {
    "category": "okapi",
    "material": "zebra",
    "source": {"size": "estimate"},
    "speed_m_s": 1.0,
    "variants": {"adult": {"share": 1, "size_range": [1.0, 1.0]}},
    "model": {"file": "okapi.obj", "forward": "x", "parts": {"hide": "", "horn": "head"}},
}
PLANT = json.loads((ROOT / "assets" / "plants" / "rock.json").read_text())
HUT = json.loads((ROOT / "assets" / "structures" / "hut_round.json").read_text())
CAMP = json.loads((ROOT / "assets" / "sites" / "camp.json").read_text())


@pytest.mark.parametrize("kind", KINDS)
def test_all_assets_of_the_program_are_valid(kind):
    check = jsonschema.Draft202012Validator(SCHEMA | {"$ref": f"#/$defs/{kind}"})
    for file in sorted((ROOT / "assets" / kind).glob("*.json")):
        assert not list(check.iter_errors(json.loads(file.read_text()))), file


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A Veldt with an asset `okapi` of each kind, and a config that names them all."""
    veldt = Veldt(tmp_path_factory.mktemp("assets"))
    home = veldt.folder / "home"
    (home / "assets").mkdir(parents=True)
    for name in ("blender_scripts", "configs"):
        (home / name).symlink_to(ROOT / name)
    for folder in (ROOT / "assets").iterdir():
        if folder.name not in KINDS:
            (home / "assets" / folder.name).symlink_to(folder)
    for kind in KINDS:
        (home / "assets" / kind).mkdir()
        for file in (ROOT / "assets" / kind).glob("*.json"):
            (home / "assets" / kind / file.name).symlink_to(file)

    def name_all(config: dict) -> None:
        config["scene"]["groups"][0]["species"] = "okapi"
        config["scene"]["plants"] = {"okapi": {"per_ha": 1}}
        config["scene"]["sites"] = [{"kind": "okapi", "place": [0, 0]}]

    veldt.write("config.json", tiny(name_all))
    return veldt


def _fault(place: Veldt, kind: str, content: str, message: str) -> None:
    files = {other: place.folder / "home" / "assets" / other / "okapi.json" for other in KINDS}
    for other, file in files.items():
        file.unlink(missing_ok=True)
        if other == kind:
            file.write_text(content)
        elif other == "sites" and kind == "structures":
            file.write_text(json.dumps(CAMP | {"objects": [{"object": ["lamp_post", "okapi"]}]}))
    done = place(
        "plan", "config.json", "--out", "plan", "--quiet", env={"VELDT_HOME": str(place.folder / "home")}
    )
    check_fault(done, 2, message)


def _in(place: str, value):
    """Sets the value at "a.b.c", or takes it away if it is None."""

    def change(data) -> None:
        *path, last = (int(step) if step.isdigit() else step for step in place.split("."))
        for step in path:
            data = data[step]
        if value is None:
            del data[last]
        else:
            data[last] = value

    return change


FORMS = "bottle, bush, log, many_stemmed, mound, rock, tussock, umbrella"
FAULTS = {
    "no variants": ("species", RIGID, _in("variants", None), "variants is missing; expected a value"),
    "empty variants": (
        "species",
        RIGID,
        _in("variants", {}),
        "variants = an object; expected at least one entry",
    ),
    "variant": (
        "species",
        RIGID,
        _in("variants.adult.size_range", None),
        "variants.adult.size_range is missing; expected a value",
    ),
    "shape": (
        "species",
        DRAWN,
        _in("bones.tail.shapes.0.part", None),
        "bones.tail.shapes[0].part is missing; expected a value",
    ),
    "patch without a corner": (
        "species",
        DRAWN,
        _in("bones.tail.shapes.0.patches", [{"part": "legs", "to_m": [1, 1, 1]}]),
        "bones.tail.shapes[0].patches[0].from_m is missing; expected a value",
    ),
    "patch with half a corner": (
        "species",
        DRAWN,
        _in("bones.tail.shapes.0.patches", [{"part": "legs", "from_m": [0, 1], "to_m": [1, 1, 1]}]),
        "bones.tail.shapes[0].patches[0].from_m = a list of 2; expected 3 entries",
    ),
    "unknown key": (
        "species",
        DRAWN,
        _in("moves.0.degrees", 3),
        "moves[0].degrees is not a known key; expected one of bone, axis, deg, per_stride, period_s, phase,"
        " takes_turns, only",
    ),
    "model is not an object": (
        "species",
        RIGID,
        _in("model", "okapi.obj"),
        'model = "okapi.obj"; expected an object',
    ),
    "scale": (
        "species",
        RIGID,
        _in("model.scale", 0),
        "model.scale = 0; expected more than 0 and at most 1000000",
    ),
    "forward": (
        "species",
        RIGID,
        _in("model.forward", "z"),
        'model.forward = "z"; expected one of x, -x, y, -y',
    ),
    "no forward": (
        "species",
        RIGID,
        _in("model.forward", None),
        "model.forward is missing; expected a value",
    ),
    "forward is not a string": (
        "species",
        RIGID,
        _in("model.forward", ["x"]),
        "model.forward = a list of 1; expected a string",
    ),
    "part is not a string": (
        "species",
        RIGID,
        _in("model.parts.horn", []),
        "model.parts.horn = a list of 0; expected a string",
    ),
    "size": ("species", RIGID, _in("model.size_m", [1, 2]), "model.size_m = a list of 2; expected 3 entries"),
    "unknown key of a model": (
        "species",
        RIGID,
        _in("model.scales", 2),
        "model.scales is not a known key; expected one of file, scale, forward, parts, size_m;"
        ' did you mean "scale"?',
    ),
    "no parts": (
        "species",
        RIGID,
        _in("model.parts", {}),
        "model.parts = an object; expected at least one entry",
    ),
    "plant": ("plants", PLANT, _in("foot_m", None), "foot_m is missing; expected a value"),
    "form": (
        "plants",
        PLANT,
        _in("form", "rok"),
        f'form = "rok"; expected one of {FORMS}; did you mean "rock"?',
    ),
    "no variant": ("plants", PLANT, _in("variants", 0), "variants = 0; expected at least 1"),
    "slot": (
        "structures",
        HUT,
        _in("materials.wall", 3),
        "materials.wall = 3; expected a string or a list",
    ),
    "no shapes": ("structures", HUT, _in("shapes", []), "shapes = a list of 0; expected at least 1 entries"),
    "foot": ("structures", HUT, _in("foot_m", "wide"), 'foot_m = "wide"; expected a number'),
    "rule of a site": (
        "sites",
        CAMP,
        _in("objects.0.count", [1]),
        "objects[0].count = a list of 1; expected 2 entries",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_names_file_key_and_rule(place, name):
    kind, data, change, message = FAULTS[name]
    changed = copy.deepcopy(data)
    change(changed)
    _fault(place, kind, json.dumps(changed), f"config.json: assets/{kind}/okapi.json: {message}")


@pytest.mark.parametrize("content, message", [("[]", "document = a list of 0; expected an object")])
def test_a_file_that_is_no_object(place, content, message):
    _fault(place, "plants", content, f"config.json: assets/plants/okapi.json: {message}")


def test_files_that_a_config_does_not_name_are_not_read(place):
    (place.folder / "home" / "assets" / "plants" / "palm.json").write_text("{")
    _fault(
        place,
        "species",
        "[]",
        "config.json: assets/species/okapi.json: document = a list of 0; expected an object",
    )
