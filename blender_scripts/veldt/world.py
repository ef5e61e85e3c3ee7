"""Everything a config's scene holds, planned and numbered, before anything is built in Blender."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import assets, checks, ids
from .actors import Actor, plan_actors
from .bodies import part_names
from .camera import Intrinsics, intrinsics_of, overscan_of, widened
from .density import plan_density
from .flight import Flight, fly
from .placement import Corridor, Planting, Site, place_plants
from .splines import Loop
from .terrain import Terrain, build_terrain

SOIL, GRASS, WATER = ("soil", ""), ("grass", ""), ("water", "")


@dataclass(frozen=True)
class World:
    """The scene of a config; plantings by species name, material indices by (material, part)."""

    config: dict
    intrinsics: Intrinsics
    overscan_px: int
    terrain: Terrain
    plantings: dict[str, Planting]
    plant_indices: dict[str, int]
    actors: list[Actor]
    material_indices: dict[tuple[str, str], int]

    @property
    def passes_intrinsics(self) -> Intrinsics:
        """The pinhole camera whose picture the passes are, as fine as the camera's."""
        return widened(self.intrinsics, self.overscan_px)

    def flight(self, clip: dict) -> Flight:
        """The flight of one of the config's clips."""
        target = clip["flight"].get("target")
        return fly(
            clip, self.terrain, [actor for actor in self.actors if target in (actor.name, actor.group)]
        )


def plan_world(config: dict) -> World:
    """Plans the scene of a config with defaults; ConfigError where the config cannot be meant."""
    checks.check_names(config)
    scene, seed = config["scene"], config["seed"]
    checks.check_size(scene)
    checks.check_plants(scene)
    loops = {name: Loop(path["points_m"]) for name, path in scene["paths"].items()}
    checks.check_paths(scene, loops)
    actors = plan_actors(scene["groups"], loops, seed)
    terrain = build_terrain(scene["terrain"], seed)
    areas = plan_density(terrain, scene["terrain"], seed)
    corridors = [_corridor(group, loops[group["path"]]) for group in scene["groups"]]
    world = World(
        config=config,
        intrinsics=intrinsics_of(config["camera"]),
        overscan_px=overscan_of(config),
        terrain=terrain,
        plantings=place_plants(scene["plants"], Site(terrain, areas.shares, corridors=corridors), seed),
        plant_indices=ids.plan_plant_indices(sorted(scene["plants"])),
        actors=actors,
        material_indices=ids.plan_material_indices(_materials(scene["plants"], actors)),
    )
    for k, clip in enumerate(config["clips"]):
        checks.check_flight(f"clips[{k}]", world.flight(clip))
    return world


def clip_of(config: dict, clip_id: str) -> dict:
    """The config's clip of that id."""
    known = {clip["id"]: clip for clip in config["clips"]}
    return checks.known(known, clip_id, "--clip", "a clip of the config")


def _corridor(group: dict, loop: Loop) -> Corridor:
    points, _ = loop.at(np.linspace(0.0, loop.length_m, int(loop.length_m) + 2))
    return Corridor(points, group["spread_m"])


def _materials(plants: dict, actors: list[Actor]) -> list[tuple[str, str]]:
    """Every (material, part) of the scene, the place's first."""
    pairs = [SOIL, GRASS, WATER, *((assets.load("plants", name)["material"], "") for name in sorted(plants))]
    for species in dict.fromkeys(actor.species for actor in actors):
        data = assets.load("species", species)
        pairs += [(data["material"], part) for part in part_names(data)]
    return pairs
