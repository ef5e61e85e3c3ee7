"""Which frames of a flight show an actor: found by planes and heights, checked box by box."""

import numpy as np
import pytest

from scenes import tiny
from planner.camera import project
from planner.groups.actors import track
from planner.sightings import box_corners_m, sightings
from planner.world import plan_world


def _with(flight: dict, road_m: float):
    def change(config: dict) -> None:
        config["scene"]["terrain"].update(relief_m=12, road={"width_m": road_m, "fork": True})
        config["clips"][0].update(frames=900, frame_rate_hz=9, flight=flight)

    return tiny(change)


@pytest.mark.parametrize("road_m", [0, 3])
@pytest.mark.parametrize(
    "flight",
    [
        {"pattern": "zigzag", "area_m": [-50, -50, 50, 50], "altitude_m": 40, "look_angle_deg": 60},
        {"pattern": "follow", "target": "zebras", "altitude_m": 20, "look_angle_deg": 40},
    ],
    ids=["zigzag", "follow"],
)
def test_they_are_the_frames_in_which_a_box_overlaps_the_picture(flight, road_m):
    world = plan_world(_with(flight, road_m))
    flown = world.flight(world.config["clips"][0])
    size_px = np.array([world.intrinsics.width_px, world.intrinsics.height_px])
    seen = np.zeros(len(flown.time_s), bool)
    alone = []
    for actor in world.actors:
        corners_m = box_corners_m(actor, track(actor, flown.time_s))
        corners_px, depth_m = project(world.intrinsics, flown.camera_to_world, corners_m)
        overlap = (corners_px.min(axis=1) < size_px) & (corners_px.max(axis=1) > 0)
        alone.append(overlap.all(axis=1) & (depth_m > 0).all(axis=1))
        seen |= alone[-1]
        assert np.array_equal(sightings(world.intrinsics, flown, [actor]), alone[-1])
    assert np.array_equal(sightings(world.intrinsics, flown, world.actors), seen)
    assert any(mask.any() and not mask.all() for mask in alone)
