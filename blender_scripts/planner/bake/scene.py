"""Write the baked scene of a world: meshes, instances of plants, actors' bodies, and maps of the ground."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .. import assets, fires, ids
from ..anatomy.skeleton import has_own_shapes, part_names
from ..camera import DEPTH_RANGE_M
from ..geometry.shapes import Mesh, facets
from ..groups.actors import Actor
from ..groups.beds import plan_beds
from ..groups.conditions import condition
from ..land.covers import SOIL
from ..land.ground import GroundMesh
from ..land.ground_maps import Ground
from ..land.waters import Water
from ..plants.canopy import canopy
from ..plants.placement import Planting
from ..plants.plant_shapes import build_variants, slots_of
from ..world import WATER, World
from .arrays import write
from .forms import SCENE, VERSION

_SHEET_CORNERS = 64

# The mesh of a user's model: called with the asset file, for messages, and its content.
ModelMesh = Callable[[str, dict], Mesh]


@dataclass
class _Meshes:
    """Meshes of the scene, and their arrays."""

    materials: Mapping[tuple[str, str], int]
    entries: list[dict] = field(default_factory=list)
    arrays: dict[str, np.ndarray] = field(default_factory=dict)

    def add(self, name: str, mesh: Mesh, slots: Sequence[tuple[str, str]], smooth: bool) -> int:
        """Add a mesh whose slot k has the k-th (material, part); returns its number."""
        number = len(self.entries)
        keys = {kind: f"meshes/{number}/{kind}" for kind in ("points_m", "triangles", "material_index")}
        material_of_slot = np.array([self.materials[slot] for slot in slots], "<u2")
        self.arrays[keys["points_m"]] = mesh.points_m.astype("<f4")
        self.arrays[keys["triangles"]] = mesh.triangles.astype("<u4")
        self.arrays[keys["material_index"]] = material_of_slot[mesh.slot]
        self.entries.append({"name": name, "smooth": smooth, **keys})
        return number


def bake_scene(world: World, model_mesh: ModelMesh, path: Path) -> None:
    """Write `path`.json and `path`.bin; the world must have its ground."""
    assert world.ground is not None and world.ground.fine is not None
    meshes = _Meshes(world.material_indices)
    surfaces = [
        _ground(world.ground.mesh, meshes),
        *(_water(water, meshes) for water in world.terrain.waters),
    ]
    plants, placed = _all_plants(world, model_mesh, meshes)
    bodies: dict[tuple[str, str, str], list[dict]] = {}
    actors = [_actor(actor, bodies, model_mesh, meshes) for actor in world.actors]
    maps = _maps(world, world.ground)
    beds = plan_beds(world.config["scene"]["groups"], world.actors, world.terrain, world.config["seed"])
    header = {
        "format": SCENE,
        "version": VERSION,
        "name": world.config["name"],
        "seed": world.config["seed"],
        "camera": world.config["camera"],
        "view_margin_px": world.view_margin_px,
        "depth_range_m": list(DEPTH_RANGE_M),
        "materials": _materials(world),
        "mirrors": _mirrors(world),
        "objects": [*_place(world), *_cast(world)],
        "meshes": meshes.entries,
        "surfaces": surfaces,
        "plants": plants,
        "actors": actors,
        **({"beds": beds} if beds else {}),
        "ground": {
            "size_m": world.terrain.size_m,
            "cells": len(world.ground.height_m) - 1,
            "covers": list(world.ground.mesh.materials),
            "fine_cells": len(world.ground.fine.kind),
            **{name: f"ground/{name}" for name in maps},
        },
    }
    write(path, header, meshes.arrays | placed | {f"ground/{name}": array for name, array in maps.items()})


def _maps(world: World, ground: Ground) -> dict[str, np.ndarray]:
    shore = {} if ground.shore_m is None else {"shore_m": ground.shore_m}
    return {
        "height_m": ground.height_m,
        "cover": ground.cover,
        "canopy": canopy(world.terrain, world.plantings),
        **shore,
        **vars(ground.fine),
    }


def _ground(ground: GroundMesh, meshes: _Meshes) -> dict:
    slots = [(material, "") for material in ground.materials]
    mesh = Mesh(ground.points_m, ground.triangles, ground.cover)
    return {"object": ids.GROUND, "mesh": meshes.add("ground", mesh, slots, smooth=True)}


def _water(water: Water, meshes: _Meshes) -> dict:
    """A flat disc; its rim lies below the banks, so the ground's intersection with it is the shoreline."""
    angle = 2.0 * np.pi * np.arange(_SHEET_CORNERS) / _SHEET_CORNERS
    rim = water.basin.centre_m + water.basin.disc_radius_m * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points = np.column_stack([rim, np.full(_SHEET_CORNERS, water.level_m)])
    fan = facets(points, np.array([[0, k, k + 1] for k in range(1, _SHEET_CORNERS - 1)]))
    return {"object": ids.WATER, "mesh": meshes.add("water", fan, [(WATER, "")], smooth=True)}


