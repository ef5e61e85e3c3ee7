"""Panels are closed, face outward, and have the volume of their side view and width."""

import numpy as np
import pytest

from planner.geometry.panel_shapes import panel, wheel

_BOX = np.array([[0.0, 0.0, 0.5], [2.0, 0.0, 0.5], [2.0, 1.0, 0.5], [0.0, 1.0, 0.5]])
# A square of side 3 with a notch of 1 by 2 from below, as a wheel arch is cut.
_NOTCHED = np.array(
    [[x, z, 1.0] for x, z in [(0, 0), (1, 0), (1, 2), (2, 2), (2, 0), (3, 0), (3, 3), (0, 3)]], float
)


def _volume_m3(mesh) -> float:
    a, b, c = np.moveaxis(mesh.points_m[mesh.triangles], 1, 0)
    return float((a * np.cross(b, c)).sum() / 6.0)


def _edges(mesh) -> list[tuple[int, int]]:
    return [tuple(edge) for t in mesh.triangles.tolist() for edge in zip(t, t[1:] + t[:1])]


@pytest.mark.parametrize("outline", [_BOX, _BOX[::-1], _NOTCHED])
@pytest.mark.parametrize(("bevel_m", "corner_m"), [(0.0, 0.0), (0.04, 0.0), (0.1, 0.1)])
def test_a_panel_is_closed(outline, bevel_m, corner_m):
    edges = _edges(panel(outline, bevel_m, corner_m))
    assert len(set(edges)) == len(edges)
    assert {(b, a) for a, b in edges} == set(edges)


def test_a_panel_without_round_edges_is_its_outline_drawn_out():
    # Sums of a few dozen products near 1: far fewer roundings than 1e-12 / 2e-16.
    assert _volume_m3(panel(_BOX, 0.0)) == pytest.approx(2.0 * 1.0 * 1.0, abs=1e-12)
    assert _volume_m3(panel(_BOX[::-1], 0.0, y_m=0.7)) == pytest.approx(2.0, abs=1e-12)
    assert _volume_m3(panel(_NOTCHED, 0.0)) == pytest.approx((9.0 - 2.0) * 2.0, abs=1e-12)


def test_round_edges_take_away_what_they_should():
    # A flat edge of radius r takes the frustum between the box and its inset side: per side, the area it is inset by
    # grows evenly over r. Inset by r all round, 2 x 1 loses 6 r - 4 r^2; the mean over the edge is 3 r - 4/3 r^2.
    r = 0.04
    expected = 2.0 - 2.0 * r * (3.0 * r - 4.0 / 3.0 * r**2)
    assert _volume_m3(panel(_BOX, r)) == pytest.approx(expected, abs=1e-12)


def test_a_panel_fills_its_bounds():
    points = panel(_BOX, 0.1, y_m=0.3).points_m
    assert np.allclose(points.min(axis=0), [0.0, -0.2, 0.0], rtol=0, atol=1e-12)
    assert np.allclose(points.max(axis=0), [2.0, 0.8, 1.0], rtol=0, atol=1e-12)


def test_a_panel_can_be_narrower_at_the_top():
    outline = _BOX.copy()
    outline[2:, 2] = 0.2
    points = panel(outline, 0.0).points_m
    assert np.abs(points[points[:, 2] > 0.5, 1]).max() == 0.2
    assert np.abs(points[points[:, 2] < 0.5, 1]).max() == 0.5


def test_a_wheel_has_its_size_and_faces_outward():
    mesh = wheel([1.0, 0.7, 0.4], 0.4, 0.12, 0.03)
    assert np.hypot(mesh.points_m[:, 0] - 1.0, mesh.points_m[:, 2] - 0.4).max() == pytest.approx(
        0.4, abs=1e-12
    )
    assert np.abs(mesh.points_m[:, 1] - 0.7).max() == pytest.approx(0.12, abs=1e-12)
    assert _volume_m3(mesh) > 0
