"""Blender's pictures match the plan to the pixel."""

from collections.abc import Collection

import numpy as np
import pytest

from raster import draw, farthest_from_an_edge, plant_triangles, world_triangles
from rendering import PLANES, render
from scenes import flat, tiny
from planner import assets, ids
from planner.camera import project
from planner.groups.actors import track
from planner.sightings import box_corners_m
from planner.world import plan_world

pytestmark = pytest.mark.blender

CLIPS = ("down", "side")


def test_ground_and_water_are_where_they_were_planned(full, world):
    """Depth and pose put every pixel of ground and water back onto the terrain."""
    lens = world.intrinsics
    (fx_px, fy_px), (cx_px, cy_px) = lens.focal_px, lens.centre_px
    column, row = np.meshgrid(np.arange(lens.width_px) + 0.5, np.arange(lens.height_px) + 0.5)
    rays = np.stack([(column - cx_px) / fx_px, (row - cy_px) / fy_px, np.ones_like(row)], axis=-1)
    for clip in CLIPS:
        planes, pose = full.planes(clip, 1), full.meaning(clip)["camera_to_world"][1]
        place = (rays * planes["Scene.Depth.Z"][..., None]) @ pose[:3, :3].T + pose[:3, 3]
        wet = planes["Scene.IndexOB.X"] == ids.WATER
        dry = planes["Scene.IndexOB.X"] == ids.GROUND
        height_m = world.terrain.height_m(place[..., 0], place[..., 1])
        # Blender computes in float32 at coordinates up to 60 m, eps 4e-6 m; some tens of roundings, slopes below 1.
        assert np.abs(place[..., 2] - height_m)[dry].max() < 2e-4
        assert np.abs(place[..., 2] - world.terrain.waters[0].level_m)[wet].max(initial=0.0) < 2e-4
        assert (height_m[wet] < world.terrain.waters[0].level_m).all()


def test_boxes_hold_their_actors(full, world):
    """No pixel of an actor lies outside its projected box."""
    for number, clip in enumerate(CLIPS):
        flight = world.flight(world.config["clips"][number])
        for actor in world.actors:
            corners, _ = project(
                world.intrinsics, flight.camera_to_world, box_corners_m(actor, track(actor, flight.time_s))
            )
            for frame in range(3):
                row, column = np.nonzero(full.planes(clip, frame)["Scene.IndexOB.X"] == actor.index)
                pixels = np.stack([column, row], axis=1) + 0.5
                # Poses in the plan and in Blender differ by float32: about 1e-3 px.
                assert (pixels > corners[frame].min(axis=0) - 0.01).all()
                assert (pixels < corners[frame].max(axis=0) + 0.01).all()


def test_overscan_adds_around_the_picture_and_leaves_it_as_it_is(full, tmp_path):
    wide = render(tmp_path, tiny(lambda config: config.update(render={"overscan_px": 5})), "--clip", "side")
    assert wide.code == 0, wide.log
    assert wide.meaning("side")["camera"] == full.meaning("side")["camera"]
    for frame in range(3):
        plain, wider = full.planes("side", frame), wide.planes("side", frame)
        inner = {name: plane[5:-5, 5:-5] for name, plane in wider.items()}
        assert wider["Scene.IndexOB.X"].shape == tuple(n + 10 for n in plain["Scene.IndexOB.X"].shape)
        # The same rays but for float32: a pixel differs where an edge passes within 1e-4 px or so of its centre.
        same = inner["Scene.IndexOB.X"] == plain["Scene.IndexOB.X"]
        assert np.count_nonzero(~same) <= 3
        ratio = inner["Scene.Depth.Z"][same] / plain["Scene.Depth.Z"][same]
        assert np.median(np.abs(ratio - 1)) < 1e-5


