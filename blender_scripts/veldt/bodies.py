"""Bodies of actors, built from the shapes a species file lists.

Actor axes: x forward, y left, z up, origin on the ground below the body's middle. A body is a rigid trunk and rigid
limbs, each turning about the y axis through its own joint.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from . import assets
from .gait import swing_rad
from .shapes import Mesh, ellipsoid, joined, tube

_BOUND_PHASES = 32  # of a stride, over which a body's box is taken


@dataclass(frozen=True)
class Limb:
    """A mesh about its joint, which is at joint_m of the body; phase 0..1 of the stride, swing in leg swings."""

    mesh: Mesh
    joint_m: tuple[float, float, float]
    phase: float
    swing: float


@dataclass(frozen=True)
class Body:
    """A species' body at its reference size; material slots of all meshes count through `parts`."""

    parts: tuple[str, ...]
    trunk: Mesh
    limbs: tuple[Limb, ...]
    leg_m: float
    stride_m: float

    def limb_angles_rad(self, stride: float) -> list[float]:
        """Rotation of each limb about y, positive swinging it backward, `stride` strides into the walk."""
        return [
            limb.swing * float(swing_rad(stride + limb.phase, self.stride_m, self.leg_m))
            for limb in self.limbs
        ]

    def posed(self, stride: float) -> Mesh:
        """The whole body in actor axes, `stride` strides into the walk."""
        return joined([self.trunk, *map(_turned, self.limbs, self.limb_angles_rad(stride))])

    def bounds_m(self) -> np.ndarray:
        """Lowest and highest corner (2, 3) of the box that holds the body at every moment of its stride."""
        poses = [self.posed(k / _BOUND_PHASES).points_m for k in range(_BOUND_PHASES)]
        return np.stack(
            [np.min([p.min(axis=0) for p in poses], axis=0), np.max([p.max(axis=0) for p in poses], axis=0)]
        )


@lru_cache(maxsize=None)
def build_body(species: str) -> Body:
    """The body in `assets/species/<species>.json`."""
    data = assets.load("species", species)
    parts = part_names(data)
    trunk = joined([mesh for shape in data["shapes"] for mesh in _solids(shape, parts)])
    limbs = tuple(limb for entry in data["limbs"] for limb in _limb_pair(entry, parts))
    return Body(parts, trunk, limbs, data["gait"]["leg_m"], data["gait"]["stride_m"])


def part_names(data: dict) -> tuple[str, ...]:
    """Names of a species' parts in the order its file first mentions them."""
    shapes = data["shapes"] + [shape for limb in data["limbs"] for shape in limb["shapes"]]
    return tuple(dict.fromkeys(shape["part"] for shape in shapes))


def _solids(shape: dict, parts: tuple[str, ...]) -> list[Mesh]:
    """A shape's mesh in its part's slot, and its mirror image if it has one."""
    mesh = _solid(shape).with_slot(parts.index(shape["part"]))
    return [mesh, mesh.mirrored()] if shape.get("mirror", False) else [mesh]


def _solid(shape: dict) -> Mesh:
    if "tube_m" in shape:
        return tube(np.array(shape["tube_m"]), roundness=shape.get("roundness", 0.5))
    return ellipsoid(
        shape["centre_m"], shape["radii_m"], shape.get("yaw_deg", 0.0), shape.get("tilt_deg", 0.0)
    )


def _limb_pair(entry: dict, parts: tuple[str, ...]) -> list[Limb]:
    """The left limb as drawn, and the right one, its mirror image with its own phase."""
    x_m, y_m, z_m = entry["joint_m"]
    left = joined([mesh for shape in entry["shapes"] for mesh in _solids(shape, parts)]).moved(
        [-x_m, -y_m, -z_m]
    )
    return [
        Limb(left, (x_m, y_m, z_m), entry["phases"][0], entry["swing"]),
        Limb(left.mirrored(), (x_m, -y_m, z_m), entry["phases"][1], entry["swing"]),
    ]


def _turned(limb: Limb, angle_rad: float) -> Mesh:
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)
    about_y = np.array([[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]])
    return Mesh(limb.mesh.points_m @ about_y.T + limb.joint_m, limb.mesh.triangles, limb.mesh.slot)
