"""The manifest that `render` writes beside a clip's passes conforms to its schema and says what was planned."""

import json

import jsonschema
import numpy as np
import pytest

import fake_blender
from configs import tiny
from planner.bake.baked import read_scene, read_track
from program import ROOT, Veldt, check_fault

SCHEMA = json.loads((ROOT / "configs" / "schema" / "manifest.schema.json").read_text())
ENGINES = ("blender", "embree")


def _render(veldt: Veldt, engine: str, change=None, out: str = "out") -> None:
    veldt.write("config.json", tiny(change))
    blender = fake_blender.install(veldt.folder)
    done = veldt(
        *("render", "config.json", "--out", out, "--engine", engine, "--blender", blender, "--quiet")
    )
    assert (done.code, done.err) == (0, "")


def _manifest(veldt: Veldt, clip: str = "down", out: str = "out") -> dict:
    manifest = veldt.read(f"{out}/passes/{clip}/manifest.json")
    jsonschema.validate(manifest, SCHEMA)
    return manifest


@pytest.fixture(scope="module", name="rendered", params=ENGINES)
def _rendered(request, tmp_path_factory) -> Veldt:
    veldt = Veldt(tmp_path_factory.mktemp(request.param))
    _render(veldt, request.param)
    return veldt


def test_every_material_of_an_object_is_listed(rendered):
    manifest = _manifest(rendered)
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


def test_frames_are_what_the_track_says(rendered):
    """Times are rounded to 1e-9 s, places to 1e-6 m, angles and axes to 1e-9."""
    scene = read_scene(rendered.folder / "out" / "plan" / "scene")
    track = read_track(rendered.folder / "out" / "plan" / "tracks" / "side", scene)
    frames = _manifest(rendered, "side")["frames"]
    assert [frame["file"] for frame in frames] == [f"{k:06d}.exr" for k in range(len(track.time_s))]
    assert [frame["time_s"] for frame in frames] == pytest.approx(track.time_s, abs=1e-9)
    assert [frame["agl_m"] for frame in frames] == pytest.approx(track.agl_m, abs=1e-6)
    poses = np.reshape([frame["camera_to_world"] for frame in frames], (-1, 4, 4))
    assert np.abs(poses - track.camera_to_world).max() < 1e-9
    for number, actor in enumerate(scene.header["actors"]):
        entries = [frame["actors"][number] for frame in frames]
        assert {entry["index"] for entry in entries} == {actor["object"]}
        places = [entry["position_m"] for entry in entries]
        assert np.abs(places - track.actor_position_m[number]).max() < 1e-6
        headings = [entry["heading_rad"] for entry in entries]
        assert headings == pytest.approx(track.actor_heading_rad[number], abs=1e-9)


def test_tracks_are_the_same_in_all_clips_of_a_dataset(rendered):
    assert _manifest(rendered, "down")["objects"] == _manifest(rendered, "side")["objects"]


def test_the_engines_differ_in_what_the_water_mirrors_alone(veldt):
    for engine in ENGINES:
        _render(veldt, engine, out=engine)
    blender, embree = (_manifest(veldt, out=engine) for engine in ENGINES)
    assert blender | {"mirror_layer": "Mirror"} == embree


def test_a_place_without_water_or_plants_lists_none(veldt):
    def change(config: dict) -> None:
        config["scene"]["terrain"].update(relief_m=0, water_radius_m=0)
        config["scene"]["plants"] = {}

    _render(veldt, "blender", change)
    assert {entry["class"] for entry in _manifest(veldt)["objects"]} == {"ground", "actor"}


def test_the_camera_is_the_pictures_own_whatever_the_passes_reach(veldt):
    wide = {"engine": "blender", "overscan_px": 12, "supersample": 2}
    _render(veldt, "blender", lambda config: config.update(render=wide))
    manifest = _manifest(veldt)
    assert (manifest["overscan_px"], manifest["supersample"]) == (12, 2)
    assert (manifest["camera"]["width_px"], manifest["camera"]["height_px"]) == (96, 80)
    assert (manifest["camera"]["cx_px"], manifest["camera"]["cy_px"]) == (48, 40)


def test_the_actor_layer_is_named_only_where_there_is_one(rendered, veldt):
    assert "actor_layer" not in _manifest(rendered)
    _render(veldt, "blender", lambda config: config["render"].update(actor_layer=True))
    assert _manifest(veldt)["actor_layer"] == "Actors"


def test_a_clip_of_a_flight_names_its_flight(veldt):
    def change(config: dict) -> None:
        clip = config["clips"].pop(0)
        clip.pop("frames")
        config["flights"] = [clip | {"id": "long", "duration_s": 1, "keep": "all"}]

    _render(veldt, "blender", change)
    assert _manifest(veldt, "long_0000")["of_flight"] == "long"
    assert "of_flight" not in _manifest(veldt, "side")


def test_frames_of_another_config_are_left_alone(veldt):
    """`render` sees from the config that the folder is another's; `generate` sees from the frames."""
    _render(veldt, "blender")
    folder = veldt.folder / "out" / "passes" / "down"
    before = {file.name: file.read_bytes() for file in folder.iterdir()}
    veldt.write("config.json", tiny(lambda config: config.update(seed=8)))
    done = fake_blender.generate(veldt, veldt.folder / "fake_blender", "--progress", "none")
    check_fault(done, 2, "--out = out/passes/down; expected no frames there, or frames of this plan")
    assert {file.name: file.read_bytes() for file in folder.iterdir()} == before


def test_a_manifest_that_is_there_is_not_written_again(veldt):
    _render(veldt, "blender")
    files = sorted((veldt.folder / "out" / "passes").glob("*/manifest.json"))
    before = [file.stat().st_ino for file in files]
    (files[0].parent / "000007.exr").unlink()
    _render(veldt, "blender")
    assert [file.stat().st_ino for file in files] == before
