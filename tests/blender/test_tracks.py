"""Tracks of clips: who is posed in them, and that they do not depend on how many frames are computed together."""

import pytest

from scenes import tiny
from planner.bake import tracks
from planner.bake.arrays import read
from planner.camera import project
from planner.groups.actors import track
from planner.sightings import box_corners_m
from planner.world import World, plan_world


def _busy(config: dict) -> None:
    """Groups that walk, graze, drink, lie and float, and a vehicle on a road."""
    config["scene"]["terrain"].update(size_m=400, road={"width_m": 3, "fork": True})
    groups = config["scene"]["groups"]
    groups[2] |= {"behaviour": "graze", "count": 5}
    groups += [
        {"name": "pickup", "species": "pickup", "path": "road"},
        {"name": "drinkers", "species": "zebra", "place": "shore", "count": 3, "behaviour": "drink"},
        {"name": "lions", "species": "lion", "place": [45, 30], "count": 2, "behaviour": "lie"},
        {"name": "swimmers", "species": "crocodile", "place": "water", "behaviour": "float"},
    ]
    config["clips"][0].update(frames=40, frame_rate_hz=2)


@pytest.fixture(scope="module", name="busy")
def _planned() -> World:
    return plan_world(tiny(_busy))


def _baked(world: World, path, everyone: bool = False) -> bytes:
    clip = world.config["clips"][0]
    tracks.bake_track(world, clip["id"], world.flight(clip), path, everyone)
    return path.with_suffix(".bin").read_bytes()


@pytest.mark.parametrize("everyone", [False, True])
@pytest.mark.parametrize("places, poses", [(1, 1), (37, 5), (500, 64)])
def test_a_track_is_the_same_however_many_moments_are_computed_together(
    busy, tmp_path, monkeypatch, everyone, places, poses
):
    whole = _baked(busy, tmp_path / "whole", everyone)
    monkeypatch.setattr(tracks, "_PLACES_AT_ONCE", places)
    monkeypatch.setattr(tracks, "_POSES_AT_ONCE", poses)
    assert _baked(busy, tmp_path / "parts", everyone) == whole


def test_actors_are_posed_in_every_frame_that_shows_them_and_not_in_all(busy, tmp_path):
    _baked(busy, tmp_path / "track")
    header, arrays = read(tmp_path / "track")
    posed, lens = arrays["posed"] != 0, busy.view_intrinsics
    assert header["frames"] == 40 and posed.shape == (len(busy.actors), 40)
    for actor, frames in zip(busy.actors, posed):
        corners_m = box_corners_m(actor, track(actor, arrays["time_s"]))
        corners_px, depth_m = project(lens, arrays["camera_to_world"], corners_m)
        inside = (corners_px > 0) & (corners_px < [lens.width_px, lens.height_px])
        assert frames[(inside.all(axis=-1) & (depth_m > 0)).any(axis=1)].all()
    assert posed.any() and not posed.all()


def test_a_clip_may_have_a_camera_of_its_own(busy, tmp_path):
    clip = busy.config["clips"][0]
    narrow = busy.config["camera"] | {"fx_px": 400.0, "fy_px": 400.0}
    tracks.bake_track(busy, clip["id"], busy.flight(clip), tmp_path / "narrow", camera=narrow)
    _baked(busy, tmp_path / "usual")
    header, arrays = read(tmp_path / "narrow")
    usual_header, usual = read(tmp_path / "usual")
    assert header["camera"] == narrow and "camera" not in usual_header
    assert 0 < arrays["posed"].sum() < usual["posed"].sum()
    assert busy.camera(clip | {"camera": narrow}).focal_px == (400.0, 400.0)


def test_a_place_without_actors_has_tracks(tmp_path):
    def empty(config: dict) -> None:
        config["scene"]["groups"] = []
        del config["clips"][1:]  # which follow a group

    _baked(plan_world(tiny(empty)), tmp_path / "track")
    _, arrays = read(tmp_path / "track")
    assert arrays["bones"].shape == (0, 3, 4) and arrays["actor_position_m"].shape == (0, 3, 3)
