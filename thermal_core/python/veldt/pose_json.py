"""Poses as JSON objects."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .poses import checked_place, pose_of_attitude
from .rejections import Unusable, number_within

_MOST_DEG = 36_000  # a hundred turns
_ANGLES = ("roll_deg", "pitch_deg", "yaw_deg")
_USED = {"camera_to_world", "position_m", *_ANGLES}
_OF_POSES = (
    "attitude", "camera_", "gimbal", "heading", "orientation", "pitch", "pose", "position", "quaternion", "roll",
    "rotation", "translation", "yaw",
)  # fmt: skip
_EXPECTED = "camera_to_world, or position_m with yaw_deg, pitch_deg and roll_deg"


def pose_of_json(text: bytes | str) -> NDArray[np.float64]:
    """A pose (4, 4) of one JSON object with `camera_to_world` (4 x 4), or with `position_m` (east, north, up) and
    `yaw_deg` (from north, clockwise), `pitch_deg` (up) and `roll_deg`, which are 0 if they are missing. A matrix within
    1e-3 of a rotation is orthonormalised.

    Other keys are ignored, except those that look like poses ("yaw", "heading_deg", "rotation", …), which are errors.
    Numbers are JSON's own: no text, true, NaN or Infinity. Positions are within 10 km of the scene's (0, 0, 0) along
    each axis, angles within 36,000 degrees. ConfigError for anything else.
    """
    given = _object_of(text)
    for key in given.keys() - _USED:
        if key.lower().startswith(_OF_POSES):
            raise Unusable("unknown key", "pose", key, _EXPECTED)
    if "camera_to_world" in given:
        if len(given.keys() & _USED) > 1:
            raise Unusable("two poses", "pose", "camera_to_world and position_m or angles", "one of them")
        return _pose_of_matrix(given["camera_to_world"])
    if "position_m" not in given:
        raise Unusable("no pose", "pose", "neither", _EXPECTED)
    place_m = checked_place("position_m", _list_of(3, "position_m", given["position_m"]))
    angles_deg = [number_within(key, given.get(key, 0), "deg", -_MOST_DEG, _MOST_DEG) for key in _ANGLES]
    return pose_of_attitude(place_m, *np.deg2rad(angles_deg))


def _object_of(text: bytes | str) -> dict[str, Any]:
    try:
        given = json.loads(text, parse_int=float, parse_constant=_refused, object_pairs_hook=_without_twins)
    except (ValueError, RecursionError) as error:
        raise Unusable("not JSON", "pose", type(error).__name__, "one object of JSON") from error
    if not isinstance(given, dict):
        raise Unusable("not JSON", "pose", type(given).__name__, "one object of JSON")
    return given


def _refused(name: str) -> float:
    raise Unusable("not a number", "pose", name, "numbers")


def _without_twins(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    given = dict(pairs)
    if len(given) < len(pairs):
        raise Unusable(
            "a key twice", "pose", f"{len(pairs)} keys, {len(given)} of them different", "each key once"
        )
    return given


def _list_of(count: int, where: str, value: object) -> list[Any]:
    if isinstance(value, list) and len(value) == count:
        return value
    raise Unusable("wrong type", where, type(value).__name__, f"a list of {count}")


def _pose_of_matrix(matrix: object) -> NDArray[np.float64]:
    where = "camera_to_world"
    rows = [_list_of(4, where, row) for row in _list_of(4, where, matrix)]
    axes = np.array(
        [[number_within(where, entry, "", -1.001, 1.001) for entry in row[:3]] for row in rows[:3]]
    )
    place_m = checked_place(where, [row[3] for row in rows[:3]])
    last = [number_within(where, entry, "", -1, 1) for entry in rows[3]]
    left, scales, right = np.linalg.svd(axes)
    if np.abs(scales - 1).max() > 1e-3 or np.linalg.det(left @ right) < 0 or last != [0, 0, 0, 1]:
        raise Unusable(
            "no rotation", where, "another matrix", "rows of a rotation and a place [m], and 0, 0, 0, 1"
        )
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = left @ right, place_m
    return pose
