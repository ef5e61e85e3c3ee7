"""Bare ground about the mounds of termites, which cut the grass around them. Lengths in m."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from .. import assets
from ..land.fine_covers import FineCovers
from ..land.fine_grid import FineGrid
from ..land.strands import Halo, lay_halos
from ..land.terrain import Terrain
from .placement import Planting

_MOUND = "termite_mound"
_BARE = (0.8, 4.5)  # beyond a mound of drawn size: end of the bare ring, and of its ramp; estimates
_SHARE = 0.85


def with_halos(
    fine: FineCovers, plantings: Mapping[str, Planting], terrain: Terrain, seed: int
) -> FineCovers:
    """The fine maps with trodden ground around all mounds."""
    if _MOUND not in plantings:
        return fine
    mounds, foot_m = plantings[_MOUND], assets.standing(_MOUND)["foot_m"]
    halos = [
        Halo(point_m[:2], *(scale * (foot_m + bare_m) for bare_m in _BARE), _SHARE)
        for point_m, scale in zip(mounds.points_m, mounds.scale)
    ]
    trodden = fine.trodden.copy()
    lay_halos(trodden, FineGrid(terrain.size_m), halos, seed)
    return replace(fine, trodden=trodden)
