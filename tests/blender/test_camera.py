"""Projection and poses."""

import numpy as np
import pytest

from scenes import tiny
from planner.camera import (
    Intrinsics,
    centred,
    edge_tangents,
    intrinsics_of,
    lens_shift,
    look,
    pixel_aspect,
    project,
    widened,
)

LENS = centred(640, 512, 1000.0)
CALIBRATED = Intrinsics(640, 512, (800.0, 1000.0), (300.0, 272.0))


def test_intrinsics_are_those_of_the_config():
    assert intrinsics_of(tiny()["camera"]) == Intrinsics(96, 80, (130, 130), (48, 40))


def test_points_are_projected_with_both_focal_lengths_about_the_principal_point():
    pixels, _ = project(CALIBRATED, np.eye(4), np.array([[0.0, 0, 8], [1, 2, 8], [-1, -2, 8]]))
    assert pixels.tolist() == [[300, 272], [400, 522], [200, 22]]


def test_edges_are_where_points_on_them_project_to():
    (left, top), (right, bottom) = edge_tangents(CALIBRATED)
    pixels, _ = project(CALIBRATED, np.eye(4), np.array([[-left, -top, 1], [right, bottom, 1]]))
    assert pixels == pytest.approx(np.array([[0, 0], [640, 512]]))


def test_blender_shifts_the_picture_in_widths_of_it():
    """20 px right of the axis of 640; along y 16 px above it, each 0.8 times as high as wide."""
    assert lens_shift(CALIBRATED) == pytest.approx((20 / 640, 16 * 0.8 / 640))
    assert pixel_aspect(CALIBRATED) == (1.25, 1.0)
    assert pixel_aspect(Intrinsics(640, 512, (1000.0, 800.0), (320.0, 256.0))) == (1.0, 1.25)


def test_a_centred_camera_with_square_pixels_is_blenders_own():
    assert (lens_shift(LENS), pixel_aspect(LENS)) == ((0, 0), (1, 1))


def test_straight_down_the_flight_direction_is_up_in_the_picture():
    pose = look(np.array([[10.0, 20.0, 100.0]]), np.array([[0.0, 1.0]]), np.array([np.pi / 2]))[0]
    points = np.array([[10, 20, 0], [10, 30, 0], [20, 20, 0]], float)
    pixels, depth = project(LENS, pose, points)
    assert pixels == pytest.approx(np.array([[320, 256], [320, 156], [420, 256]]))
    assert depth == pytest.approx([100, 100, 100])


@pytest.mark.parametrize("depression_deg", [1, 30, 45, 89, 90])
def test_poses_are_right_handed_rotations_without_roll(depression_deg):
    angle = np.linspace(0, 6, 7)
    bearing = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    poses = look(np.zeros((7, 3)), bearing, np.full(7, np.radians(depression_deg)))
    rotation = poses[:, :3, :3]
    assert rotation.transpose(0, 2, 1) @ rotation == pytest.approx(np.tile(np.eye(3), (7, 1, 1)))
    assert np.linalg.det(rotation) == pytest.approx(np.ones(7))
    assert not rotation[:, 2, 0].any()  # the picture's rows are level
    assert rotation[:, 2, 2] == pytest.approx(-np.sin(np.radians(depression_deg)) * np.ones(7))


def test_points_behind_the_camera_have_no_positive_depth():
    pose = look(np.zeros((1, 3)), np.array([[1.0, 0.0]]), np.array([0.0]))[0]
    _, depth = project(LENS, pose, np.array([[-5.0, 0, 0], [5.0, 0, 0]]))
    assert depth == pytest.approx([-5, 5])


def test_a_widened_camera_sees_the_same_with_more_around_it():
    lens = centred(641, 512, 1000.0)
    wide = widened(lens, 7)
    assert (wide.width_px, wide.height_px) == (655, 526)
    point = np.array([[3.0, -2.0, 50.0]])
    shift = project(wide, np.eye(4), point)[0] - project(lens, np.eye(4), point)[0]
    assert shift == pytest.approx(np.array([[7, 7]]))
    off = widened(CALIBRATED, 7)
    assert off == Intrinsics(654, 526, (800, 1000), (307, 279))
