"""Balls that may be in the picture."""

import numpy as np
import pytest

from planner.camera import Intrinsics, centred, look, project
from planner.frusta import frusta_of
from planner.noise import stream

LENS = centred(640, 512, 765.0)
OFF_CENTRE = Intrinsics(640, 512, (765.0, 820.0), (250.0, 300.0))
BALLS = 20_000


@pytest.mark.parametrize("height_m, depression_deg", [(61, 90), (122, 45), (15, 30), (30, 5)])
@pytest.mark.parametrize("radius_m", [0.5, 8.0])
@pytest.mark.parametrize("lens", [LENS, OFF_CENTRE])
@pytest.mark.parametrize("range_m", [0.0, 12.0])
def test_a_ball_of_which_anything_is_in_the_picture_may_be_there(
    height_m, depression_deg, radius_m, lens, range_m
):
    pose = look(np.array([[30.0, -7.0, height_m]]), np.array([[0.6, 0.8]]), np.radians([depression_deg]))
    poses = np.repeat(pose, BALLS, axis=0)
    draw = stream(3, "balls")
    centres_m = draw.uniform([-200, -200, -5], [300, 300, 60], (BALLS, 3))
    aside = draw.normal(size=(BALLS, 3))
    points_m = centres_m + radius_m * aside / np.linalg.norm(aside, axis=1, keepdims=True)
    place_px, depth_m = project(lens, pose[0], points_m)
    seen = (depth_m > 0) & ((place_px > 0) & (place_px < [640, 512])).all(axis=1)
    x_m, y_m, z_m = centres_m.T
    low_m = z_m - range_m * draw.uniform(size=BALLS)
    may_be = frusta_of(lens, poses).may_show(x_m, y_m, (low_m, low_m + range_m), radius_m)
    assert seen.sum() > 10 and may_be[seen].all()
    assert may_be.mean() < 0.5


def test_some_of_the_poses_see_what_they_see_among_all():
    middles_m = stream(4, "poses").uniform([-50, -50, 40], [50, 50, 80], (100, 3))
    poses = look(middles_m, np.tile([0.6, 0.8], (100, 1)), np.full(100, np.radians(50)))
    x_m, y_m = stream(5, "balls").uniform(-80, 80, (2, 100))
    frusta, some = frusta_of(LENS, poses), np.array([3, 50, 51, 99])
    among_all = frusta.may_show(x_m, y_m, (0.0, 0.0), 2.0)[some]
    assert np.array_equal(frusta.at(some).may_show(x_m[some], y_m[some], (0.0, 0.0), 2.0), among_all)


def test_many_balls_are_where_each_of_them_is():
    poses = look(np.tile([0.0, 0.0, 60.0], (50, 1)), np.tile([0.6, 0.8], (50, 1)), np.linspace(0.5, 1.5, 50))
    x_m, y_m, z_m = stream(6, "balls").uniform(-80, 80, (3, 20, 50))
    radii_m, frusta = np.linspace(0.5, 9.0, 20), frusta_of(LENS, poses)
    together = frusta.may_show(x_m, y_m, (z_m - 1.0, z_m), radii_m[:, None])
    alone = [
        frusta.may_show(x_m[k], y_m[k], (z_m[k] - 1.0, z_m[k]), radius_m)
        for k, radius_m in enumerate(radii_m)
    ]
    assert np.array_equal(together, alone) and 0.05 < together.mean() < 0.95
