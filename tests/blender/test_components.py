"""Vectors and rotations with their components first."""

import numpy as np
import pytest

from planner.geometry import components
from planner.noise import stream

COUNT = 50
VECTORS, OTHERS, ANGLES = stream(1, "components").uniform(-2.0, 2.0, (3, 3, COUNT))


def _one_by_one(rotations: np.ndarray) -> np.ndarray:
    """Matrices (n, 3, 3)."""
    return np.moveaxis(rotations, -1, 0)


@pytest.mark.parametrize("axis, turned", [("x", (0, -2, 1)), ("y", (2, 1, 0)), ("z", (-1, 0, 2))])
def test_rotations_are_right_handed(axis, turned):
    quarter = components.about(axis, np.pi / 2)
    assert components.applied(quarter, np.array([0, 1, 2])) == pytest.approx(turned, abs=1e-15)


def test_a_body_turns_about_x_first_and_about_z_last():
    x, y, z = (_one_by_one(components.about(axis, angle)) for axis, angle in zip("xyz", ANGLES))
    assert _one_by_one(components.turned(ANGLES)) == pytest.approx(z @ y @ x, abs=1e-15)


def test_products_are_those_of_matrices():
    first, last = components.turned(ANGLES), components.turned(ANGLES[::-1])
    expected = _one_by_one(last) @ _one_by_one(first)
    assert _one_by_one(components.product(last, first)) == pytest.approx(expected, abs=1e-15)
    assert _one_by_one(components.product(last, first[..., :1])) == pytest.approx(
        _one_by_one(last) @ first[..., 0], abs=1e-15
    )
    turned = (_one_by_one(last) @ VECTORS.T[..., None])[..., 0].T
    assert components.applied(last, VECTORS) == pytest.approx(turned, abs=1e-15)


def test_products_of_vectors_are_numpys():
    assert np.array_equal(components.cross(VECTORS, OTHERS), np.cross(VECTORS.T, OTHERS.T).T)
    assert components.dot(VECTORS, OTHERS) == pytest.approx((VECTORS * OTHERS).sum(axis=0))
    assert components.length(VECTORS) == pytest.approx(np.linalg.norm(VECTORS, axis=0))


def test_unit_vectors_keep_their_direction_and_zero_stays_zero():
    vectors = np.column_stack([VECTORS[:2], np.zeros(2)])
    units = components.unit(vectors)
    assert components.length(units)[:-1] == pytest.approx(1.0)
    assert units * components.length(vectors) == pytest.approx(vectors)
    assert not units[:, -1].any()


def test_frames_have_their_axes_as_columns():
    along, hinge, _ = np.moveaxis(components.turned(ANGLES), 1, 0)
    assert components.frame(along, hinge) == pytest.approx(components.turned(ANGLES), abs=1e-15)


def test_a_body_that_faces_a_heading_has_its_x_axis_along_it():
    heading = components.unit(VECTORS[:2])
    turn = components.facing(heading)
    assert np.array_equal(turn[:2, 0], heading) and not turn[2, 0].any()
    assert _one_by_one(turn) @ np.swapaxes(_one_by_one(turn), 1, 2) == pytest.approx(
        np.tile(np.eye(3), (COUNT, 1, 1)), abs=1e-15
    )
    assert (components.dot(components.cross(turn[:, 0], turn[:, 1]), turn[:, 2]) > 0).all()
