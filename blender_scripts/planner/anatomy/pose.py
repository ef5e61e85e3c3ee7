"""The pose of a body at each moment, from the ground below it, the distance it has walked and the time.

Legs are solved from both ends: hips move with the body, feet stand on the ground, and the two bones between them bend.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..geometry.components import about, applied, dot, facing, product, turned
from ..geometry.shapes import Mesh, joined
from ..land.terrain import Terrain
from .bodies import Body
from .gait import Footing, Path, footing

_NORM = 8  # exponent of a smooth maximum of the legs' needs to be lowered


@dataclass(frozen=True)
class Walker:
    """A body of a given scale on a path over the ground; `phase` offsets everything that moves periodically.

    scale, stride_m and phase are numbers; or (n,), for n moments of several walkers that have this body. Then `path`
    gives the position of each moment's walker.
    """

    body: Body
    scale: float | np.ndarray
    stride_m: float | np.ndarray
    phase: float | np.ndarray
    path: Path
    ground: Terrain


@dataclass(frozen=True)
class Motion:
    """The motion of a walker at n moments.

    walked_m (n,) along its path; time_s (n,); pace (n,) from 0 standing to 1 walking; head_down (n,) from 0 to 1
    grazing; posture: one of the body's postures, `walk` for standing animals too.
    """

    walked_m: np.ndarray
    time_s: np.ndarray
    pace: np.ndarray
    head_down: np.ndarray
    posture: str = "walk"


@dataclass(frozen=True)
class Poses:
    """A body at n moments: vertex v of bone k has world position position_m[:, k] + scale * rotation[:, k] @ v.

    position_m (n, bones, 3), rotation (n, bones, 3, 3), scale (n,).
    """

    position_m: np.ndarray
    rotation: np.ndarray
    scale: np.ndarray

    def points_m(self, body: Body, moment: int) -> np.ndarray:
        """All vertices (v, 3) of the body in world axes."""
        return np.concatenate(
            [
                position + self.scale[moment] * bone.mesh.points_m @ rotation.T
                for bone, position, rotation in zip(
                    body.bones, self.position_m[moment], self.rotation[moment]
                )
            ]
        )

    def extent_m(self, body: Body, origin_m: np.ndarray, axes: np.ndarray) -> np.ndarray:
        """Box (2, 3) that contains the body at all moments: coordinates from origins (3, n) along the columns of `axes`
        (3, 3, n)."""
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        inverse = np.swapaxes(axes, 0, 1)
        for k, bone in enumerate(body.bones):
            if not len(bone.mesh.points_m):
                continue
            x, y, z = bone.mesh.points_m.T
            start = applied(inverse, self.position_m[:, k].T - origin_m)
            along = self.scale * product(inverse, np.moveaxis(self.rotation[:, k], 0, -1))
            weight = along[..., None]
            reach = weight[:, 0] * x + weight[:, 1] * y + weight[:, 2] * z  # (3, n, vertices)
            low = np.minimum(low, (start + reach.min(axis=-1)).min(axis=1))
            high = np.maximum(high, (start + reach.max(axis=-1)).max(axis=1))
        return np.stack([low, high])

    def mesh(self, body: Body, moment: int) -> Mesh:
        """The body in world axes."""
        whole = joined([bone.mesh for bone in body.bones])
        return Mesh(self.points_m(body, moment), whole.triangles, whole.slot)


def pose(walker: Walker, motion: Motion) -> Poses:
    """The walker's body at each moment of a motion."""
    body, scale = walker.body, walker.scale
    posture = body.postures[motion.posture]
    origin, carriage, residues = _carriage(walker, motion)
    origin[2] -= scale * posture.sink_m
    origin += scale * applied(carriage, posture.shift_m[:, None])
    on_feet = posture.on_feet and len(body.legs) > 0
    bones = body.unsupported if on_feet else range(len(body.bones))
    position, rotation = _hung(walker, motion, origin, carriage, bones)
    for wheel, residue in zip(body.wheels, residues[len(body.legs) :]):
        position[2, wheel.bone] += residue
    if on_feet:
        _set_legs(walker, motion, position, rotation)
    scales = np.broadcast_to(np.asarray(scale, float), motion.walked_m.shape)
    return Poses(position.transpose(2, 1, 0), rotation.transpose(3, 2, 0, 1), scales)


def feet(walker: Walker, motion: Motion) -> Footing:
    """The feet of all legs at each moment."""
    body = walker.body
    placed = np.column_stack([body.postures[motion.posture].feet_m, np.zeros(len(body.legs))])
    return footing(
        [replace(leg, toe_m=leg.toe_m + by_m) for leg, by_m in zip(body.legs, placed)],
        body.stance,
        walker.stride_m,
        walker.scale,
        walker.path,
        walker.ground,
        motion.walked_m,
        motion.pace,
    )


