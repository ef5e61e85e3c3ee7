"""What groups say of engines and baths, and what their members have by nature."""

import pytest

from planner.faults import ConfigError
from planner.groups.conditions import check_condition, condition


def _group(species, **keys):
    return {"name": "g", "species": species, "count": 1, **keys}


def _stands(species, **keys):
    return _group(species, place=[0, 0], **keys)


def test_most_groups_say_nothing_and_leave_it_to_the_thermal_core():
    assert condition(_stands("elephant"), 0, 1) == {}
    assert condition(_stands("pickup"), 0, 1) == {}
    assert condition(_stands("pickup", engine={"state": "parked"}), 0, 1) == {}


def test_engines_are_warm_unless_the_config_says_since_when_they_run():
    idling = _stands("lorry", engine={"state": "idling"})
    assert condition(idling, 0, 1) == {"engine": {"state": "idling", "since_s": 3600.0}}
    parked = _stands("lorry", engine={"state": "parked", "since_s": 40})
    assert condition(parked, 0, 1) == {"engine": {"state": "parked", "since_s": 40}}
    driving = _group("lorry", path="road", engine={"state": "driving", "since_s": 90})
    assert condition(driving, 0, 1) == {"engine": {"state": "driving", "since_s": 90}}


def test_hippopotamus_are_wet_since_a_time_of_their_own_and_elephants_if_they_are_said_to_be():
    basking = _stands("hippopotamus")
    times_s = [condition(basking, k, seed)["wet_s"] for k in range(20) for seed in range(20)]
    assert len(set(times_s)) == len(times_s)
    assert min(times_s) >= 600 and max(times_s) <= 7200
    # The mean of 400 uniform numbers: five standard deviations.
    assert sum(times_s) / len(times_s) == pytest.approx(3900, abs=5 * 6600 / 12**0.5 / 20)
    assert condition(basking, 3, 1) == condition(basking, 3, 1)
    assert condition(_stands("hippopotamus", wet_s=5), 0, 1) == {"wet_s": 5}
    assert condition(_group("hippopotamus", place="water", behaviour="float"), 0, 1) == {"wet_s": 0.0}
    assert condition(_stands("elephant", wet_s=300), 0, 1) == {"wet_s": 300}


@pytest.mark.parametrize(
    "group, message",
    [
        (
            _stands("lion", engine={"state": "parked"}),
            "scene.groups[2].engine is given; expected none, since a lion has no engine",
        ),
        (
            _stands("pickup", engine={"state": "driving"}),
            'scene.groups[2].engine.state = "driving"; expected "idling" or "parked", since the group stands',
        ),
        (
            _group("pickup", path="road", engine={"state": "idling"}),
            'scene.groups[2].engine.state = "idling"; expected "driving", since the group moves',
        ),
        (
            _stands("crocodile", wet_s=600),
            "scene.groups[2].wet_s = 600 s; expected none, since a bath does not cool a crocodile: its material has no"
            " wet_when_bathed",
        ),
    ],
)
def test_what_a_species_cannot_have_is_refused(group, message):
    with pytest.raises(ConfigError) as error:
        check_condition("scene.groups[2]", group)
    assert str(error.value) == message
