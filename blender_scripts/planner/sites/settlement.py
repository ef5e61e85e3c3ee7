"""A settlement of the config: its position, and random streams for its layout. Lengths in m."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .. import assets
from ..faults import ConfigError, check_known
from ..geometry.rotations import any_heading
from ..land.dry_places import check_dry_place
from ..land.terrain import Terrain
from ..noise import stream


@dataclass(frozen=True)
class Settlement:
    """A site of the config: the rules of its kind, its centre (2,), its size, and its heading."""

    name: str
    rules: dict
    middle_m: np.ndarray
    radius_m: float
    heading_rad: float
    density: float
    seed: int

    def stream(self, *entity) -> np.random.Generator:
        """The random generator of one object of this site."""
        what, *numbers = entity
        return stream(self.seed, f"site/{self.name}/{what}", *numbers)

    def count(self, rng: np.random.Generator, rule: dict) -> int:
        """Number of a rule's objects: between both of its numbers, times the density."""
        least, most = rule.get("count", [1, 1])
        return round(self.density * rng.integers(least, most + 1))

    def draw_place(self, rng: np.random.Generator, ring: Sequence[float]) -> np.ndarray:
        """A point (2,) between two distances from the centre, in radii, uniform over that area."""
        inner, outer = ring
        away_m = self.radius_m * np.sqrt(inner**2 + (outer**2 - inner**2) * rng.uniform())
        return self.middle_m + away_m * any_heading(rng)


def plan_settlements(entries: Sequence[dict], terrain: Terrain, seed: int) -> list[Settlement]:
    """The sites of a config; ConfigError if one is of an unknown kind, or not on dry ground of the scene."""
    names = [entry.get("name", f"{entry['kind']}_{k + 1}") for k, entry in enumerate(entries)]
    for k, name in enumerate(names):
        if name in names[:k]:
            raise ConfigError(f'scene.sites[{k}].name = "{name}"; expected a name no other site has')
    return [
        _settlement(f"scene.sites[{k}]", names[k], entry, terrain, seed) for k, entry in enumerate(entries)
    ]


def _settlement(where: str, name: str, entry: dict, terrain: Terrain, seed: int) -> Settlement:
    check_known(entry["kind"], assets.names("sites"), f"{where}.kind", "a kind of site")
    rules = assets.load("sites", entry["kind"])
    radius_m = float(entry.get("radius_m", rules["radius_m"]))
    middle_m = np.array(entry["place"], float)
    note = f" for radius_m = {radius_m:g} m"
    check_dry_place(where, middle_m, terrain, reach_m=radius_m, shore_m=0.0, note=note)
    heading_rad = stream(seed, f"site/{name}/heading").uniform() * 2.0 * np.pi
    if "heading_deg" in entry:  # clockwise from north, as all headings of a config
        heading_rad = np.radians(90.0 - entry["heading_deg"])
    return Settlement(name, rules, middle_m, radius_m, heading_rad, entry.get("density", 1.0), seed)
