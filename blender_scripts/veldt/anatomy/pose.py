"""The pose of a body at each moment, from the ground below it, the distance it has walked and the time.

Legs are solved from both ends: hips move with the body, feet stand on the ground, and the two bones between them bend.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.rotations import about, applied, facing, frame, turned, unit
from ..geometry.shapes import Mesh, joined
from ..land.terrain import Terrain
from .bodies import Body
from .gait import Footing, Path, footing

_LONGEST = 0.995  # of a leg's two bones: a knee is never quite straight
_NORM = 8  # of the legs' needs to be nearer to the ground: about the largest of them, without its kinks


@dataclass(frozen=True)
class Walker:
    """A body of a given scale on a path over the ground; `phase` offsets everything that moves periodically."""

    body: Body
    scale: float
    stride_m: float
    phase: float
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
    """A body at n moments: vertex v of bone k has world position position_m[:, k] + scale * rotation[:, k] @ v."""

    position_m: np.ndarray
    rotation: np.ndarray
    scale: float

    def points_m(self, body: Body, moment: int) -> np.ndarray:
        """All vertices (v, 3) of the body in the world."""
        return np.concatenate(
            [
                position + self.scale * bone.mesh.points_m @ rotation.T
                for bone, position, rotation in zip(
                    body.bones, self.position_m[moment], self.rotation[moment]
                )
            ]
        )

    def extent_m(self, body: Body, origin_m: np.ndarray, axes: np.ndarray) -> np.ndarray:
        """Box (2, 3) that contains the body at all moments: coordinates from origins (n, 3) along the columns of `axes`
        (n, 3, 3). Sums are written out because BLAS may change their order."""
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        for k, bone in enumerate(body.bones):
            if not len(bone.mesh.points_m):
                continue
            x, y, z = bone.mesh.points_m.T
            start = _along(axes, (self.position_m[:, k] - origin_m)[..., None])[..., 0]
            weight = self.scale * _along(axes, self.rotation[:, k])
            reach = weight[..., 0:1] * x + weight[..., 1:2] * y + weight[..., 2:3] * z  # (n, 3, vertices)
            low = np.minimum(low, (start + reach.min(axis=-1)).min(axis=0))
            high = np.maximum(high, (start + reach.max(axis=-1)).max(axis=0))
        return np.stack([low, high])

    def mesh(self, body: Body, moment: int) -> Mesh:
        """The body in the world."""
        whole = joined([bone.mesh for bone in body.bones])
        return Mesh(self.points_m(body, moment), whole.triangles, whole.slot)


def _along(axes: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Coordinates (n, 3, c) along the columns of `axes` (n, 3, 3) of the columns of `vectors` (n, 3, c)."""
    return sum(axes[:, row, :, None] * vectors[:, row, None, :] for row in range(3))


def pose(walker: Walker, motion: Motion) -> Poses:
    """The walker's body at each moment of a motion."""
    body, scale = walker.body, walker.scale
    posture = body.postures[motion.posture]
    origin, carriage, residues = _carriage(walker, motion)
    origin = origin - [0.0, 0.0, scale * posture.sink_m]
    position, rotation = _hung(walker, motion, origin, carriage)
    for wheel, residue in zip(body.wheels, residues):
        position[:, wheel.bone, 2] += residue
    if posture.on_feet:
        _set_legs(walker, motion, position, rotation)
    return Poses(position, rotation, scale)


def feet(walker: Walker, motion: Motion) -> list[Footing]:
    """The feet of all legs at each moment."""
    body = walker.body
    return [
        footing(
            leg,
            body.stance,
            walker.stride_m,
            walker.scale,
            walker.path,
            walker.ground,
            motion.walked_m,
            motion.pace,
        )
        for leg in body.legs
    ]


def _carriage(walker: Walker, motion: Motion):
    """The position (n, 3) and rotation (n, 3, 3) of the body, and the height (m, n) of the ground at each of its
    contacts above the plane it stands on."""
    body, scale = walker.body, walker.scale
    point, heading = walker.path(motion.walked_m)
    level = facing(heading)
    contacts = scale * np.column_stack([body.contacts_m, np.zeros(len(body.contacts_m))])
    at = point[:, None] + (contacts @ np.swapaxes(level, 1, 2))[..., :2]
    height = _bearing_m(walker, motion.posture, at[..., 0], at[..., 1])
    middle = contacts.mean(axis=0)
    x, y = (contacts - middle)[:, 0], (contacts - middle)[:, 1]
    pitch, roll = _slope(height, x), _slope(height, y)
    mean = height.mean(axis=1)
    residues = (height - (mean[:, None] + pitch[:, None] * x + roll[:, None] * y)).T
    own = about("y", -np.arctan(body.pitch * pitch)) @ about("x", np.arctan(body.roll * roll))
    # The body turns about the middle of its hips, which keeps them above the feet on a slope.
    pivot = middle + [
        0.0,
        0.0,
        scale * np.mean([body.bones[leg.bones[0]].joint_m[2] for leg in body.legs] or 0.0),
    ]
    origin = np.column_stack([point, mean]) + applied(level, pivot - own @ pivot)
    return origin, level @ own, residues


def _bearing_m(walker: Walker, posture: str, x_m, y_m) -> np.ndarray:
    """Height of the surface that supports a body: the ground, or the water for a floating body."""
    waterline_m = walker.body.postures[posture].waterline_m
    ground_m = walker.ground.height_m(x_m, y_m)
    if waterline_m is None:
        return ground_m
    return np.maximum(ground_m, walker.ground.surface_m(x_m, y_m) - walker.scale * waterline_m)


