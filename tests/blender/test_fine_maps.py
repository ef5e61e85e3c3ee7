"""The fine maps of a planned place: as its mesh has it, along its groups' loops, and the same on any cores."""

import numpy as np

from scenes import tiny
from planner.bake.arrays import read
from planner.workers import Cores
from planner.world import plan_world

MAPS = ("kind", "border", "grass", "trodden", "ash")


def test_kinds_agree_with_the_mesh():
    world = plan_world(tiny(_wild_place), with_ground=True)
    fine, mesh = world.ground.fine, world.ground.mesh
    middle_m = mesh.points_m[mesh.triangles].mean(axis=1)
    column, row = (np.clip(((along + 60) / 120 * 240).astype(int), 1, 238) for along in middle_m.T[:2])
    cover = np.where(np.array(mesh.materials)[mesh.cover] == "grass", 0, mesh.cover)
    around = np.stack([fine.kind[row + j, column + i] for i in (-1, 0, 1) for j in (-1, 0, 1)])
    clear = np.ptp(around, axis=0) == 0  # no border within half a metre
    assert clear.mean() > 0.5
    assert np.mean(around[0][clear] == cover[clear]) > 0.995


def test_trails_follow_the_loops_of_groups():
    world = plan_world(tiny(_people_alone), with_ground=True)
    trodden = world.ground.fine.trodden
    loop = world.actors[0].route
    at_m, heading = loop.at(np.linspace(0, loop.length_m, 400))
    left = np.stack([-heading[:, 1], heading[:, 0]], axis=1)
    off_m = np.arange(-4, 4.01, 0.25)
    across_m = at_m[:, None] + off_m[:, None] * left[:, None]
    column, row = (np.floor((across_m[..., k] + 60) / 120 * 240).astype(int) for k in (0, 1))
    most = trodden[row, column].max(axis=1)
    assert np.mean(most > 60) > 0.95
    winding_m = off_m[trodden[row, column].argmax(axis=1)]
    assert 0.2 < winding_m.std() < 2.0
    bare = plan_world(tiny(lambda c: (_people_alone(c), c["scene"].update(groups=[]))), with_ground=True)
    assert bare.ground.fine.trodden[row, column].max(axis=1).mean() < 0.2 * most.mean()


def test_the_baked_scene_has_the_maps_whatever_the_cores(plan):
    header, arrays = read(plan / "scene")
    ground = header["ground"]
    assert ground["fine_cells"] == 240
    one, two = (plan_world(tiny(), Cores(count), with_ground=True).ground.fine for count in (1, 2))
    for name in MAPS:
        assert ground[name] == f"ground/{name}"
        baked = arrays[ground[name]]
        assert baked.dtype == np.uint8 and baked.shape == (240, 240)
        assert np.array_equal(baked, getattr(one, name)) and np.array_equal(baked, getattr(two, name))


def test_mounds_stand_on_bare_ground():
    def mounds(config):
        config["scene"].update(plants={"termite_mound": {"per_ha": 8}}, groups=[])
        config["scene"]["terrain"].update(water_radius_m=0)
        config["clips"].pop()

    world = plan_world(tiny(mounds), with_ground=True)
    points_m = world.plantings["termite_mound"].points_m
    assert len(points_m) > 3
    column, row = np.floor((points_m[:, :2] / 120 + 0.5) * 240).astype(int).T
    assert world.ground.fine.trodden[row, column].min() > 150


def _wild_place(config):
    config["render"]["posed_actors"] = "all"  # so that all of the ground is fine
    config["scene"].update(plants={}, paths={}, groups=[])
    config["scene"]["terrain"].update(craggy_fraction=0.15, road={"width_m": 3.8})
    config["clips"].pop()


def _people_alone(config):
    config["scene"]["plants"] = {}
    config["scene"]["terrain"].update(water_radius_m=0)
    config["scene"]["groups"] = config["scene"]["groups"][:1]
    config["clips"].pop()
