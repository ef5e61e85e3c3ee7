"""Members of a group: close together, without overlap."""

import numpy as np
import pytest

from planner.groups.herds import Room, plan_places

ELEPHANT = Room(2.6, 1.1)
LONG_M = 1000.0
GRAZER = Room(1.2, 0.35, reach_m=3.0)


def _overlaps(rooms, places, shrink=1.0):
    for k, (a, p) in enumerate(zip(rooms, places)):
        for b, q in zip(rooms[:k], places[:k]):
            nearest_m = shrink * (abs(p.along_m - q.along_m) - a.reach_m - b.reach_m)
            along = nearest_m < a.half_length_m + b.half_length_m
            across = abs(p.lateral_m - q.lateral_m) < a.half_width_m + b.half_width_m
            if along and across:
                yield p, q


@pytest.mark.parametrize("rooms", [[ELEPHANT] * 9, [GRAZER] * 14, [GRAZER, ELEPHANT] * 5])
@pytest.mark.parametrize("spread_m", [0.0, 2.0, 15.0])
def test_bodies_keep_apart(rooms, spread_m):
    places = plan_places(rooms, 2.0, spread_m, LONG_M, 5, "herd", shrink=0.8)
    assert not list(_overlaps(rooms, places, 0.8))
    assert max(abs(place.lateral_m) for place in places) <= spread_m


def test_members_that_fit_follow_at_their_spacing():
    places = plan_places([ELEPHANT] * 6, 9.0, 3.0, LONG_M, 5, "herd")
    steps_m = np.diff([place.along_m for place in places])
    assert places[0].along_m == 0
    assert steps_m.mean() == pytest.approx(
        -9.0, abs=2 * 0.25 * 9.0 / 5
    )  # both ends are uneven by at most a quarter
    assert np.ptp([place.lateral_m for place in places]) > 2.0


def test_a_member_that_does_not_fit_falls_back():
    places = plan_places([ELEPHANT] * 4, 0.0, 0.0, LONG_M, 5, "herd")
    assert np.diff([place.along_m for place in places]).max() <= -(2 * 2.6)


def test_a_members_place_does_not_depend_on_later_members():
    assert (
        plan_places([ELEPHANT] * 3, 6.0, 4.0, LONG_M, 5, "herd")
        == plan_places([ELEPHANT] * 5, 6.0, 4.0, LONG_M, 5, "herd")[:3]
    )


def test_groups_and_seeds_differ():
    one, other, third = (
        plan_places([ELEPHANT] * 3, 6.0, 4.0, LONG_M, *key) for key in ((5, "a"), (5, "b"), (6, "a"))
    )
    assert one != other and one != third


def test_a_short_path_holds_as_many_as_fit():
    # Bodies of 5.2 m, 0.4 m apart, dropping back by half metres: 6 m each; the last keeps off the first.
    assert len(plan_places([ELEPHANT] * 20, 0.0, 0.0, 60.0, 5, "herd")) == 10
    assert len(plan_places([ELEPHANT] * 30_000, 4.0, 0.0, 60.0, 5, "herd")) == 10
