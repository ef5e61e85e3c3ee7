"""The legs of a body between its hips and its feet: two bones each, with a knee that bends as it is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.components import applied, cross, dot, frame, length, product, unit
from .gait import Leg
from .skeleton import Bone

_LONGEST = 0.995  # of a leg's two bones: knees are never fully straight


@dataclass(frozen=True)
class Limbs:
    """All legs of a body as drawn.

    Indices (legs,) of their upper bones, the bones that these hang from, their lower bones and feet. Vectors
    (3, legs, 1) in body axes: hip_m from the joint of the bone it hangs from, toe_m from the body's first joint,
    ankle_m from the toe, and out, to which the knee bends. Lengths (legs, 1) of both bones. Rotations (3, 3, legs, 1):
    inverses of the frames of both bones, with an axis along the bone and one along the knee's hinge.
    """

    uppers: np.ndarray
    parents: np.ndarray
    lowers: np.ndarray
    feet: np.ndarray
    hip_m: np.ndarray
    toe_m: np.ndarray
    ankle_m: np.ndarray
    out: np.ndarray
    glide: np.ndarray
    thigh_m: np.ndarray
    shank_m: np.ndarray
    thigh_axes: np.ndarray
    shank_axes: np.ndarray

    def needs_m(self, reach_m: np.ndarray, scale) -> np.ndarray:
        """How far (legs, n) hips must be lowered for legs to reach ankles at offsets (3, legs, n) from them."""
        longest_m = scale * (self.thigh_m + self.shank_m) * _LONGEST
        shortest_m = 0.2 * longest_m
        height2 = longest_m * longest_m - dot(reach_m[:2], reach_m[:2])
        return -reach_m[2] - np.sqrt(np.maximum(height2, shortest_m * shortest_m))

    def bent(self, hip_m: np.ndarray, ankle_m: np.ndarray, turn: np.ndarray, scale):
        """Knees (3, legs, n), and rotations (3, 3, legs, n) of the upper and the lower bones (law of cosines).

        hip_m and ankle_m (3, legs, n); turn (3, 3, legs, n): the rotations of the bones that the legs hang from.
        """
        thigh_m, shank_m = scale * self.thigh_m, scale * self.shank_m
        reach_m = ankle_m - hip_m
        nearest_m = 1.001 * np.abs(thigh_m - shank_m) + 1e-6
        far_m = np.clip(length(reach_m), nearest_m, 0.9999 * (thigh_m + shank_m))
        along, out = unit(reach_m), applied(turn, self.out)
        out = unit(out - dot(out, along) * along)
        cos = (thigh_m * thigh_m + far_m * far_m - shank_m * shank_m) / (2.0 * thigh_m * far_m)
        cos = np.clip(cos, -1.0, 1.0)
        knee_m = hip_m + thigh_m * (cos * along + np.sqrt(1.0 - cos * cos) * out)
        hinge = cross(along, out)
        upper = product(frame(unit(knee_m - hip_m), hinge), self.thigh_axes)
        return knee_m, upper, product(frame(unit(ankle_m - knee_m), hinge), self.shank_axes)


def limbs_of(legs: Sequence[Leg], bones: Sequence[Bone]) -> Limbs:
    """The legs of a body."""
    uppers, lowers, feet = np.array([leg.bones for leg in legs], np.int64).T
    parents = np.array([bones[upper].parent for upper in uppers], np.int64)
    joints_m = np.array([bone.joint_m for bone in bones]).T[..., None]
    hip_m, knee_m, ankle_m = (joints_m[:, part] for part in (uppers, lowers, feet))
    toe_m = np.array([leg.toe_m for leg in legs]).T[..., None]
    thigh, shank, along = knee_m - hip_m, ankle_m - knee_m, unit(ankle_m - hip_m)
    out = unit(thigh - dot(thigh, along) * along)
    hinge = cross(along, out)
    return Limbs(
        uppers=uppers,
        parents=parents,
        lowers=lowers,
        feet=feet,
        hip_m=hip_m - joints_m[:, parents],
        toe_m=toe_m - joints_m[:, :1],
        ankle_m=ankle_m - toe_m,
        out=out,
        glide=np.array([leg.glide for leg in legs])[:, None],
        thigh_m=length(thigh),
        shank_m=length(shank),
        thigh_axes=np.swapaxes(frame(unit(thigh), hinge), 0, 1),
        shank_axes=np.swapaxes(frame(unit(shank), hinge), 0, 1),
    )
