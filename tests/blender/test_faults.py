"""Configs that make no sense are rejected with exact messages."""

import json
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest

from scenes import tiny
from planner.config import ROOT
from planner.faults import ConfigError
from planner.world import plan_world


def _set(path, value):
    """A change of a config: the item at `path`, or its removal where value is None."""

    def change(config):
        *way, last = path
        for step in way:
            config = config[step]
        if value is None:
            del config[last]
        else:
            config[last] = value

    return change


GROUP, CLIP = ("scene", "groups", 1), ("clips", 0)
ZIGZAG, FOLLOW = (*CLIP, "flight"), ("clips", 1, "flight")


def _road(corners):
    return _set(("scene", "terrain", "road"), {"width_m": 3.8, "points_m": corners})


FAULTS = {
    "unknown species": (
        _set((*GROUP, "species"), "elefant"),
        'scene.groups[1].species = "elefant"; expected a species: {species}; did you mean "elephant"?',
    ),
    "unknown path": (
        _set((*GROUP, "path"), "lop"),
        'scene.groups[1].path = "lop"; expected a path of scene.paths: loop; did you mean "loop"?',
    ),
    "unknown path, nothing near": (
        _set((*GROUP, "path"), "river"),
        'scene.groups[1].path = "river"; expected a path of scene.paths: loop',
    ),
    "two groups of one name": (
        _set((*GROUP, "name"), "people"),
        'scene.groups[1].name = "people"; expected a name no other group has',
    ),
    "a group named like a member": (
        _set((*GROUP, "name"), "people_2"),
        'scene.groups[1].name = "people_2"; expected a name no member of a group has',
    ),
    "more actors than indices": (
        lambda config: [group.update(count=16400) for group in config["scene"]["groups"][:2]],
        "scene.groups = 32802 actors; expected at most 32667, one object index each",
    ),
    "no area": (
        _set((*ZIGZAG, "area_m"), None),
        'clips[0].flight.area_m is missing; expected [x_min, y_min, x_max, y_max], since pattern is "zigzag"',
    ),
    "area inside out": (
        _set((*ZIGZAG, "area_m"), [30, -30, -30, 30]),
        "clips[0].flight.area_m = [30, -30, -30, 30] m; expected x_min < x_max and y_min < y_max",
    ),
    "area without height": (
        _set((*ZIGZAG, "area_m"), [-30, 5, 30, 5]),
        "clips[0].flight.area_m = [-30, 5, 30, 5] m; expected x_min < x_max and y_min < y_max",
    ),
    "no target": (
        _set((*FOLLOW, "target"), None),
        'clips[1].flight.target is missing; expected an actor or a group, since pattern is "follow"',
    ),
    "unknown target": (
        _set((*FOLLOW, "target"), "zebra_2"),
        'clips[1].flight.target = "zebra_2"; expected an actor or a group; did you mean "zebras_2"?',
    ),
    "no height above ground": (
        _set((*ZIGZAG, "altitude_m"), -4),
        "clips[0].flight.altitude_m = -4 m; expected more than 0 m above ground",
    ),
    "more cells than memory": (
        _set(("scene", "terrain"), {"size_m": 10000, "cell_m": 0.25}),
        "scene.terrain.cell_m = 0.25 m; expected at least 2.5 m for size_m = 10000 m",
    ),
    "more plants than memory": (
        lambda config: config["scene"].update(
            terrain={"size_m": 10000, "cell_m": 5}, plants={"shrub": {"per_ha": 500}}
        ),
        "scene.plants.shrub.per_ha = 500 per ha; expected at most 200 per ha for size_m = 10000 m",
    ),
    "unknown plant": (
        _set(("scene", "plants"), {"acaica": {"per_ha": 3}}),
        'scene.plants = "acaica"; expected a plant: {plants}; did you mean "acacia"?',
    ),
    "no plants anywhere": (
        _set(("scene", "plants"), {"log": {"per_ha": [0, 0, 0]}}),
        "scene.plants.log.per_ha = [0, 0, 0] per ha; expected more than 0 per ha somewhere",
    ),
    "path off the terrain": (
        _set(("scene", "paths", "loop", "points_m"), [[61, 0], [0, 30], [-30, 0], [0, -30]]),
        "scene.paths.loop: the loop reaches x = 61.0 m, y = 0.0 m (and walkers 1 m beside it);"
        " expected within 60 m of the middle in x and y",
    ),
    "path without length": (
        _set(("scene", "paths", "loop", "points_m"), [[1, 1], [1, 1], [1, 1]]),
        "scene.paths.loop = 0.0 m long; expected at least 1 m",
    ),
    "road off the terrain": (
        _road([[61, 0], [0, 30], [-30, 0], [0, -30]]),
        "scene.terrain.road.points_m: the loop reaches x = 61.0 m, y = 0.0 m;"
        " expected within 60 m of the middle in x and y",
    ),
    "road that crosses itself": (
        _road([[40, 40], [-40, -40], [40, -40], [-40, 40]]),
        "scene.terrain.road.points_m: the loop crosses itself at x = 0.2 m, y = 0.2 m; expected a loop that does not",
    ),
    "road through the water": (
        _road([[5, 3], [-5, 5], [0, -5]]),
        "scene.terrain.road.points_m: the loop is in water at x = 5.0 m, y = 3.0 m; expected dry ground",
    ),
    "road without length": (
        _road([[30, 1], [30, 1], [30, 1]]),
        "scene.terrain.road.points_m = 0.0 m long; expected at least 1 m",
    ),
    "heightmap that is not there": (
        _set(("scene", "terrain", "heightmap"), {"file": "/none/hill.png", "height_m": [0, 9]}),
        "scene.terrain.heightmap.file = /none/hill.png; expected a readable file (No such file or directory)",
    ),
    "density map that is not there": (
        _set(("scene", "terrain", "density_map"), {"file": "/none/areas.exr"}),
        "scene.terrain.density_map.file = /none/areas.exr; expected a readable file (No such file or directory)",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_fault(name):
    change, message = FAULTS[name]
    with pytest.raises(ConfigError) as fault:
        plan_world(tiny(change))
    assert str(fault.value) == message.format(species=_names("species"), plants=_names("plants"))


def _names(kind):
    return ", ".join(sorted(path.stem for path in (ROOT / "assets" / kind).glob("*.json")))


def _run(tmp_path: Path, config: dict, *options: str) -> subprocess.CompletedProcess:
    path = tmp_path / "config.json"
    path.write_text(json.dumps(config))
    script = ROOT / "blender_scripts" / "plan_scene.py"
    command = [sys.executable, str(script), "--config", str(path), *options]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_the_command_says_a_fault_in_one_line_and_exits_2(tmp_path):
    config = tiny()
    config["scene"]["groups"][1]["name"] = "people"
    done = _run(tmp_path, config)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == 'scene.groups[1].name = "people"; expected a name no other group has\n'


def test_the_command_prints_the_plan(tmp_path):
    done = _run(tmp_path, tiny())
    plan = json.loads(done.stdout)
    assert (done.returncode, done.stderr, plan["actors"]) == (0, "", 6)
    jsonschema.validate(plan, json.loads((ROOT / "configs" / "schema" / "plan.schema.json").read_text()))
    assert [(clip["id"], clip["frames"], clip["duration_s"]) for clip in plan["clips"]] == [
        ("down", 3, 0.333),
        ("side", 3, 0.333),
    ]
    assert plan["clips"][1]["frames_with_actors"] == 3
    assert sum(plan["outline"]["covers"].values()) == pytest.approx(1, abs=1e-5)
