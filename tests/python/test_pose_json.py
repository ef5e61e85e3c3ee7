"""Poses as JSON: what they may be, and what is refused."""

import numpy as np
import pytest

from veldt import ConfigError
from veldt.fly import pose_of_json


@pytest.mark.parametrize(
    "text",
    [
        "{",
        "{}",
        '{"position_m": [1, 2]}',
        '{"position_m": [1, 2, NaN]}',
        '{"position_m": [1, 2, 3], "yaw_deg": "north"}',
        '{"camera_to_world": [1, 2, 3]}',
        '{"camera_to_world": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]}',
        '{"camera_to_world": [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}',
        '{"camera_to_world": [[1, 0, 0, 1e300], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}',
        '{"camera_to_world": [[1e300, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}',
        '{"camera_to_world": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [5, 6, 30, 1]]}',  # by columns
        '{"camera_to_world": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}',
        '{"camera_to_world": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], "yaw_deg": 90}',
        '{"camera_to_world": null}',
        '{"position_m": [1, 2, 1e300]}',
        '{"position_m": [1, 2, 10000.1]}',
        '{"position_m": [1, 2, Infinity]}',
        f'{{"position_m": [1, 2, {"9" * 4000}]}}',
        '{"position_m": [1, 2, true]}',
        '{"position_m": ["1", "2", "3"]}',
        '{"position_m": [[1], [2], [3]]}',
        '{"position_m": "123"}',
        '{"position_m": {"0": 1}}',
        '{"position_m": [1, 2, 3], "position_m": [4, 5, 6]}',
        '{"position_m": [1, 2, 3], "yaw_deg": null}',
        '{"position_m": [1, 2, 3], "yaw_deg": 1e9}',
        '{"position_m": [1, 2, 3], "yaw_rad": 1}',
        '{"position_m": [1, 2, 3], "Heading": 90}',
        '{"position_m": [1, 2, 3]} {}',
        '{"position_m": ' + 2000 * "[",
        2000 * '{"a":' + "1" + 2000 * "}",
        "[1, 2, 3]",
        b'{"position_m": [1, 2, 3], "\xff": 1}',
        b"\x00\x00\x00",
        "",
    ],
    ids=lambda text: ascii(text)[:60],
)
def test_what_is_no_pose_is_refused(text):
    with pytest.raises(ConfigError, match="^[ -~]{1,160}; expected [ -~]{1,160}$"):
        pose_of_json(text)


def test_other_keys_of_json_and_angles_of_many_turns_are_fine():
    pose = pose_of_json('{"position_m": [1, 2, 3], "yaw_deg": 3690, "time_s": 7, "labels": [{"yaw": 1}]}')
    assert np.allclose(pose, pose_of_json('{"position_m": [1, 2, 3], "yaw_deg": 90}'))
