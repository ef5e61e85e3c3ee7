"""configs/contact_sheet.json shows every species, at sufficient resolution, where `./run pictures` expects it."""

import json
import sys

import numpy as np
import pytest

from resolved import load
from planner import assets
from planner.camera import project
from planner.config import ROOT
from planner.world import World, plan_world

sys.path.insert(0, str(ROOT / "assets" / "pictures"))

from draw_pictures import LARGE_SPECIES  # pylint: disable=wrong-import-position

CONFIG = ROOT / "configs" / "contact_sheet.json"
WHOLE_PX, MIDDLE_PX, MIDDLE_FROM_ABOVE_PX = (640, 512), (320, 256), (160, 128)


@pytest.fixture(scope="module", name="sheet")
def _sheet() -> World:
    return plan_world(load(CONFIG))


def test_every_species_is_on_it():
    shown = {group["species"] for group in json.loads(CONFIG.read_text())["scene"]["groups"]}
    assert shown == set(assets.names("species"))


def test_every_species_has_a_side_view_and_a_top_view(sheet):
    clips = [clip["id"] for clip in sheet.config["clips"]]
    assert sorted(clips) == sorted(
        f"{view}_{actor.group}" for actor in sheet.actors for view in ("side", "top")
    )


def test_pixels_on_the_ground_are_8_cm_or_finer_from_61_m(sheet):
    for clip in sheet.config["clips"]:
        if clip["id"].startswith("top_"):
            flight = sheet.flight(clip)
            assert flight.agl_m == pytest.approx([61.0], abs=0.1)  # it holds its height over smoothed ground
            assert flight.look_angle_deg == pytest.approx([90.0], abs=0.05)  # but for the gimbal's lag
    assert 61.0 / sheet.intrinsics.focal_px[0] < 0.08


def test_every_species_is_complete_and_alone_in_both_views(sheet):
    """Checks the corners of boxes, which contain bodies at all times; most pictures show only the middle."""
    for clip in sheet.config["clips"]:
        view, name = clip["id"].split("_", 1)
        size_px = (
            MIDDLE_FROM_ABOVE_PX
            if view == "top"
            else WHOLE_PX
            if name.split("_")[0] in LARGE_SPECIES
            else MIDDLE_PX
        )
        half_px = 0.5 * np.array(size_px)
        pose = sheet.flight(clip).camera_to_world[0]
        for actor in sheet.actors:
            corners = _corners_m(actor)
            point, depth_m = project(sheet.intrinsics, pose, corners)
            inside = (np.abs(point - sheet.intrinsics.centre_px) <= half_px).all(axis=1) & (depth_m > 0)
            assert inside.all() if actor.group == name else not inside.any(), (clip["id"], actor.group)


def _corners_m(actor) -> np.ndarray:
    point, heading = actor.path(np.array([actor.start_m]))
    along, aside = heading[0], np.array([-heading[0][1], heading[0][0]])
    ends = np.array(np.meshgrid(*actor.bounds_m.T)).reshape(3, -1).T
    return np.column_stack([point[0] + ends[:, :1] * along + ends[:, 1:2] * aside, ends[:, 2]])
