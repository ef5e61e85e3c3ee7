"""View of a scene from above, for the budget of physical terms: shares of its materials, and species of actors."""

from __future__ import annotations

import numpy as np

from . import assets
from .land.covers import SOIL
from .plants.plant_shapes import slots_of
from .world import WATER, World

_MOST = 0.9  # largest share of the ground that plants of one species hide, since crowns overlap


def outline_of(world: World) -> dict:
    """`covers`: the share of each material seen from straight above, which add up to 1; `actors`: their materials.

    Shares of the ground are those of `Terrain.samples`. Crowns of different species are assumed to hide each other at
    random, the widest being the tallest.
    """
    shares = _ground_shares(world)
    dry = 1.0 - shares.get(WATER, 0.0)
    open_ground = 1.0
    for material, _, share in sorted(_crowns(world, dry), key=lambda crown: -crown[1]):
        shares[material] = shares.get(material, 0.0) + dry * open_ground * share
        open_ground *= 1.0 - share
    for name in _ground_names(world):
        shares[name] *= open_ground
    species = dict.fromkeys(actor.species for actor in world.actors)
    materials = {assets.load("species", name)["material"] for name in species}
    covers = {name: round(share, 6) for name, share in sorted(shares.items()) if share > 0}
    return {"covers": covers, "actors": sorted(materials)}


def _ground_names(world: World) -> list[str]:
    return [SOIL, *(layer.material for layer in world.covers)]


def _ground_shares(world: World) -> dict[str, float]:
    """Shares of the scene without its plants: of water, and of soil and its covers; where covers overlap, the first
    wins.
    """
    terrain = world.terrain
    x_m, y_m = (along_m.ravel() for along_m in terrain.samples())
    bare = np.ones(len(x_m), bool)
    shares = {}
    if terrain.waters:
        wet = terrain.shore_m(x_m, y_m) < 0
        shares[WATER] = wet.mean()
        bare &= ~wet
    for layer in world.covers:
        laid = bare & (layer.value(x_m, y_m) > 0)
        shares[layer.material] = laid.mean()
        bare &= ~laid
    return {name: float(share) for name, share in {**shares, SOIL: bare.mean()}.items()}


def _crowns(world: World, dry: float) -> list[tuple[str, float, float]]:
    """For each species: its material, the area of one crown in m2, and the share of dry ground below all of them."""
    dry_m2 = dry * world.terrain.size_m**2
    crowns = []
    for name, planting in world.plantings.items():
        data = assets.standing(name)
        hidden_m2 = data["cover_m2"] * float((planting.scale**2).sum())
        crowns.append((slots_of(data)[0][0], data["cover_m2"], min(_MOST, hidden_m2 / max(dry_m2, 1.0))))
    return crowns
