"""Small configs for the tests."""

import configs
from resolved import resolve


def tiny(change=None) -> dict:
    """The program's small place with more plants and larger flights, resolved after `change` was applied."""
    config = configs.tiny()
    config["scene"]["plants"] = {"acacia": {"per_ha": 60}, "shrub": {"per_ha": 200}}
    config["scene"]["groups"][0]["count"] = 2
    for clip in config["clips"]:
        clip["frames"] = 3
    config["clips"][0]["flight"] = {
        "pattern": "zigzag",
        "area_m": [-30, -30, 30, 30],
        "altitude_m": 40,
    }
    if change is not None:
        change(config)
    return resolve(config)


def flat(config: dict) -> None:
    """Make the place level and bare, so that only actors occlude actors."""
    config["scene"]["terrain"].update(relief_m=0, water_radius_m=0)
    config["scene"]["plants"] = {}
