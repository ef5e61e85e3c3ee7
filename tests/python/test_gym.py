"""`veldt.gym`: an environment as Gymnasium wants it."""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from configs import tiny
from veldt import plan
from veldt.gym import FlightEnv


@pytest.fixture(name="place", scope="module")
def _place(tmp_path_factory):
    folder = tmp_path_factory.mktemp("gym") / "plan"
    plan(tiny(), folder, settings=["render.engine=embree", "render.posed_actors=all"])
    return folder


@pytest.mark.filterwarnings("error")
def test_gymnasiums_checker_passes(place):
    made = gymnasium.make("Veldt/Flight-v0", plan_folder=place, clip="down", render_mode="rgb_array")
    assert isinstance(made.unwrapped, FlightEnv)
    check_env(made.unwrapped)


def test_an_episode_begins_with_the_planned_pose_and_lasts_as_long_as_the_plan(place):
    env = FlightEnv(place, "side")
    observation, info = env.reset(seed=5)
    assert np.allclose(info["camera_to_world"], env.world.flight_poses[0], atol=1e-9)
    assert np.array_equal(observation, info["capture"].ir8)
    ends = [env.step(np.zeros(5, np.float32))[2:4] for _ in range(7)]
    assert ends == [(False, False)] * 6 + [(False, True)]


def test_actions_move_the_camera(place):
    env = FlightEnv(place, "side", max_speed_m_s=9, max_turn_rad_s=0.9)
    _, info = env.reset()
    before = info["camera_to_world"]
    ahead = np.array([before[0, 2], before[1, 2], 0]) / np.hypot(*before[:2, 2])
    *_, info = env.step(np.array([1, 0, 0, 0, 0], np.float32))
    assert np.allclose(info["camera_to_world"][:3, 3] - before[:3, 3], ahead, atol=1e-6)
    before = info["camera_to_world"]
    *_, info = env.step(np.array([0, 1, 0.5, 0, 0], np.float32))
    moved_m = info["camera_to_world"][:3, 3] - before[:3, 3]
    assert np.allclose(moved_m, before[:3, 0] + [0, 0, 0.5], atol=1e-6)
    before = info["camera_to_world"]
    *_, info = env.step(np.array([0, 0, 0, 1, 1], np.float32))
    turned = info["camera_to_world"][:3, 2]
    assert turned @ before[:3, 0] < -0.05
    assert np.arcsin(-turned[2]) - np.arcsin(-before[2, 2]) == pytest.approx(0.1, abs=1e-6)


def test_the_reward_is_the_share_that_is_seen(place):
    env = FlightEnv(place, "down", follow="human")
    env.reset()
    _, reward, *_, info = env.step(np.zeros(5, np.float32))
    capture = info["capture"]
    people = {track for track, actor in capture.actors.items() if actor.category == "human"}
    seen = {label.track_id for label in capture.labels} & people
    assert (len(people), reward) == (3, len(seen) / 3)
    empty = FlightEnv(place, "down", follow="rhinoceros")
    empty.reset()
    assert empty.step(np.zeros(5, np.float32))[1] == 0
