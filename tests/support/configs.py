"""A small config: two clips that a real Blender makes in two seconds."""

from __future__ import annotations

import copy
from collections.abc import Callable

FRAMES = 8
CLIPS = ("down", "side")

# The least that makes a config: everything else is a default.
LEAST = {
    "name": "least",
    "clips": [
        {
            "id": "only",
            "season": "winter",
            "frames": 1,
            "flight": {"pattern": "zigzag", "area_m": [0, 0, 9, 9]},
        }
    ],
}

# A video link that combs what moves, and has no errors.
QUIET_LINK = {
    "standard": "pal",
    "bandwidth_mhz": 100,
    "noise_levels": 0,
    "streak_levels": 0,
    "row_levels": 0,
    "drift_levels": 0,
    "hum_levels": 0,
    "jitter_px": 0,
}

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
            "pan_radius_m": 0,
            "hollow_depth_m": 0,
            "gully_depth_m": 0,
            "craggy_fraction": 0,
            "pan_fraction": 0,
            "road": {"width_m": 0},
        },
        "plants": {"acacia": {"per_ha": 30}, "shrub": {"per_ha": 100}},
        "paths": {"loop": {"points_m": [[28, 0], [0, 28], [-28, 0], [0, -28]]}},
        "groups": [
            {
                "name": "people",
                "species": "human",
                "path": "loop",
                "count": 3,
                "start_m": 0,
                "spacing_m": 3,
                "spread_m": 1,
            },
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
    "render": {"engine": "blender"},
    "clips": [
        {
            "id": "down",
            "season": "winter",
            "frames": FRAMES,
            "flight": {
                "pattern": "zigzag",
                "area_m": [13, -10, 33, 10],  # its first lane leads over the people
                "heading_deg": 90,
                "lane_spacing_m": 10,
                "altitude_m": 40,
            },
        },
        {
            "id": "side",
            "season": "summer",
            "frames": FRAMES,
            "flight": {"pattern": "follow", "target": "herd", "look_angle_deg": 45, "altitude_m": 25},
        },
    ],
}


def tiny(change: Callable[[dict], None] | None = None) -> dict:
    """A small place with people, elephants and zebras, after `change` was applied."""
    config = copy.deepcopy(_TINY)
    if change is not None:
        change(config)
    return config
