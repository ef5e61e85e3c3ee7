"""A mission of QGroundControl, and changes of it, for the tests of the reader."""

import copy
import json
from pathlib import Path

import numpy as np

from planner.flight.waypoint_files import read_waypoints

FLIGHTS = Path(__file__).resolve().parents[1] / "data" / "flights"
SURVEY = json.loads((FLIGHTS / "survey.plan").read_text(encoding="utf-8"))
HOME_M, GROUND_M = (10.0, -5.0), 8.0
WHERE = "clips[0].flight.waypoints"
WAYPOINT_ITEM, SURVEY_ITEM, RETURN_ITEM = 2, 3, 4


def ground_m(x_m, y_m):
    """8 m high at home, rising to the east."""
    return GROUND_M + 0.1 * (np.asarray(x_m, float) - HOME_M[0]) + 0.0 * np.asarray(y_m, float)


def read_mission(folder, content, name="survey.plan"):
    text = content if isinstance(content, str) else json.dumps(content)
    (folder / name).write_bytes(text.encode("utf-8"))
    return read_waypoints(str(folder / name), HOME_M, ground_m, WHERE)


def mission_of(*items):
    """A plan of some items instead of the survey's."""
    plan = copy.deepcopy(SURVEY)
    plan["mission"]["items"] = list(items)
    return plan


def mission_item(command, params=(), frame=3, **more):
    """A simple item; params beyond the given are 0."""
    params = [*params, *[0] * (7 - len(params))]
    return {
        "autoContinue": True,
        "command": command,
        "frame": frame,
        "params": params,
        "type": "SimpleItem",
    } | more


def place_params(east_m, north_m, height_m, hold_s=0):
    """Params of a waypoint so far from home, by a degree's length at its latitude."""
    latitude_deg, longitude_deg, _ = SURVEY["mission"]["plannedHomePosition"]
    return [hold_s, 0, 0, None, latitude_deg + north_m / 110577, longitude_deg + east_m / 111228, height_m]