def _all_plants(
    world: World, model_mesh: ModelMesh, meshes: _Meshes
) -> tuple[list[dict], dict[str, np.ndarray]]:
    """Instance tables of plant species and fires, and their arrays."""
    entries, arrays = [], {}
    for name, planting in world.plantings.items():
        if len(planting.scale) == 0:
            continue
        first = _variants(name, world.config["seed"], model_mesh, meshes)
        keys = {kind: f"plants/{name}/{kind}" for kind in ("transform", "mesh")}
        arrays[keys["transform"]] = _transforms(planting)
        arrays[keys["mesh"]] = (first + planting.variant).astype("<u4")
        entries.append({"name": name, "object": world.plant_indices[name], **keys})
    slots = [(fires.MATERIAL, part) for part in fires.PARTS]
    for fire, index in zip(world.fires, world.fire_indices):
        number = meshes.add(fire.name, fires.fire_mesh(fire, world.config["seed"]), slots, smooth=False)
        keys = {kind: f"fires/{fire.name}/{kind}" for kind in ("transform", "mesh")}
        arrays[keys["transform"]] = np.eye(3, 4)[None] + [0.0, 0.0, 0.0, 1.0] * fire.position_m[:, None]
        arrays[keys["mesh"]] = np.array([number], "<u4")
        entries.append({"name": fire.name, "object": index, **keys})
    return entries, arrays


def _variants(name: str, seed: int, model_mesh: ModelMesh, meshes: _Meshes) -> int:
    """Add the meshes of a species' variants at its drawn size, standing at the origin; returns the first's number."""
    data = assets.standing(name)
    if "model" in data:
        variants = [model_mesh(f"assets/plants/{name}.json", data)]
    else:
        variants = build_variants(name, data, seed)
    return [meshes.add(name, mesh, slots_of(data), smooth=False) for mesh in variants][0]


def _transforms(planting: Planting) -> np.ndarray:
    """Matrices (n, 3, 4) that turn a plant about z, scale it, and move it to its root.

    Angle and scale are single-precision numbers, which can be restored exactly from the double-precision matrix:
    Blender uses them, ray tracers use the matrix.
    """
    turn = planting.yaw_rad.astype(np.float32).astype(float)
    scale = planting.scale.astype(np.float32).astype(float)
    cos, sin = scale * np.cos(turn), scale * np.sin(turn)
    transforms = np.zeros((len(scale), 3, 4))
    transforms[:, 0, 0], transforms[:, 0, 1] = cos, -sin
    transforms[:, 1, 0], transforms[:, 1, 1] = sin, cos
    transforms[:, 2, 2] = scale
    transforms[:, :, 3] = planting.points_m
    return transforms


def _actor(
    actor: Actor, bodies: dict[tuple[str, str, str], list[dict]], model_mesh: ModelMesh, meshes: _Meshes
) -> dict:
    """An actor and its bones that have a mesh; actors of the same appearance share meshes."""
    own = has_own_shapes(assets.load("species", actor.species), actor.posture)
    kind = actor.species, actor.variant, actor.posture if own else ""
    if kind not in bodies:
        bodies[kind] = _body(actor, model_mesh, meshes)
    return {
        "object": actor.index,
        "name": actor.name,
        "group": actor.group,
        "bones": bodies[kind],
    }


def _body(actor: Actor, model_mesh: ModelMesh, meshes: _Meshes) -> list[dict]:
    data = assets.load("species", actor.species)
    slots = [(data["material"], part) for part in part_names(data)]
    if "model" in data:
        mesh = model_mesh(f"assets/species/{actor.species}.json", data)
        return [{"name": "model", "mesh": meshes.add(f"{actor.species} model", mesh, slots, smooth=False)}]
    return [
        {
            "name": bone.name,
            "mesh": meshes.add(f"{actor.species} {bone.name}", bone.mesh, slots, smooth=True),
        }
        for bone in actor.body.bones
        if len(bone.mesh.triangles) > 0
    ]


def _materials(world: World) -> list[dict]:
    return [
        {"index": index, "material": material} | ({"part": part} if part else {})
        for (material, part), index in world.material_indices.items()
    ]


def _mirrors(world: World) -> list[str]:
    """The materials in which the scene is seen."""
    listed = sorted({material for material, _ in world.material_indices})
    return [name for name in listed if assets.load("materials", name).get("angular") == "water"]


def _place(world: World) -> list[dict]:
    """Ground, and the water, plants and fires of the scene, if any."""
    place = [{"index": ids.GROUND, "name": "ground", "class": "ground", "material": SOIL}]
    if world.terrain.waters:
        place.append({"index": ids.WATER, "name": "water", "class": "water", "material": WATER})
    for name, index in world.plant_indices.items():
        if len(world.plantings[name].scale) > 0:
            material = slots_of(assets.standing(name))[0][0]
            place.append({"index": index, "name": name, "class": "plant", "material": material})
    for fire, index in zip(world.fires, world.fire_indices):
        thing = {"index": index, "name": fire.name, "class": "plant", "material": fires.MATERIAL}
        place.append(thing | {"fire": fire.state()})
    return place


def _cast(world: World) -> list[dict]:
    """Every actor, with its engine or bath from the config."""
    groups = {group["name"]: group for group in world.config["scene"]["groups"]}
    member: dict[str, int] = {}
    objects = []
    for actor in world.actors:
        k = member[actor.group] = member.get(actor.group, -1) + 1
        objects.append(_object(actor) | condition(groups[actor.group], k, world.config["seed"]))
    return objects


def _object(actor: Actor) -> dict:
    species = assets.load("species", actor.species)
    return {
        "index": actor.index,
        "name": actor.name,
        "class": "actor",
        "material": species["material"],
        "category": species["category"],
        "species": actor.species,
        "track_id": actor.index,
        "bounds_m": (np.round(actor.bounds_m, 6) + 0.0).tolist(),
    }
