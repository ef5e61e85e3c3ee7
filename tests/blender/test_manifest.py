"""The manifest conforms to its schema and states what was planned."""

import json

import jsonschema
import numpy as np
import pytest

from plans import bake
from scenes import flat, tiny
from planner.bake.baked import clip_of, read_plan, read_scene, read_track
from planner.config import ROOT
from planner.groups.actors import track
from planner.manifest import build_manifest, to_json

SCHEMA = json.loads((ROOT / "configs" / "schema" / "manifest.schema.json").read_text())


def _manifest(plan, clip: str = "down", supersample: int = 1, actor_layer: bool = False) -> dict:
    scene = read_scene(plan / "scene")
    walked = read_track(plan / "tracks" / clip, scene)
    return build_manifest(scene, walked, clip_of(read_plan(plan), clip), supersample, actor_layer)


@pytest.mark.parametrize("clip", ["down", "side"])
def test_it_keeps_to_the_schema(plan, clip):
    jsonschema.validate(json.loads(to_json(_manifest(plan, clip))), SCHEMA)


def test_the_text_is_the_manifest(plan):
    assert json.loads(to_json(_manifest(plan))) == _manifest(plan)


def test_every_material_of_an_object_is_listed(plan):
    manifest = _manifest(plan)
    listed = {entry["material"] for entry in manifest["materials"]}
    assert {entry["material"] for entry in manifest["objects"]} <= listed
    parts = {(entry["material"], entry.get("part")) for entry in manifest["materials"]}
    assert {
        ("human", "face"),
        ("human", "hands"),
        ("elephant", "ears"),
        ("soil", None),
        ("grass", None),
    } <= parts


def test_actors_are_where_they_walk(plan, world):
    frames = _manifest(plan, "side")["frames"]
    actor = world.actors[3]
    walk = track(actor, np.array([frame["time_s"] for frame in frames]))
    entries = [entry for frame in frames for entry in frame["actors"] if entry["index"] == actor.index]
    # Times are rounded to 1e-9 s, places to 1e-6 m, angles to 1e-9 rad.
    assert [entry["position_m"] for entry in entries] == [pytest.approx(p, abs=2e-6) for p in walk.position_m]
    assert [entry["heading_rad"] for entry in entries] == pytest.approx(walk.heading_rad, abs=1e-8)


def test_tracks_are_the_same_in_all_clips_of_a_dataset(plan):
    assert _manifest(plan, "down")["objects"] == _manifest(plan, "side")["objects"]


def test_a_place_without_water_or_plants_lists_none(tmp_path):
    bare = bake(tiny(flat), tmp_path / "plan")
    assert {entry["class"] for entry in _manifest(bare)["objects"]} == {"ground", "actor"}


def test_the_camera_is_the_pictures_own_whatever_the_passes_reach(tmp_path):
    wide = bake(tiny(lambda config: config.update(render={"overscan_px": 12})), tmp_path / "plan")
    manifest = _manifest(wide, supersample=2)
    assert (manifest["overscan_px"], manifest["supersample"]) == (12, 2)
    assert (manifest["camera"]["width_px"], manifest["camera"]["height_px"]) == (96, 80)
    assert (manifest["camera"]["cx_px"], manifest["camera"]["cy_px"]) == (48, 40)
    jsonschema.validate(manifest, SCHEMA)


def test_the_actor_layer_is_named_only_where_there_is_one(plan):
    assert "actor_layer" not in _manifest(plan)
    manifest = _manifest(plan, actor_layer=True)
    assert manifest["actor_layer"] == "Actors"
    jsonschema.validate(manifest, SCHEMA)


def test_a_clip_of_a_flight_names_its_flight(tmp_path):
    def change(config: dict) -> None:
        clip = config["clips"].pop(0)
        clip.pop("frames")
        config["flights"] = [clip | {"id": "long", "duration_s": 1, "keep": "all"}]

    plan = bake(tiny(change), tmp_path / "plan")
    manifest = _manifest(plan, "long_0000")
    assert manifest["of_flight"] == "long"
    assert "of_flight" not in _manifest(plan, "side")
    jsonschema.validate(manifest, SCHEMA)
