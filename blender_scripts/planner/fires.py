"""Camp fires of a scene: positions and meshes. Lengths in m."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .geometry.shapes import Mesh, facets, joined
from .land.corridors import Corridor
from .land.dry_places import check_dry_place
from .land.strands import Halo
from .land.terrain import Terrain
from .noise import stream
from .plants.branch_shapes import directions, limb, loft_triangles

MATERIAL, PARTS = "fire", ("embers", "ash", "flames")  # in the order of a mesh's slots
_EMBERS, _ASH, _FLAMES = range(3)
_ASHES_M = 0.5  # around a bed; estimate
_CLEARING_M = 1.0  # around a bed, without plants
_GLOWING = 0.35  # share of a bed, as in thermal_core/heat/body/fire.h
_RINGS, _SIDES, _TONGUES = 4, 14, 7


@dataclass(frozen=True)
class Fire:
    """A fire of the config, at `position_m` on the ground."""

    name: str
    entry: dict
    position_m: np.ndarray

    @property
    def clearing(self) -> Corridor:
        """Where no plants grow."""
        return Corridor(self.position_m[None, :2], 0.5 * self.entry["diameter_m"] + _CLEARING_M)

    @property
    def hearth(self) -> Halo:
        """The ash on its bed and around it."""
        radius_m = 0.5 * self.entry["diameter_m"]
        return Halo(self.position_m[:2], radius_m, radius_m + _ASHES_M, 1.0)

    def state(self) -> dict:
        """Key `fire` of its object in the manifest."""
        return {
            "place_m": self.position_m[:2].tolist(),
            **{key: self.entry[key] for key in ("diameter_m", "state", "since_s")},
        }


def plan_fires(entries: Sequence[dict], terrain: Terrain) -> list[Fire]:
    """The fires of a config; ConfigError if one is not on dry ground of the scene."""
    return [_fire(f"scene.fires[{k}]", f"fire_{k + 1}", entry, terrain) for k, entry in enumerate(entries)]


def flame_height_m(diameter_m: float) -> float:
    """0.235 Q^0.4 - 1.02 D (Heskestad), Q in kW of 15 g/(m^2 s) of wood at 15 MJ/kg: as in heat/body/fire.h."""
    power_kw = 0.015 * 15e3 * np.pi / 4 * diameter_m**2
    return float(max(0.0, 0.235 * power_kw**0.4 - 1.02 * diameter_m))


def fire_mesh(fire: Fire, seed: int) -> Mesh:
    """Its bed, a low heap of embers and ash, and if it burns tongues of flame, at the origin."""
    rng = stream(seed, fire.name)
    diameter_m = fire.entry["diameter_m"]
    meshes = [_bed(0.5 * diameter_m, rng)]
    if fire.entry["state"] == "burning":
        meshes += [_tongue(diameter_m, rng) for _ in range(_TONGUES)]
    return joined(meshes)


def _fire(where: str, name: str, entry: dict, terrain: Terrain) -> Fire:
    place_m = np.array(entry["place"], float)
    check_dry_place(where, place_m, terrain, reach_m=entry["diameter_m"], shore_m=entry["diameter_m"])
    return Fire(name, entry, np.append(place_m, terrain.height_m(*place_m[:, None])))


def _bed(radius_m: float, rng: np.random.Generator) -> Mesh:
    """A dome with uneven rims; some of its facets glow."""
    out = np.linspace(1.0, 0.02, _RINGS + 1)
    angle = 2.0 * np.pi * np.arange(_SIDES) / _SIDES
    reach = radius_m * out[:, None] * rng.uniform(0.9, 1.0, (_RINGS + 1, _SIDES))
    height = 0.35 * radius_m * (1.0 - out**2)[:, None] * rng.uniform(0.7, 1.0, (_RINGS + 1, _SIDES))
    height[0] = -0.1 * radius_m
    points = np.stack([reach * np.cos(angle), reach * np.sin(angle), height], axis=-1).reshape(-1, 3)
    triangles = loft_triangles(_RINGS + 1, _SIDES)
    slot = np.where(rng.uniform(size=len(triangles)) < _GLOWING, _EMBERS, _ASH)
    return Mesh(points, triangles, slot)


def _tongue(diameter_m: float, rng: np.random.Generator) -> Mesh:
    """One flame: wide in its lower half, pointed, leaning a little."""
    foot = np.append(rng.uniform(-0.22, 0.22, 2) * diameter_m, 0.03 * diameter_m)
    tall_m = flame_height_m(diameter_m) * rng.uniform(0.5, 1.0)
    lean = directions(rng, 1)[0] * [0.12, 0.12, 0.0] * tall_m
    path = [foot, foot + [0, 0, 0.4 * tall_m], foot + lean + [0, 0, tall_m]]
    wide_m = rng.uniform(0.08, 0.14) * diameter_m
    mesh = limb(path, [0.8 * wide_m, wide_m, 0.05 * wide_m], 5, closed=True)
    return facets(mesh.points_m, mesh.triangles).with_slot(_FLAMES)
