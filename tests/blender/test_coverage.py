"""A zigzag's pictures show all of its area, according to their depth and poses."""

import numpy as np
import pytest

from rendering import render
from scenes import tiny
from planner.world import plan_world

AREA_M = [-40, -35, 40, 35]
CELL_M = 1.0


def _survey(look_angle_deg: float, aircraft: str, duration_s: int):
    def change(config):
        plan = {"pattern": "zigzag", "area_m": AREA_M, "altitude_m": 30, "heading_deg": 20}
        plan |= {"look_angle_deg": look_angle_deg, "aircraft": aircraft, "speed_m_s": 10}
        clip = {"frames": 2 * duration_s, "frame_rate_hz": 2, "flight": plan}
        config["camera"] = {"width_px": 64, "height_px": 52, "pixel_pitch_um": 85}
        config["camera"]["focal_length_m"] = 0.007
        config["scene"] |= {"plants": {}, "groups": []}
        config["scene"]["terrain"].update(size_m=300, relief_m=12)
        config["clips"] = [config["clips"][0] | clip]

    return tiny(change)


def _ground_m(world, planes: dict, pose: np.ndarray) -> np.ndarray:
    """Where the pixels' rays meet ground or water, (n, 2)."""
    lens = world.intrinsics
    (fx_px, fy_px), (cx_px, cy_px) = lens.focal_px, lens.centre_px
    column, row = np.meshgrid(np.arange(lens.width_px) + 0.5, np.arange(lens.height_px) + 0.5)
    rays = np.stack([(column - cx_px) / fx_px, (row - cy_px) / fy_px, np.ones_like(row)], axis=-1)
    places = (rays * planes["Scene.Depth.Z"][..., None]) @ pose[:3, :3].T + pose[:3, 3]
    return places[planes["Scene.IndexOB.X"] > 0][:, :2]


def _cells(points_m: np.ndarray) -> np.ndarray:
    """Indices of the area's cells that contain points (n, 2)."""
    x0, y0, x1, y1 = AREA_M
    column, row = np.floor((points_m - [x0, y0]) / CELL_M).astype(int).T
    inside = (column >= 0) & (column < x1 - x0) & (row >= 0) & (row < y1 - y0)
    return np.unique(row[inside] * (x1 - x0) + column[inside])


@pytest.mark.blender
@pytest.mark.parametrize(
    "look_angle_deg, aircraft, duration_s",
    [(90, "multirotor", 120), (45, "multirotor", 75), (90, "fixed_wing", 90), (60, "fixed_wing", 90)],
)
def test_all_of_the_area_is_seen(tmp_path, look_angle_deg, aircraft, duration_s):
    """Pixels are at most a metre apart, so every visible cell contains one in some frame."""
    config = _survey(look_angle_deg, aircraft, duration_s)
    world, run = plan_world(config), render(tmp_path, config)
    assert run.code == 0, run.log
    seen = np.zeros(80 * 70, bool)
    for frame, pose in enumerate(run.meaning("down")["camera_to_world"]):
        seen[_cells(_ground_m(world, run.planes("down", frame), pose))] = True
    assert seen.mean() >= 0.99
    assert seen[: len(seen) // 2].mean() > 0.98 and seen[len(seen) // 2 :].mean() > 0.98
