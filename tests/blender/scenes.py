"""Small configs the tests share."""

import copy

from veldt.config import resolve

_TINY = {
    "name": "tiny",
    "seed": 7,
    "scene": {
        "terrain": {
            "size_m": 120,
            "cell_m": 2,
            "relief_m": 5,
            "hill_wavelength_m": 80,
            "water_radius_m": 10,
            "grass_patch_m": 12,
        },
        "plants": {"acacia_per_ha": 60, "shrub_per_ha": 200},
        "paths": {"loop": {"points_m": [[28, 0], [0, 28], [-28, 0], [0, -28]]}},
        "groups": [
            {"name": "people", "species": "human", "path": "loop", "count": 2, "spacing_m": 3, "spread_m": 1},
            {
                "name": "herd",
                "species": "elephant",
                "path": "loop",
                "count": 2,
                "spacing_m": 8,
                "start_m": 16,
            },
            {"name": "zebras", "species": "zebra", "path": "loop", "count": 2, "start_m": 28},
        ],
    },
    "camera": {"width_px": 96, "height_px": 80, "pixel_pitch_um": 100},
    "clips": [
        {
            "id": "down",
            "season": "winter",
            "frames": 3,
            "flight": {
                "pattern": "zigzag",
                "area_m": [-30, -30, 30, 30],
                "altitude_m": 40,
                "lane_spacing_m": 60,
            },
        },
        {
            "id": "side",
            "season": "summer",
            "frames": 3,
            "flight": {"pattern": "follow", "target": "herd", "look_angle_deg": 45, "altitude_m": 25},
        },
    ],
}


def tiny(change=None) -> dict:
    """A small place with everything in it, defaults filled in after `change` had its way with the config."""
    config = copy.deepcopy(_TINY)
    if change is not None:
        change(config)
    return resolve(config)


def flat(config: dict) -> None:
    """Makes the place level and bare, so that nothing but actors hides actors."""
    config["scene"]["terrain"].update(relief_m=0, water_radius_m=0)
    config["scene"]["plants"] = {"acacia_per_ha": 0, "shrub_per_ha": 0}
