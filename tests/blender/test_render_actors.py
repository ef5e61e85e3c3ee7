"""Bodies in a real Blender match their planned poses, vertex by vertex."""

import json
import subprocess

import numpy as np
import pytest

from plans import bake
from processes import PATIENCE_S
from rendering import BLENDER
from scenes import tiny
from planner.groups.actors import poses
from planner.config import ROOT
from planner.world import plan_world

pytestmark = pytest.mark.blender

FRAMES = (0, 70)  # the second beyond the frames that are posed at once

# Positions of all vertices in some frames of a clip, by frame and object index, with bones in the order of objects.
READ = """
import json, sys
from pathlib import Path
scripts, plan, clip, frames, out = sys.argv[-5:]
sys.path.insert(0, scripts)
import bpy, numpy as np
from planner.bake.baked import read_scene, read_track
from veldt_bl.scene import build_stage
scene = read_scene(Path(plan) / "scene")
track = read_track(Path(plan) / "tracks" / clip, scene)
stage = build_stage(scene)
positions = {}
for frame in json.loads(frames):
    stage.rigs.pose(track, frame)
    bpy.context.view_layer.update()
    for shown in bpy.context.scene.objects:
        if shown.pass_index > 100 and shown.visible_camera:
            points = [shown.matrix_world @ vertex.co for vertex in shown.data.vertices]
            positions[f"{frame}/{shown.name}"] = np.array(points)
np.savez(out, **positions)
"""


def _herd(config: dict) -> None:
    """On hills, walking, grazing and driving; a few frames are checked, none is rendered."""
    config["scene"]["plants"] = {}
    walk = {"path": "loop", "count": 1}
    config["scene"]["groups"] = [
        walk | {"name": "people", "species": "human", "start_m": 0},
        walk | {"name": "herd", "species": "elephant", "start_m": 20, "count": 2},
        walk | {"name": "grazer", "species": "zebra", "start_m": 60, "behaviour": "graze"},
        walk | {"name": "car", "species": "pickup", "start_m": 90},
    ]
    wide = {"width_px": 400, "height_px": 400, "fx_px": 50, "fy_px": 50}  # so that all actors are seen
    config["camera"] = wide
    config["clips"] = [config["clips"][0] | {"frames": 80, "frame_rate_hz": 9}]


@pytest.fixture(scope="module", name="shown")
def _shown(tmp_path_factory) -> dict[str, np.ndarray]:
    folder = tmp_path_factory.mktemp("shown")
    (folder / "read.py").write_text(READ)
    plan = bake(tiny(_herd), folder / "plan")
    command = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "-t", "1", "--python"]
    command += [folder / "read.py", "--", ROOT / "blender_scripts", plan, "down"]
    command += [json.dumps(FRAMES), folder / "shown.npz"]
    done = subprocess.run(
        list(map(str, command)), capture_output=True, text=True, timeout=PATIENCE_S, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return dict(np.load(folder / "shown.npz"))


@pytest.mark.parametrize("frame", FRAMES)
def test_vertices_are_where_the_pose_puts_them(shown, frame):
    config = tiny(_herd)
    world = plan_world(config)
    time_s = world.flight(config["clips"][0]).time_s[[frame]]
    for actor in world.actors:
        posed = poses(actor, time_s).points_m(actor.body, 0)
        built = [shown.get(f"{frame}/{actor.name} {bone.name}") for bone in actor.body.bones]
        built = np.concatenate([points for points in built if points is not None])
        assert built.shape == posed.shape
        # float32 at up to 60 m: eps 4e-6 m, for a vertex, a matrix and their product.
        assert np.abs(built - posed).max() < 2e-5


def test_all_but_grazers_move_between_the_frames(shown):
    for actor in plan_world(tiny(_herd)).actors:
        trunk = next(bone.name for bone in actor.body.bones if len(bone.mesh.points_m))
        first, last = (shown[f"{frame}/{actor.name} {trunk}"] for frame in FRAMES)
        assert actor.group == "grazer" or np.linalg.norm(last - first, axis=1).min() > 1.0
