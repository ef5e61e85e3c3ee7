"""Schedules: a grazer stops and goes, stays with the herd, and lifts its head to walk."""

import numpy as np
import pytest

from planner.groups.schedules import Drinking, Steady, StopAndGo, together

TIME_S = np.arange(0.0, 1200.0, 0.02)
GRAZERS = [StopAndGo(7, "herd", k, 1.1) for k in range(12)]


def _speed_m_s(schedule):
    return np.diff(schedule.at(TIME_S).walked_m) / np.diff(TIME_S)


def test_a_steady_walker_walks_at_all_times():
    doing = Steady(1.4).at(np.array([0.0, 10.0, -5.0]))
    assert doing.walked_m == pytest.approx([0.0, 14.0, -7.0])
    assert (doing.pace == 1).all() and (doing.head_down == 0).all()


def test_speed_0_stands():
    doing = Steady(0.0).at(TIME_S)
    assert not doing.walked_m.any() and not doing.pace.any()


@pytest.mark.parametrize("grazer", GRAZERS)
def test_a_grazer_never_walks_backwards_nor_faster_than_its_walk(grazer):
    speed = _speed_m_s(grazer)
    assert speed.min() > -1e-9
    assert speed.max() < 1.1 + 1e-9


@pytest.mark.parametrize("grazer", GRAZERS)
def test_a_grazer_keeps_within_its_reach_of_the_herds_mean(grazer):
    ahead_m = grazer.at(TIME_S).walked_m - grazer.mean_m_s * TIME_S
    assert np.abs(ahead_m).max() <= grazer.reach_m
    assert np.ptp(ahead_m) > 0.5 * grazer.reach_m  # else the bound says little


@pytest.mark.parametrize("grazer", GRAZERS)
def test_a_grazer_stands_most_of_the_time_with_its_head_down(grazer):
    doing, speed = grazer.at(TIME_S[:-1]), _speed_m_s(grazer)
    assert (speed == 0).mean() > 0.7
    assert (doing.head_down == 1).mean() > 0.6
    # Its feet leave the ground only while it walks, and it does not walk with its mouth in the grass.
    assert not doing.pace[speed == 0].any()
    assert not doing.head_down[doing.pace > 0.01].any()


def test_grazers_move_smoothly():
    for grazer in GRAZERS:
        doing = grazer.at(TIME_S)
        # A head goes all the way in 1.5 s: the steepest slope of the curve is 1.5 of that, 1 / s, times 20 ms.
        assert np.abs(np.diff(doing.head_down)).max() < 0.021
        assert np.abs(np.diff(_speed_m_s(grazer))).max() < 0.05


def test_grazers_do_not_move_together():
    moving = [_speed_m_s(grazer) > 0.1 for grazer in GRAZERS]
    assert len({row.tobytes() for row in moving}) == len(GRAZERS)


def test_a_moment_does_not_depend_on_the_others_asked_for():
    whole = GRAZERS[3].at(TIME_S)
    alone = GRAZERS[3].at(TIME_S[4321:4322])
    assert alone.walked_m[0] == whole.walked_m[4321] and alone.head_down[0] == whole.head_down[4321]


@pytest.mark.parametrize(
    "members",
    [GRAZERS, [Drinking(0.1 * k) for k in range(9)], [Steady(1.4)] * 3],
    ids=lambda them: type(them[0]),
)
def test_members_together_do_what_each_does_alone(members):
    of = np.repeat(np.arange(len(members)), 5)
    time_s = np.linspace(3.0, 300.0, len(of))
    doing = together(members, of).at(time_s)
    for k, member in enumerate(of):
        alone = members[member].at(time_s[k : k + 1])
        assert doing.walked_m[k] == alone.walked_m[0]
        assert doing.pace[k] == alone.pace[0]
        assert doing.head_down[k] == alone.head_down[0]


def test_a_drinker_stays_and_lowers_its_head_now_and_then():
    doing = Drinking(0.3).at(TIME_S)
    assert not doing.walked_m.any() and not doing.pace.any()
    assert 0.5 < doing.head_down.mean() < 0.7
    assert doing.head_down.min() == 0 and doing.head_down.max() == 1
