"""Faults in configs: exact messages on standard error, exit code 2, no files left behind."""

import json

import pytest

from configs import tiny
from program import ROOT, check_fault

SCHEMA = json.loads((ROOT / "configs" / "schema" / "config.schema.json").read_text(encoding="utf-8"))
KEYS = ", ".join(SCHEMA["properties"])
SPECIES = ", ".join(sorted(file.stem for file in (ROOT / "assets" / "species").glob("*.json")))
PRESETS = ", ".join(sorted(file.stem for file in (ROOT / "assets" / "sensors").glob("*.json")))


def _with(path: str, value):
    """The tiny config with another value at "a.0.b", or without that key where the value is None."""

    def change(config):
        *way, last = (int(step) if step.isdigit() else step for step in path.split("."))
        for step in way:
            config = config.setdefault(step, {}) if isinstance(config, dict) else config[step]
        if value is None:
            del config[last]
        else:
            config[last] = value

    return tiny(change)


ZIGZAG, FOLLOW = "clips.0.flight", "clips.1.flight"

FORM = {
    "unknown key": (
        _with("sead", 7),
        f'sead is not a known key; expected one of {KEYS}; did you mean "seed"?',
    ),
    "unknown key deep down": (
        _with("scene.terrain.relief", 7),
        "scene.terrain.relief is not a known key; expected one of size_m, cell_m, relief_m, hill_wavelength_m,"
        " water_radius_m, pan_radius_m, hollow_depth_m, gully_depth_m, craggy_fraction, crag_relief_m, heightmap,"
        " density_map, road, grass_fraction, grass_patch_m, pan_fraction, burnt_fraction, area_wavelength_m;"
        ' did you mean "relief_m"?',
    ),
    "key nowhere near": (_with("temperature", 7), f"temperature is not a known key; expected one of {KEYS}"),
    "missing key": (_with("clips.1.season", None), "clips[1].season is missing; expected a value"),
    "text for a number": (_with("camera.width_px", "96"), 'camera.width_px = "96"; expected a whole number'),
    "number for text": (_with("clips.0.id", 4), "clips[0].id = 4; expected a string"),
    "fraction of a frame": (_with("clips.0.frames", 2.5), "clips[0].frames = 2.5; expected a whole number"),
    "list for an object": (_with("camera", [96, 80]), "camera = a list of 2; expected an object"),
    "null": (_with("clips.0.flight", {"pattern": None}), "clips[0].flight.pattern = null; expected a string"),
    "too small": (
        _with("clips.0.frame_rate_hz", 0),
        "clips[0].frame_rate_hz = 0 Hz; expected at least 0.1 and at most 240 Hz",
    ),
    "too large": (
        _with("sensor.optics.blur_sigma_px", 10.5),
        "sensor.optics.blur_sigma_px = 10.5 px; expected at least 0 and at most 10 px",
    ),
    "no plants of a kind": (
        _with("scene.plants.acacia.per_ha", 0),
        "scene.plants.acacia.per_ha = 0 per hectare; expected more than 0 and at most 10000 per hectare",
    ),
    "fewer plants than none": (
        _with("scene.plants.acacia.per_ha", [20, -1, 60]),
        "scene.plants.acacia.per_ha[1] = -1 per hectare; expected at least 0 and at most 10000 per hectare",
    ),
    "plants of too few areas": (
        _with("scene.plants.acacia.per_ha", [20, 60]),
        "scene.plants.acacia.per_ha = a list of 2; expected 3 entries",
    ),
    "plants in words": (
        _with("scene.plants.acacia.per_ha", "many"),
        'scene.plants.acacia.per_ha = "many"; expected a number or a list',
    ),
    "plants of no number": (
        _with("scene.plants.acacia", {}),
        "scene.plants.acacia.per_ha is missing; expected a value",
    ),
    "unknown choice": (
        _with("clips.0.season", "wintr"),
        'clips[0].season = "wintr"; expected one of winter, summer; did you mean "winter"?',
    ),
    "invalid name": (
        _with("clips.0.id", "../down"),
        'clips[0].id = "../down"; expected 1 to 200 letters, digits, _ or -, not beginning with -',
    ),
    "too few corners": (
        _with("scene.paths.loop.points_m", [[0, 0], [1, 1]]),
        "scene.paths.loop.points_m = a list of 2; expected at least 3 entries",
    ),
    "area of three numbers": (
        _with(f"{ZIGZAG}.area_m", [0, 0, 1]),
        "clips[0].flight.area_m = a list of 3; expected 4 entries",
    ),
    "two clips of one id": (_with("clips.1.id", "down"), 'clips[1].id = "down"; expected each id once'),
}

