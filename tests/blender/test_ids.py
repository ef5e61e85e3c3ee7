"""Object and material indices."""

import pytest

from planner import ids
from planner.faults import ConfigError


def test_actors_count_up_and_stay_off_the_place():
    assert ids.plan_indices(["a", "b"]) == {"a": 101, "b": 102}
    assert max(ids.plan_plant_indices(["acacia", "shrub"]).values()) < ids.FIRST_ACTOR


def test_plants_have_the_indices_before_the_actors_and_no_more():
    names = [str(k) for k in range(98)]
    assert ids.plan_plant_indices(names)["97"] == ids.FIRST_ACTOR - 1
    with pytest.raises(ConfigError) as fault:
        ids.plan_plant_indices([*names, "one more"])
    assert str(fault.value) == "scene.plants = 99 species; expected at most 98, one object index each"


def test_the_last_index_is_used_and_no_more():
    names = [str(k) for k in range(32667)]
    assert ids.plan_indices(names)["32666"] == 32767
    with pytest.raises(ConfigError) as fault:
        ids.plan_indices([*names, "one more"])
    assert str(fault.value) == "scene.groups = 32668 actors; expected at most 32667, one object index each"


def test_materials_are_numbered_once_each_in_order():
    pairs = [("soil", ""), ("human", "head"), ("soil", ""), ("human", "legs")]
    assert ids.plan_material_indices(pairs) == {("soil", ""): 1, ("human", "head"): 2, ("human", "legs"): 3}