def _crowd(config: dict) -> None:
    """All actors on a level, bare place, seen from above and from the side at half time steps."""
    flat(config)
    config["scene"]["terrain"]["size_m"] = 400  # no sky in the picture
    config["camera"] = {"width_px": 320, "height_px": 256, "pixel_pitch_um": 30}
    config["scene"]["groups"] = [
        {"name": name, "species": name, "path": "loop", "start_m": 6 * k}
        for k, name in enumerate(("human", "elephant", "zebra"))
    ]
    follow = {"pattern": "follow", "target": "elephant", "altitude_m": 25}
    config["clips"] = [
        {
            "id": "down",
            "season": "winter",
            "frames": 2,
            "frame_rate_hz": 3,
            "flight": follow | {"look_angle_deg": 90},
        },
        {
            "id": "side",
            "season": "winter",
            "frames": 2,
            "frame_rate_hz": 3,
            "flight": follow | {"look_angle_deg": 40, "azimuth_deg": 70},
        },
    ]


def _assert_pictures_agree(
    world, flight, frame: int, rendered: np.ndarray, triangles: dict, most_unseen: int = 0
) -> None:
    """An independent drawing agrees with Blender's index plane in every pixel off the projected edges."""
    pose = flight.camera_to_world[frame]
    expected = draw(world, pose, triangles, ids.GROUND)
    assert sum(np.count_nonzero(expected == index) <= 20 for index in triangles) <= most_unseen
    row, column = np.nonzero(expected != rendered)
    # float32 poses move a body by 1e-5 m and turn the view by 1e-6 rad: 0.01 px is several times that.
    edges = np.concatenate(list(triangles.values()))
    assert farthest_from_an_edge(world, pose, edges, np.stack([column, row], axis=1)) < 0.01
    # The outlines are some hundred px long, and a hundredth px of every px can be on either side.
    assert len(row) < 10


# Pixels higher than wide, then wider than high; the axis off the middle to either side.
@pytest.mark.parametrize(
    "camera",
    [
        {},
        {"fx_px": 430, "fy_px": 390, "cx_px": 190.25, "cy_px": 101.5, "height_px": 250},
        {"fx_px": 400, "fy_px": 436, "cx_px": 181, "cy_px": 150.75},
    ],
)
def test_bodies_fill_exactly_the_pixels_they_should(tmp_path, camera):
    config = tiny(_crowd)
    config["camera"].update(camera)
    world, run = plan_world(config), render(tmp_path, config)
    assert run.code == 0, run.log
    assert run.meaning("down")["camera"].items() >= camera.items()
    for clip in config["clips"]:
        flight = world.flight(clip)
        for frame in range(clip["frames"]):
            bodies = {a.index: world_triangles(a, flight.time_s[frame]) for a in world.actors}
            _assert_pictures_agree(world, flight, frame, run.planes(clip["id"], frame)[PLANES[0]], bodies)


def _grove(config: dict, kinds: Collection[str], per_ha: float, size_m: float) -> None:
    """A level place with plants of some kinds and no actors in sight, seen from above and at 45 deg."""
    flat(config)
    config["scene"]["terrain"]["size_m"] = size_m
    config["scene"]["plants"] = {name: {"per_ha": per_ha} for name in kinds}
    config["scene"]["groups"] = []
    down = config["clips"][0] | {"frames": 1}
    down["flight"] |= {"altitude_m": 0.25 * size_m, "area_m": [0.1875 * k * size_m for k in (-1, -1, 1, 1)]}
    side = down | {"id": "side", "flight": down["flight"] | {"look_angle_deg": 45}}
    config["clips"] = [down, side]


SMALL = [name for name in assets.names("plants") if assets.load("plants", name)["cover_m2"] < 0.5]
LARGE = [name for name in assets.names("plants") if name not in SMALL]


@pytest.mark.parametrize("kinds, per_ha, size_m", [(LARGE, 12, 160), (SMALL, 200, 64)])
def test_plants_fill_exactly_the_pixels_they_should(tmp_path, kinds, per_ha, size_m):
    config = tiny(lambda c: _grove(c, kinds, per_ha, size_m))
    world, run = plan_world(config), render(tmp_path, config)
    assert run.code == 0, run.log
    plants = {index: plant_triangles(world, name) for name, index in world.plant_indices.items()}
    for clip in config["clips"]:
        shown = run.planes(clip["id"], 0)[PLANES[0]]
        _assert_pictures_agree(world, world.flight(clip), 0, shown, plants, most_unseen=5)