MEANING = {
    "unknown species": (
        _with("scene.groups.1.species", "elefant"),
        f'scene.groups[1].species = "elefant"; expected a species: {SPECIES}; did you mean "elephant"?',
    ),
    "unknown path": (
        _with("scene.groups.0.path", "loopp"),
        'scene.groups[0].path = "loopp"; expected a path of scene.paths: loop; did you mean "loop"?',
    ),
    "unknown target": (
        _with(f"{FOLLOW}.target", "hurd"),
        'clips[1].flight.target = "hurd"; expected an actor or a group; did you mean "herd"?',
    ),
    "follow without a target": (
        _with(f"{FOLLOW}.target", None),
        'clips[1].flight.target is missing; expected an actor or a group, since pattern is "follow"',
    ),
    "altitude in the ground": (
        _with(f"{ZIGZAG}.altitude_m", -4),
        "clips[0].flight.altitude_m = -4 m; expected more than 0 m above ground",
    ),
}


def _check(veldt, config, *lines: str) -> None:
    """Check that validate and generate reject the config with this message and leave no files behind."""
    veldt.write("config.json", config)
    for command in (["validate", "config.json"], ["generate", "config.json", "--out", "out"]):
        done = veldt(*command)
        assert done.err.splitlines() == [f"veldt: {line}" for line in lines]
        assert (done.code, done.out) == (2, "")
    assert [file.name for file in veldt.folder.iterdir()] == ["config.json"]


@pytest.mark.parametrize("name", FORM | MEANING)
def test_fault(veldt, name):
    config, message = (FORM | MEANING)[name]
    _check(veldt, config, f"config.json: {message}")


def test_all_schema_faults_are_reported_at_once(veldt):
    def change(config):
        config.update(seed=-1, nme="tiny")
        config["clips"][0]["frames"] = 0

    _check(
        veldt,
        tiny(change),
        "config.json: seed = -1; expected at least 0 and at most 4294967295",
        "config.json: clips[0].frames = 0; expected at least 1 and at most 1000000",
        f'config.json: nme is not a known key; expected one of {KEYS}; did you mean "name"?',
    )


def test_a_camera_below_the_terrain_is_found(veldt):
    """On level ground at height 0 the depth is known: the camera's own height."""

    def change(config):
        config["scene"]["terrain"].update(relief_m=0, water_radius_m=0)
        config["clips"][0]["flight"].update(altitude_reference="datum", altitude_m=-4.5)

    _check(
        veldt,
        tiny(change),
        "config.json: clips[0].flight: the camera is 4.5 m under the terrain at time_s = 0.0;"
        " expected it above ground all along",
    )


NOT_JSON = {
    "a comma too many": (
        '{\n  "name": "tiny",\n  "clips": [,]\n}',
        "3:13: not JSON: syntax error while parsing value - unexpected ','; expected '[', '{', or a literal",
    ),
    "cut short": (
        '{"name": "tiny"',
        "1:16: not JSON: syntax error while parsing object - unexpected end of input; expected '}'",
    ),
    "nothing": (
        "",
        "1:1: not JSON: it is empty",
    ),
    "key twice": ('{"name": "a",\n "name": "b"}', ' key "name" appears twice in one object; expected once'),
}


@pytest.mark.parametrize("name", NOT_JSON)
def test_not_json(veldt, name):
    text, message = NOT_JSON[name]
    _check(veldt, text, f"config.json:{message}")


def test_missing_config(veldt):
    for command in (["validate", "config.json"], ["generate", "config.json", "--out", "out"]):
        done = veldt(*command)
        assert (done.code, done.out) == (2, "")
        assert done.err == "veldt: cannot read config.json: No such file or directory\n"
    assert not list(veldt.folder.iterdir())


def test_a_config_on_a_failing_disk_is_no_wrong_usage(veldt):
    """The kernel reads a process's memory as it reads a file, but for what is not there."""
    for command in (["validate", "/proc/self/mem"], ["generate", "/proc/self/mem", "--out", "out"]):
        check_fault(veldt(*command), 1, "cannot read /proc/self/mem: Input/output error")


def test_a_good_config_is_summed_up(veldt):
    veldt.write("config.json", tiny())
    done = veldt("validate", "config.json")
    assert (done.code, done.err) == (0, "")
    assert done.out == "config.json: 2 clips, 16 frames, 16 with actors in view\n"
    report = veldt("validate", "config.json", "--json").json()
    assert report == {
        "config": "config.json",
        "valid": True,
        "clips": 2,
        "frames": 16,
        "frames_with_actors": 16,
    }


OUT = ("--out", "out")
COMMANDS = {"generate": OUT, "render": OUT, "validate": (), "budget": ()}


@pytest.mark.parametrize("command", COMMANDS)
def test_a_setting_is_checked_like_the_config(veldt, command):
    veldt.write("config.json", tiny())
    settings = ("--set", "season=summer", "sensor.preset=boson_640_41mm")
    done = veldt(command, "config.json", *COMMANDS[command], *settings)
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        f'veldt: config.json: sensor.preset = "boson_640_41mm"; expected one of {PRESETS};'
        ' did you mean "boson_640_14mm"?\n'
    )


def test_settings_change_the_config(veldt):
    veldt.write("config.json", tiny())
    done = veldt("validate", "config.json", "--set", "season=summer", "clips[0].frames=3")
    assert (done.code, done.err) == (0, "")
    assert done.out == "config.json: 2 clips, 11 frames, 11 with actors in view\n"
