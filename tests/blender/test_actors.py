"""Positions and poses of actors."""

import numpy as np
import pytest

from scenes import tiny
from planner.groups.actors import poses, track
from planner.geometry.components import facing
from planner.groups.schedules import StopAndGo
from planner.world import plan_world


def _grazing(config: dict) -> None:
    config["scene"]["groups"][2]["behaviour"] = "graze"


def test_members_are_named_numbered_and_differ(world):
    assert [actor.name for actor in world.actors] == [
        "people_1", "people_2", "herd_1", "herd_2", "zebras_1", "zebras_2",
    ]  # fmt: skip
    assert [actor.index for actor in world.actors] == [101, 102, 103, 104, 105, 106]
    assert len({actor.scale for actor in world.actors}) == 6
    assert len({actor.phase for actor in world.actors}) == 6


def test_a_member_is_the_same_whatever_other_groups_there_are(world):
    alone = plan_world(tiny(lambda c: c["scene"]["groups"].__delitem__(0)))
    assert alone.actors[0].scale == world.actors[2].scale
    assert alone.actors[0].phase == world.actors[2].phase


def test_members_are_on_the_ground_and_keep_their_places(world):
    time_s = np.linspace(0, 300, 401)
    for actor in world.actors:
        walk = track(actor, time_s)
        x, y, z = walk.position_m.T
        assert np.array_equal(z, world.terrain.height_m(x, y))
        on_loop, _ = actor.route.at(actor.start_m + actor.walking_m_s * time_s)
        off = np.linalg.norm(walk.position_m[:, :2] - on_loop, axis=1)
        assert off == pytest.approx(abs(actor.lateral_m))
        assert abs(actor.lateral_m) <= (1.0 if actor.group == "people" else 0.0)


def test_heading_is_the_direction_of_travel(world):
    time_s = np.arange(0, 60, 0.01)
    walk = track(world.actors[2], time_s)
    step = np.diff(walk.position_m[:, :2], axis=0)
    along = np.arctan2(step[:, 1], step[:, 0])
    turn = np.angle(np.exp(1j * (walk.heading_rad[:-1] - along)))
    # 1.2 cm steps on a loop of about 25 m radius turn by 5e-4 rad; its tightest spots are a few times tighter.
    assert np.abs(turn).max() < 5e-3


def test_a_given_beginning_is_the_first_members(world):
    assert [world.actors[2].start_m, world.actors[4].start_m] == [16, 28]
    assert world.actors[3].start_m < 16 and world.actors[5].start_m < 28


@pytest.mark.parametrize(
    "change",
    [
        lambda config: None,
        _grazing,
    ],
    ids=["walking", "grazing"],
)
def test_boxes_hold_bodies_at_all_times(change):
    """Checked at moments that were not used to measure the boxes."""
    world = plan_world(tiny(change))
    for actor in world.actors:
        time_s = 0.37 + np.arange(0, 200, 3.1)
        body, walk = poses(actor, time_s), track(actor, time_s)
        low, high = actor.bounds_m
        for k in range(len(time_s)):
            local = (body.points_m(actor.body, k) - walk.position_m[k]) @ facing(walk.heading[k])
            assert (local > low).all() and (local < high).all()


def test_boxes_are_not_much_larger_than_bodies(world):
    for actor in world.actors:
        drawn_m = actor.scale * np.ptp(actor.body.rest().points_m, axis=0)
        # Arms, legs and tails swing out of the drawing, most of all those of people, and hills raise one end.
        assert (np.ptp(actor.bounds_m, axis=0) < drawn_m + 0.45 * drawn_m.max()).all()


def test_feet_do_not_move_while_an_animal_stands():
    """While a grazer feeds, its legs do not move; when it walks on, feet on the ground stay in place."""
    actor = plan_world(tiny(_grazing)).actors[4]
    assert isinstance(actor.schedule, StopAndGo)
    time_s = np.arange(0, 120, 0.02)
    doing, body = actor.schedule.at(time_s), poses(actor, time_s)
    rests = np.diff(doing.walked_m) == 0
    assert 0.5 < rests.mean() < 0.95
    for leg in actor.body.legs:
        foot, toe_m = leg.bones[2], leg.toe_m - actor.body.bones[leg.bones[2]].joint_m
        toes_m = body.position_m[:, foot] + body.scale[:, None] * (body.rotation[:, foot] @ toe_m)
        assert np.array_equal(toes_m[1:][rests], toes_m[:-1][rests])
        above = toes_m[:, 2] - actor.terrain.height_m(*toes_m[:, :2].T)
        assert above.min() > -1e-9
        assert np.abs(above[1:][rests]).max() < 1e-9
        # In the air a foot is at most 1.5 / (1 - stance) times as fast as the body, which is at most walking_m_s fast.
        fastest = 1.5 / (1 - actor.body.stance) * actor.walking_m_s
        assert np.linalg.norm(np.diff(toes_m, axis=0), axis=1).max() / 0.02 < 1.5 * fastest


def test_any_moment_can_be_made_alone(world):
    actor = world.actors[4]
    time_s = np.linspace(0, 60, 61)
    among, alone = poses(actor, time_s), poses(actor, time_s[17:18])
    assert np.array_equal(among.position_m[17], alone.position_m[0])
    assert np.array_equal(among.rotation[17], alone.rotation[0])
