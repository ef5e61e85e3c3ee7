"""The manifest conforms to its schema and states what was planned."""

import json

import jsonschema
import numpy as np
import pytest

from scenes import flat, tiny
from veldt.groups.actors import track
from veldt.config import ROOT
from veldt.manifest import build_manifest, to_json
from veldt.world import plan_world

SCHEMA = json.loads((ROOT / "configs" / "schema" / "manifest.schema.json").read_text())


@pytest.mark.parametrize("clip", [0, 1])
def test_it_keeps_to_the_schema(world, clip):
    text = to_json(build_manifest(world, world.config["clips"][clip]))
    jsonschema.validate(json.loads(text), SCHEMA)


def test_the_text_is_the_manifest(world):
    manifest = build_manifest(world, world.config["clips"][0])
    assert json.loads(to_json(manifest)) == manifest


def test_every_material_of_an_object_is_listed(world):
    manifest = build_manifest(world, world.config["clips"][0])
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


def test_actors_are_where_they_walk(world):
    clip = world.config["clips"][1]
    frames = build_manifest(world, clip)["frames"]
    actor = world.actors[3]
    walk = track(actor, np.array([frame["time_s"] for frame in frames]))
    entries = [entry for frame in frames for entry in frame["actors"] if entry["index"] == actor.index]
    # Times are rounded to 1e-9 s, places to 1e-6 m, angles to 1e-9 rad.
    assert [entry["position_m"] for entry in entries] == [pytest.approx(p, abs=2e-6) for p in walk.position_m]
    assert [entry["heading_rad"] for entry in entries] == pytest.approx(walk.heading_rad, abs=1e-8)


def test_tracks_are_the_same_in_all_clips_of_a_dataset(world):
    down, side = (build_manifest(world, clip)["objects"] for clip in world.config["clips"])
    assert down == side


def test_a_place_without_water_or_plants_lists_none():
    world = plan_world(tiny(flat))
    classes = {entry["class"] for entry in build_manifest(world, world.config["clips"][0])["objects"]}
    assert classes == {"ground", "actor"}


def test_the_camera_is_the_pictures_own_whatever_the_passes_reach():
    wide = plan_world(tiny(lambda config: config.update(render={"overscan_px": 12, "supersample": 2})))
    manifest = build_manifest(wide, wide.config["clips"][0])
    assert (manifest["overscan_px"], manifest["supersample"]) == (12, 2)
    assert (manifest["camera"]["width_px"], manifest["camera"]["height_px"]) == (96, 80)
    assert (manifest["camera"]["cx_px"], manifest["camera"]["cy_px"]) == (48, 40)
    jsonschema.validate(manifest, SCHEMA)


def test_the_actor_layer_is_named_only_where_there_is_one(world):
    assert "actor_layer" not in build_manifest(world, world.config["clips"][0])
    layered = plan_world(tiny(lambda config: config.update(render={"actor_layer": True})))
    manifest = build_manifest(layered, layered.config["clips"][0])
    assert manifest["actor_layer"] == "Actors"
    jsonschema.validate(manifest, SCHEMA)
