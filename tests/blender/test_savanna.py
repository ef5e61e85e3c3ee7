"""The place of configs/savanna.json: its actors, their meetings, and that no actors overlap."""

import hashlib
import json

import numpy as np
import pytest

from resolved import resolve
from planner.bake.arrays import read
from planner.bake.tracks import bake_track
from planner.config import ROOT
from planner.groups.actors import poses, track
from planner.world import plan_world

TEN_MINUTES_S = np.arange(0.0, 600.0, 1.0)
POACHERS = ("northern_poachers", "western_poachers", "eastern_poachers")


def _planned(config: str, **changes):
    text = (ROOT / "configs" / config).read_text(encoding="utf-8")
    return plan_world(resolve(json.loads(text) | changes))


@pytest.fixture(scope="module", name="savanna")
def _savanna():
    return _planned("savanna.json")


@pytest.fixture(scope="module", name="walks")
def _walks(savanna):
    return {actor.name: track(actor, TEN_MINUTES_S) for actor in savanna.actors}


def _rectangle(actor):
    """Half length and half width of a standing body's box, and how far its middle is ahead of its origin."""
    points_m = actor.scale * actor.body.rest().points_m
    low, high = points_m.min(axis=0), points_m.max(axis=0)
    return 0.5 * (high - low)[:2], 0.5 * (high + low)[:2]


def _overlap(one, walk, other, others_walk):
    """Mask of moments (n,) at which the rectangles of two bodies overlap: no axis of either separates them."""
    (half_a, off_a), (half_b, off_b) = _rectangle(one), _rectangle(other)
    axes_a, axes_b = _axes(walk), _axes(others_walk)
    between = (others_walk.position_m[:, :2] + np.einsum("nik,i->nk", axes_b, off_b)) - (
        walk.position_m[:, :2] + np.einsum("nik,i->nk", axes_a, off_a)
    )
    overlap = np.ones(len(between), bool)
    for axes in (axes_a, axes_b):
        for k in (0, 1):
            reach = sum(
                np.abs(np.einsum("nik,nk->ni", own, axes[:, k])) @ half
                for own, half in ((axes_a, half_a), (axes_b, half_b))
            )
            overlap &= np.abs((between * axes[:, k]).sum(axis=1)) < reach
    return overlap


def _axes(walk):
    """Forward and left (n, 2, 2) of a body at each moment."""
    return np.stack([walk.heading, np.stack([-walk.heading[:, 1], walk.heading[:, 0]], axis=1)], axis=1)


def test_no_actors_overlap_in_ten_minutes(savanna, walks):
    near = 0
    for k, one in enumerate(savanna.actors):
        for other in savanna.actors[:k]:
            apart_m = np.linalg.norm(walks[one.name].position_m - walks[other.name].position_m, axis=1)
            if apart_m.min() < 15.0:
                near += 1
                assert not _overlap(one, walks[one.name], other, walks[other.name]).any(), (
                    one.name,
                    other.name,
                )
    assert near > 50  # pairs there were to look at


def test_poachers_come_near_elephants(savanna, walks):
    elephants = [walks[a.name].position_m for a in savanna.actors if a.species == "elephant"]
    for group in POACHERS:
        members = [walks[a.name].position_m for a in savanna.actors if a.group == group]
        assert len(members) == 3
        nearest_m = min(np.linalg.norm(a - b, axis=1).min() for a in members for b in elephants)
        assert nearest_m < 40.0


def test_all_actors_stay_on_the_terrain(savanna, walks):
    for actor in savanna.actors:
        x_m, y_m, z_m = walks[actor.name].position_m.T
        assert max(np.abs(x_m).max(), np.abs(y_m).max()) < 0.5 * savanna.terrain.size_m
        assert np.array_equal(z_m, savanna.terrain.height_m(x_m, y_m))


def test_only_swimmers_are_in_the_water(savanna, walks):
    for actor in savanna.actors:
        x_m, y_m, _ = walks[actor.name].position_m.T
        assert ((savanna.terrain.shore_m(x_m, y_m) < 0) == (actor.posture == "float")).all(), actor.name


def test_plants_keep_off_all_actors(savanna, walks):
    woody = [
        savanna.plantings[name].points_m[:, :2] for name in ("acacia", "hookthorn", "baobab", "rock", "log")
    ]
    points_m = np.concatenate(woody)
    for actor in savanna.actors:
        where_m = walks[actor.name].position_m[::5, :2]
        near = np.abs(points_m - where_m.mean(axis=0)).max(axis=1) < 400
        apart_m = np.linalg.norm(points_m[near][:, None] - where_m, axis=-1)
        assert apart_m.min() > _rectangle(actor)[0][1], actor.name


def test_nothing_is_planted_in_water_or_on_the_road(savanna):
    for name, planting in savanna.plantings.items():
        if name in ("bridge", "culvert"):  # to both sides of the road
            continue
        x_m, y_m, _ = planting.points_m.T
        assert savanna.terrain.shore_m(x_m, y_m).min() > 0
        assert savanna.terrain.road_m(x_m, y_m).min() > 0


def test_the_savanna_has_all_it_should(savanna):
    species = {actor.species for actor in savanna.actors}
    assert species == {
        "crocodile", "elephant", "giraffe", "hippopotamus", "human", "impala", "lion", "lorry", "pickup", "rhinoceros",
        "zebra",
    }  # fmt: skip
    assert len(savanna.actors) > 60
    assert sum(len(planting.scale) for planting in savanna.plantings.values()) > 60_000


def test_people_walk_as_people_do(savanna):
    speeds = {actor.schedule.mean_m_s for actor in savanna.actors if actor.species == "human"}
    assert len(speeds) == 3 and min(speeds) >= 1.2 and max(speeds) <= 1.6


def test_a_track_has_every_actor_as_it_is_alone_at_one_moment(savanna, tmp_path):
    """All species, variants and behaviours."""
    flight = savanna.flight(savanna.config["clips"][0] | {"frames": 7})
    bake_track(savanna, "clip", flight, tmp_path / "clip", everyone=True)
    _, arrays = read(tmp_path / "clip")
    baked = iter(arrays["bones"])
    for k, actor in enumerate(savanna.actors):
        for frame in range(7):
            moment_s = flight.time_s[frame : frame + 1]
            body, walk = poses(actor, moment_s), track(actor, moment_s)
            assert np.array_equal(arrays["actor_position_m"][k, frame], walk.position_m[0])
            assert arrays["actor_heading_rad"][k, frame] == walk.heading_rad[0]
            for bone, position_m, rotation in zip(actor.body.bones, body.position_m[0], body.rotation[0]):
                if len(bone.mesh.triangles) > 0:
                    expected = np.column_stack([body.scale[0] * rotation, position_m])
                    assert np.array_equal(next(baked), expected.astype("<f4"))
    assert next(baked, None) is None


def _hash(world) -> str:
    """Of the ground, of where plants are and how they are turned, and of bodies at two moments."""
    digest = hashlib.sha256(world.terrain.heights_m.tobytes())
    for planting in world.plantings.values():
        for part in (planting.points_m, planting.yaw_rad, planting.scale, planting.variant):
            digest.update(part.tobytes())
    for actor in world.actors:
        body = poses(actor, np.array([3.0, 400.0]))
        digest.update(body.position_m.tobytes() + body.rotation.tobytes())
    return digest.hexdigest()


def test_a_seed_is_a_place():
    first, again, other = (_hash(_planned("demo.json", seed=seed)) for seed in (4, 4, 5))
    assert first == again != other
