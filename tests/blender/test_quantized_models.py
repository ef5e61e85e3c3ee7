"""Models of glTF whose corners are whole numbers."""

import numpy as np
import pytest

from test_models import glb
from planner.model_files import survey


def _position(component, low, high, **more) -> list[dict]:
    """The accessor of positions that are integers."""
    return [{"componentType": component, "count": 3, "type": "VEC3", "min": low, "max": high} | more]


@pytest.mark.parametrize(
    "component, largest, low", [(5120, 127, -128), (5121, 255, 0), (5122, 32767, -32768), (5123, 65535, 0)]
)
def test_normalized_integers_of_a_glb_are_shares_of_the_largest(tmp_path, component, largest, low):
    node = {"mesh": 0, "scale": [2.1, 1, 0.5], "translation": [0, 3, 0]}
    accessors = _position(component, [low, 0, 0], [largest, largest, largest], normalized=True)
    (tmp_path / "a.glb").write_bytes(glb([node], accessors=accessors))
    first = -2.1 if low < 0 else 0.0  # the least integer is no less than the one above it
    np.testing.assert_allclose(
        survey(tmp_path / "a.glb").box_m, [[first, -0.5, 3], [2.1, 0, 4]], rtol=0, atol=1e-12
    )


def test_other_integers_of_a_glb_and_sparse_ones_are_as_they_are(tmp_path):
    accessors = _position(5122, [0, 0, 0], [1000, 500, 2000], sparse={"count": 1})
    quantized = {"extensionsRequired": ["KHR_mesh_quantization", "KHR_texture_transform"]}
    (tmp_path / "a.glb").write_bytes(
        glb([{"mesh": 0, "scale": [0.001] * 3}], accessors=accessors, **quantized)
    )
    np.testing.assert_allclose(
        survey(tmp_path / "a.glb").box_m, [[0, -2, 0], [1, 0, 0.5]], rtol=0, atol=1e-12
    )
