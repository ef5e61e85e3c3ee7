"""Circles that contain everything a camera sees."""

import numpy as np
import pytest

from planner.camera import Intrinsics, centred, look, project
from planner.noise import stream
from planner.plants.views import circles_seen, held_circles

LENS = centred(640, 512, 765.0)
OFF_CENTRE = Intrinsics(640, 512, (765.0, 820.0), (250.0, 300.0))


def _pose(height_m, depression_deg):
    return look(np.array([[30.0, -7.0, height_m]]), np.array([[0.6, 0.8]]), np.radians([depression_deg]))


@pytest.mark.parametrize("lens", [LENS, OFF_CENTRE])
@pytest.mark.parametrize("height_m, depression_deg", [(61, 90), (61, 45), (122, 60), (15, 30), (15, 80)])
def test_all_that_is_seen_between_two_heights_is_in_the_circle(height_m, depression_deg, lens):
    pose = _pose(height_m, depression_deg)
    (centre_m,), (radius_m,) = circles_seen(lens, pose, -5.0, 20.0)
    points_m = stream(2, "points").uniform([-500, -500, -5], [500, 500, 20], (200_000, 3))
    place_px, depth_m = project(lens, pose[0], points_m)
    seen = (depth_m > 0) & ((place_px > 0) & (place_px < [640, 512])).all(axis=1)
    distance_m = np.linalg.norm(points_m[:, :2] - centre_m, axis=1)
    assert seen.sum() > 10 and distance_m[seen].max() < radius_m
    # No idle circle: straight down it is the picture's diagonal, and it grows the flatter the camera looks.
    reach_m = (height_m + 5.0) / np.sin(np.radians(depression_deg)) ** 2
    assert radius_m < 1.6 * reach_m


@pytest.mark.parametrize("depression_deg", [0, 10, 18])
def test_a_view_of_the_horizon_has_no_end(depression_deg):
    (centre_m,), (radius_m,) = circles_seen(LENS, _pose(61, depression_deg), -5.0, 20.0)
    assert radius_m == np.inf and np.isfinite(centre_m).all()


def test_held_circles_hold_and_stay():
    along_m = np.arange(200.0)
    centres_m, radii_m = np.stack([along_m, 0.1 * along_m], axis=1), 60.0 + 5.0 * np.sin(along_m)
    held_m, held_radii_m = held_circles(centres_m, radii_m)
    assert (np.linalg.norm(held_m - centres_m, axis=1) + radii_m <= held_radii_m + 1e-9).all()
    assert (held_radii_m < 1.5 * radii_m).all()
    assert 10 < len(np.unique(held_m, axis=0)) < 30


def test_held_circles_of_endless_views_are_endless():
    centres_m, radii_m = np.zeros((4, 2)), np.array([50.0, 1e6, 1e6, 50.0])
    held_m, held_radii_m = held_circles(centres_m, radii_m)
    assert held_radii_m.tolist() == radii_m.tolist() and np.isfinite(held_m).all()