def _slope(height: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Least-squares slopes (n,) of heights (n, m) at positions (m,) with mean 0; 0 if all positions are equal."""
    return height @ place / max(place @ place, 1e-9) * (place @ place > 1e-6)


def _hung(walker: Walker, motion: Motion, origin: np.ndarray, carriage: np.ndarray):
    """Positions (n, bones, 3) and rotations (n, bones, 3, 3) of bones from their joint angles alone."""
    body, scale = walker.body, walker.scale
    own = turned(_angles_rad(walker, motion))
    position = np.empty(own.shape[:2] + (3,))
    rotation = np.empty(own.shape)
    for k, bone in enumerate(body.bones):
        if bone.parent < 0:
            base, turn, from_m = origin, carriage, np.zeros(3)
        else:
            base, turn = position[:, bone.parent], rotation[:, bone.parent]
            from_m = body.bones[bone.parent].joint_m
        position[:, k] = base + scale * (turn @ (bone.joint_m - from_m))
        rotation[:, k] = turn @ own[:, k]
    return position, rotation


def _angles_rad(walker: Walker, motion: Motion) -> np.ndarray:
    """Joint angles (n, bones, 3) of all bones."""
    body = walker.body
    angles = motion.head_down[:, None, None] * body.postures["graze"].turn_rad
    angles = angles + body.postures[motion.posture].turn_rad
    for move in body.moves:
        if move.period_s is not None:
            turns = motion.time_s / move.period_s + walker.phase
            strength = 1.0
        else:
            turns = move.per_stride * motion.walked_m / walker.stride_m
            strength = motion.pace
        angles[:, move.bone, move.axis] += (
            strength * move.angle_rad * np.sin(2 * np.pi * (turns + move.phase))
        )
    for wheel in body.wheels:
        angles[:, wheel.bone, 1] += motion.walked_m / (walker.scale * wheel.radius_m)
    return angles


def _set_legs(walker: Walker, motion: Motion, position: np.ndarray, rotation: np.ndarray) -> None:
    """Place the feet, lower the body until every leg reaches its foot, and bend the knees in between."""
    body, scale = walker.body, walker.scale
    ankles, needs = [], []
    for leg, foot in zip(body.legs, feet(walker, motion)):
        hip, ankle_rest = leg.bones[0], body.bones[leg.bones[2]].joint_m
        ankle = foot.toe_m + scale * (foot.rotation @ (ankle_rest - leg.toe_m))
        below = position[:, 0] + scale * (rotation[:, 0] @ (leg.toe_m - body.bones[0].joint_m))
        position[:, hip, :2] += leg.glide * (foot.toe_m - below)[:, :2]
        ankles.append(ankle)
        needs.append(_need(ankle - position[:, hip], scale * sum(_lengths(body, leg)) * _LONGEST))
        rotation[:, leg.bones[2]] = foot.rotation
    if body.legs:
        position[..., 2] -= (np.sum(np.maximum(needs, 0.0) ** _NORM, axis=0) ** (1.0 / _NORM))[:, None]
    for leg, ankle in zip(body.legs, ankles):
        _bend(body, leg, scale, ankle, position, rotation)


def _lengths(body: Body, leg) -> tuple[float, float]:
    hip, knee, ankle = (body.bones[k].joint_m for k in leg.bones)
    return float(np.linalg.norm(knee - hip)), float(np.linalg.norm(ankle - knee))


def _need(reach: np.ndarray, longest_m: float) -> np.ndarray:
    """How far (n,) a hip must be lowered to be within longest_m of an ankle at offset `reach` (n, 3) from it."""
    level2 = (reach[:, :2] ** 2).sum(axis=1)
    return -reach[:, 2] - np.sqrt(np.maximum(longest_m**2 - level2, (0.2 * longest_m) ** 2))


def _bend(
    body: Body, leg, scale: float, ankle: np.ndarray, position: np.ndarray, rotation: np.ndarray
) -> None:
    """Two bones from the hip to the ankle, with the knee bent to the side on which it is drawn (law of cosines)."""
    upper, lower, foot = leg.bones
    hip_rest, knee_rest, ankle_rest = (body.bones[k].joint_m for k in leg.bones)
    thigh, shank = (scale * length for length in _lengths(body, leg))
    along_rest = unit(ankle_rest - hip_rest)
    out_rest = unit(knee_rest - hip_rest - ((knee_rest - hip_rest) @ along_rest) * along_rest)
    reach = ankle - position[:, upper]
    far = np.clip(np.linalg.norm(reach, axis=1), 1.001 * abs(thigh - shank) + 1e-6, 0.9999 * (thigh + shank))
    along = unit(reach)
    turn = rotation[:, body.bones[upper].parent]
    out = turn @ out_rest
    out = unit(out - (out * along).sum(axis=1, keepdims=True) * along)
    cos = np.clip((thigh**2 + far**2 - shank**2) / (2.0 * thigh * far), -1.0, 1.0)
    knee = position[:, upper] + thigh * (cos[:, None] * along + np.sqrt(1.0 - cos**2)[:, None] * out)
    hinge, hinge_rest = np.cross(along, out), np.cross(along_rest, out_rest)
    rotation[:, upper] = (
        frame(unit(knee - position[:, upper]), hinge) @ frame(unit(knee_rest - hip_rest), hinge_rest).T
    )
    rotation[:, lower] = frame(unit(ankle - knee), hinge) @ frame(unit(ankle_rest - knee_rest), hinge_rest).T
    position[:, lower], position[:, foot] = knee, ankle
