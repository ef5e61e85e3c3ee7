"""`veldt.World`: captures are the program's frames, wherever the camera is."""

import numpy as np
import pytest

from configs import tiny
from veldt import ConfigError, World, open_dataset, plan

SETTINGS = ["render.engine=embree", "render.posed_actors=all"]
PHYSICAL = [*SETTINGS, "sensor.preset=boson_640_14mm", "camera.width_px=96", "camera.height_px=80"]


def _planned(veldt, name, settings):
    """A plan, and the dataset that the program makes of it."""
    plan(tiny(), veldt.folder / f"{name}_plan", settings=settings)
    done = veldt("generate", "--plan", f"{name}_plan", "--out", name, "--quiet")
    assert (done.code, done.err) == (0, "")
    return veldt.folder / f"{name}_plan", open_dataset(veldt.folder / name)


@pytest.fixture(name="physical", scope="module")
def _physical(veldt):
    return _planned(veldt, "physical_world", PHYSICAL)


def _check_same(world, clip):
    for time_s, pose, frame in zip(world.flight_s, world.flight_poses, clip, strict=True):
        capture = world.capture(pose, time_s)
        assert np.array_equal(capture.ir16, frame.ir16())
        assert np.array_equal(capture.ir8, frame.ir8())
        for label, in_file in zip(capture.labels, frame.labels, strict=True):
            assert label.values.items() <= in_file.values.items()


def test_the_planned_flight_gives_the_programs_frames_to_the_bit(physical):
    folder, dataset = physical
    for clip in dataset:
        _check_same(World(folder, clip.id, roam=False), clip)


def test_with_all_of_the_ground_a_few_pixels_round_to_the_next_count(physical):
    folder, dataset = physical
    world = World(folder, "down")
    for time_s, pose, frame in zip(world.flight_s, world.flight_poses, dataset["down"], strict=True):
        off = world.capture(pose, time_s).ir16.astype(int) - frame.ir16()
        assert np.abs(off).max() <= 1
        assert np.count_nonzero(off) < 0.01 * off.size


def test_so_does_the_published_model(veldt):
    folder, dataset = _planned(veldt, "published_world", SETTINGS)
    _check_same(World(folder, "down"), dataset["down"])


def test_the_camera_sees_who_is_where_it_looks(physical):
    world = World(physical[0], "down")
    middle_s = world.flight_s[4]
    first = world.capture(world.flight_poses[4], middle_s)
    track, person = next((k, one) for k, one in first.actors.items() if one.category == "human")
    above = np.array([[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 30], [0, 0, 0, 1]], float)
    above[:3, 3] += person.position_m
    capture = world.capture(above, world.flight_s[5])
    label = next(label for label in capture.labels if label.track_id == track)
    x, y, width, height = label.box_px
    assert abs(x + width / 2 - world.camera.cx_px) < 8
    assert abs(y + height / 2 - world.camera.cy_px) < 8
    assert 27 < label.values["range_m"] < 30
    assert len(np.unique(capture.object_index[label.mask()])) == 1


def test_actors_move_between_planned_frames(physical):
    world = World(physical[0], "down", frame_rate_hz=90)
    places = []
    for k in range(11):
        capture = world.capture(world.flight_poses[0], world.flight_s[0] + k / 90)
        places.append([actor.position_m for actor in capture.actors.values()])
    steps_m = np.linalg.norm(np.diff(np.array(places), axis=0), axis=2)
    assert steps_m.max() > 0.005
    assert np.ptp(steps_m[:9], axis=0).max() < 0.01
    exact = World(physical[0], "down")
    exact.capture(exact.flight_poses[0], exact.flight_s[0])
    second = exact.capture(exact.flight_poses[0], exact.flight_s[1])
    assert np.array_equal(places[10], [actor.position_m for actor in second.actors.values()])


def test_faults_change_nothing(physical):
    folder, dataset = physical
    world = World(folder, "down", roam=False)
    world.capture(world.flight_poses[0], world.flight_s[0])
    with pytest.raises(
        ConfigError, match=r"time_s = 0 s; expected from 0.1111\d* s to .* of 1/9 s after 0 s"
    ):
        world.capture(world.flight_poses[0], 0)
    with pytest.raises(ConfigError, match="time_s = 0.15 s"):
        world.capture(world.flight_poses[0], 0.15)
    with pytest.raises(ConfigError, match="time_s = 99 s"):
        world.capture(world.flight_poses[0], 99)
    with pytest.raises(ConfigError, match="camera_to_world = .*; expected a rotation and a place"):
        world.capture(2 * world.flight_poses[1], world.flight_s[1])
    with pytest.raises(ConfigError, match="camera_to_world = 12 numbers; expected 4 x 4"):
        world.capture(world.flight_poses[1][:3], world.flight_s[1])
    capture = world.capture(world.flight_poses[1], world.flight_s[1])
    assert np.array_equal(capture.ir16, dataset["down"][1].ir16())


def test_other_plans_are_refused(tmp_path, physical):
    plan(tiny(), tmp_path / "seen", settings=SETTINGS[:1])
    with pytest.raises(ConfigError, match='render.posed_actors = "seen"; expected "all"'):
        World(tmp_path / "seen", "down")
    with pytest.raises(ConfigError, match='"up"'):
        World(physical[0], "up")