def _carriage(walker: Walker, motion: Motion):
    """The position (3, n) and rotation (3, 3, n) of the body, and the height (contacts, n) of the ground at each of its
    contacts above the plane it stands on."""
    body, scale = walker.body, walker.scale
    point, heading = (np.moveaxis(part, -1, 0) for part in walker.path(motion.walked_m))
    level = facing(heading)
    contacts = (
        scale * body.contacts_m(motion.posture)[..., None]
    )  # (contacts, 2, 1), or with n moments if scales differ
    middle = contacts.mean(axis=0)
    at = point + (contacts[:, :1] * heading + contacts[:, 1:] * np.stack([-heading[1], heading[0]]))
    height = _bearing_m(walker, motion.posture, at[:, 0], at[:, 1])
    x, y = np.swapaxes(contacts - middle, 0, 1)
    pitch, roll = _slope(height, x), _slope(height, y)
    mean = np.ascontiguousarray(height.T).mean(axis=1)  # one memory layout gives one order of sums
    residues = height - (mean + pitch * x + roll * y)
    share = (1.0, 1.0) if body.postures[motion.posture].rests_m else (body.pitch, body.roll)
    own = product(about("y", -np.arctan(share[0] * pitch)), about("x", np.arctan(share[1] * roll)))
    # The body turns about the middle of its hips, which keeps them above the feet on a slope.
    hip_m = np.mean([body.bones[leg.bones[0]].joint_m[2] for leg in body.legs] or 0.0)
    pivot = np.stack(np.broadcast_arrays(*middle, scale * hip_m))
    origin = np.stack([*point, mean]) + applied(level, pivot - applied(own, pivot))
    return origin, product(level, own), residues


def _bearing_m(walker: Walker, posture: str, x_m, y_m) -> np.ndarray:
    """Height of the surface that supports a body: the ground, or the water for a floating body."""
    waterline_m = walker.body.postures[posture].waterline_m
    ground_m = walker.ground.height_m(x_m, y_m)
    if waterline_m is None:
        return ground_m
    return np.maximum(ground_m, walker.ground.surface_m(x_m, y_m) - walker.scale * waterline_m)


def _slope(height: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Least-squares slopes (n,) of heights (m, n) at positions (m, 1) or (m, n) with mean 0; 0 if all are equal."""
    spread = dot(place, place)
    return dot(height, place) / np.maximum(spread, 1e-9) * (spread > 1e-6)


def _hung(
    walker: Walker, motion: Motion, origin: np.ndarray, carriage: np.ndarray, bones: Sequence[int]
) -> tuple[np.ndarray, np.ndarray]:
    """Positions (3, all bones, n) and rotations (3, 3, all bones, n), those of `bones` from their joint angles."""
    body, scale = walker.body, walker.scale
    own = turned(_angles_rad(walker, motion)[:, bones])
    position = np.zeros((3, len(body.bones), own.shape[-1]))
    rotation = np.zeros((3,) + position.shape)
    for k, turn in zip(bones, np.moveaxis(own, 2, 0)):
        parent, joint_m = body.bones[k].parent, body.bones[k].joint_m
        if parent < 0:
            base, hung = origin, carriage
        else:
            base, hung = position[:, parent], rotation[:, :, parent]
            joint_m = joint_m - body.bones[parent].joint_m
        position[:, k] = base + scale * applied(hung, joint_m)
        rotation[:, :, k] = product(hung, turn)
    return position, rotation


def _angles_rad(walker: Walker, motion: Motion) -> np.ndarray:
    """Joint angles (3, bones, n) of all bones."""
    body = walker.body
    angles = motion.head_down * body.postures["graze"].turn_rad.T[..., None]
    angles += body.postures[motion.posture].turn_rad.T[..., None]
    for move in body.moves:
        if move.period_s is not None:
            turns = motion.time_s / move.period_s + walker.phase
            strength = 1.0
        else:
            turns = move.per_stride * motion.walked_m / walker.stride_m
            strength = motion.pace
        angles[move.axis, move.bone] += strength * move.angle_rad * np.sin(2 * np.pi * (turns + move.phase))
    for wheel in body.wheels:
        angles[1, wheel.bone] += motion.walked_m / (walker.scale * wheel.radius_m)
    return angles


def _set_legs(walker: Walker, motion: Motion, position: np.ndarray, rotation: np.ndarray) -> None:
    """Place the feet, lower the body until every leg reaches its foot, and bend the knees in between."""
    limbs, scale = walker.body.limbs, walker.scale
    foot = feet(walker, motion)
    ankle_m = foot.toe_m + scale * applied(foot.rotation, limbs.ankle_m)
    turn = rotation[:, :, limbs.parents]
    hip_m = position[:, limbs.parents] + scale * applied(turn, limbs.hip_m)
    below_m = position[:, :1] + scale * applied(rotation[:, :, :1], limbs.toe_m)
    hip_m[:2] += limbs.glide * (foot.toe_m - below_m)[:2]
    needs_m = np.maximum(limbs.needs_m(ankle_m - hip_m, scale), 0.0)
    lowered_m = sum(needs_m**_NORM) ** (1.0 / _NORM)
    position[2, walker.body.borne] -= lowered_m
    hip_m[2] -= lowered_m
    knee_m, upper, lower = limbs.bent(hip_m, ankle_m, turn, scale)
    position[:, limbs.uppers], position[:, limbs.lowers], position[:, limbs.feet] = hip_m, knee_m, ankle_m
    rotation[:, :, limbs.uppers], rotation[:, :, limbs.lowers] = upper, lower
    rotation[:, :, limbs.feet] = foot.rotation
