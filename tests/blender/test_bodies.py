"""Bodies: true size, closed surfaces, left and right alike, feet that do not slide."""

import numpy as np
import pytest

from veldt import assets
from veldt.bodies import build_body
from veldt.gait import STANCE, swing_rad
from veldt.shapes import ellipsoid, tube

SPECIES = assets.names("species")

# Height and length at rest in m, from the sources the species files name: people by height, animals by the top of
# the body and from head to tail. What is drawn may differ by a tenth: the bodies are simple.
SIZES_M = {
    "human": (1.75, None),
    "elephant": (2.98, None),
    "zebra": (None, 2.4),
}


@pytest.mark.parametrize("species", SPECIES)
def test_files_say_what_they_are_and_where_their_numbers_come_from(species):
    data = assets.load("species", species)
    assert data["category"] and data["material"] and all(data["source"].values())
    low, high = data["size_range"]
    assert 0.5 < low <= 1.0 <= high < 1.5


@pytest.mark.parametrize("species", SIZES_M)
def test_bodies_have_their_true_size(species):
    points = build_body(species).posed(0.0).points_m
    length, _, height = np.ptp(points, axis=0)
    for measured, expected in zip((height, length), SIZES_M[species]):
        assert expected is None or measured == pytest.approx(expected, rel=0.1)


@pytest.mark.parametrize("species", SPECIES)
def test_bodies_stand_on_the_ground_over_their_origin(species):
    body = build_body(species)
    low, high = body.bounds_m()
    assert low[1] == pytest.approx(-high[1])
    # A rigid foot is thrust into the ground by what it is longer than its leg; deeper than a tenth of a leg
    # would look wrong.
    assert -0.1 * body.leg_m < low[2] < 0.03
    assert abs(low[0] + high[0]) < 0.5 * (high[0] - low[0])


def _is_closed_and_faces_outward(mesh):
    edges = mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    forth, back = {tuple(e) for e in edges}, {tuple(e[::-1]) for e in edges}
    a, b, c = np.moveaxis(mesh.points_m[mesh.triangles], 1, 0)
    volume = (a * np.cross(b, c)).sum() / 6
    return forth == back and len(forth) == len(edges) and volume > 0


@pytest.mark.parametrize("species", SPECIES)
def test_surfaces_are_closed_and_face_outward(species):
    body = build_body(species)
    assert _is_closed_and_faces_outward(body.trunk)
    assert all(_is_closed_and_faces_outward(limb.mesh) for limb in body.limbs)


def test_an_ellipsoid_has_its_radii():
    mesh = ellipsoid([1, 2, 3], [3, 2, 1], rings=60, sides=120)
    # The first ring is half a ring's angle from the pole, the rings lie half an angle off the equator: 1 - cos.
    assert np.ptp(mesh.points_m, axis=0) == pytest.approx([6, 4, 2], rel=1 - np.cos(np.pi / 60))


def test_a_tube_keeps_to_its_rings():
    mesh = tube(np.array([[0, 0, 0, 1, 2], [5, 0, 0, 1, 2]]), sides=40, roundness=0.5)
    low, high = mesh.points_m.min(axis=0), mesh.points_m.max(axis=0)
    # Caps stand out by half the smaller half axis, times the sine of the last cap ring's 89 degrees.
    assert (low[0], high[0]) == pytest.approx((-0.5, 5.5), abs=1e-4)
    assert (low[1:], high[1:]) == (pytest.approx([-1, -2]), pytest.approx([1, 2]))


def test_a_foot_on_the_ground_keeps_up_with_it():
    stride_m, leg_m = 1.4, 0.9
    phase = np.linspace(0, STANCE, 50, endpoint=False)
    foot_m = stride_m * phase - leg_m * np.sin(swing_rad(phase, stride_m, leg_m))
    assert np.ptp(foot_m) < 1e-12


@pytest.mark.parametrize("species", SPECIES)
def test_left_and_right_legs_take_turns(species):
    limbs = build_body(species).limbs
    assert all(abs(left.phase - right.phase) == 0.5 for left, right in zip(limbs[::2], limbs[1::2]))


def test_legs_swing_without_a_jump_and_stay_under_the_body():
    phase = np.linspace(0, 2, 2001)
    angle = swing_rad(phase, 1.4, 0.9)
    assert np.abs(np.diff(angle)).max() < 0.01
    assert np.abs(swing_rad(phase, 50.0, 0.9)).max() <= np.arcsin(0.9)
