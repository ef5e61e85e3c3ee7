"""Who walks where."""

import numpy as np
import pytest

from scenes import tiny
from veldt.actors import track
from veldt.world import plan_world


def test_members_are_named_numbered_and_differ(world):
    assert [actor.name for actor in world.actors] == [
        "people_1", "people_2", "herd_1", "herd_2", "zebras_1", "zebras_2",
    ]  # fmt: skip
    assert [actor.index for actor in world.actors] == [101, 102, 103, 104, 105, 106]
    assert len({actor.scale for actor in world.actors}) == 6


def test_a_member_is_the_same_whatever_other_groups_there_are(world):
    alone = plan_world(tiny(lambda c: c["scene"]["groups"].__delitem__(0)))
    assert alone.actors[0].scale == world.actors[2].scale


def test_feet_are_on_the_ground_and_members_keep_their_places(world):
    time_s = np.linspace(0, 300, 401)
    for actor in world.actors:
        walk = track(actor, world.terrain, time_s)
        x, y, z = walk.position_m.T
        assert np.array_equal(z, world.terrain.height_m(x, y))
        on_loop, _ = actor.loop.at(actor.start_m + actor.speed_m_s * time_s)
        off = np.linalg.norm(walk.position_m[:, :2] - on_loop, axis=1)
        assert off == pytest.approx(abs(actor.lateral_m))
        assert abs(actor.lateral_m) <= (1.0 if actor.group == "people" else 0.0)


def test_heading_is_the_direction_of_travel(world):
    time_s = np.arange(0, 60, 0.01)
    walk = track(world.actors[2], world.terrain, time_s)
    step = np.diff(walk.position_m[:, :2], axis=0)
    along = np.arctan2(step[:, 1], step[:, 0])
    turn = np.angle(np.exp(1j * (walk.heading_rad[:-1] - along)))
    # 1.2 cm steps on a loop of about 25 m radius turn by 5e-4 rad; its tightest spots are a few times tighter.
    assert np.abs(turn).max() < 5e-3


def test_time_zero_and_spacing(world):
    starts = [actor.start_m for actor in world.actors]
    assert starts == [0, -3, 16, 8, 28, 24]
