"""Labels of index planes."""

import numpy as np
import pytest

import passes
from veldt import DataError, instances


def test_instances_are_the_actors_pixels():
    plane = passes.object_index(1)
    walker, elephant = instances(plane, [passes.WALKER, passes.ELEPHANT, 7])
    assert (walker.index, walker.box_px, walker.truncated) == (passes.WALKER, (9, 5, 2, 2), False)
    assert np.array_equal(walker.mask(), plane == passes.WALKER)
    assert walker.area_px == np.count_nonzero(plane == passes.WALKER)
    assert elephant.truncated
    assert instances(plane, []) == []


def test_indices_have_a_limit():
    with pytest.raises(
        DataError, match=r"index_plane at pixel \(0, 0\) = 32768; expected a whole number from 0 to 32767"
    ):
        instances(np.full((2, 2), 32768), [1])
