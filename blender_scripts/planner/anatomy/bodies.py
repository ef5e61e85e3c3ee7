"""Bodies of actors: bones and the way they move, built from species files.

Actor axes: x forward, y left, z up, origin on the ground below the body's middle.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from .. import assets
from ..geometry.shapes import Mesh, joined
from ..noise import stream
from .gait import Leg
from .limbs import Limbs, limbs_of
from .skeleton import SIDES, Bone, build_bones, is_in, part_names

_SHARES = {"pitch": 1.0, "roll": 0.4}  # default fraction of the ground's slope that a body follows
_FOOTING = 0.7  # of the half length and width of a body without legs: position of its ground contacts


@dataclass(frozen=True)
class Move:
    """A bone that swings about one of its axes (0, 1, 2): once per stride, or periodically if it has a period_s."""

    bone: int
    axis: int
    angle_rad: float
    per_stride: float
    period_s: float | None
    phase: float


@dataclass(frozen=True)
class Wheel:
    """A bone that rolls."""

    bone: int
    radius_m: float


@dataclass(frozen=True)
class Posture:
    """Joint angles (bones, 3), how far the body sinks, and the waterline of a floating body.

    On its feet: shift_m (3,) moves the hips, feet_m (legs, 2) the feet ahead and to the left. rests_m: half length and
    width of what it rests on, whose slope it follows; without, it stands on its contacts.
    """

    turn_rad: np.ndarray
    sink_m: float
    waterline_m: float | None
    shift_m: np.ndarray
    feet_m: np.ndarray
    rests_m: tuple[float, float] | None

    @property
    def on_feet(self) -> bool:
        """Whether feet are set on the ground; otherwise legs keep the pose in which they are drawn."""
        return self.sink_m == 0.0 and self.waterline_m is None


@dataclass(frozen=True)
class Body:
    """A variant of a species at its drawn size; material slots of all meshes are indices into `parts`.

    stance: fraction of a stride that a foot is on the ground; pitch, roll: fractions of the ground's slope that the
    body follows.
    """

    parts: tuple[str, ...]
    bones: tuple[Bone, ...]
    legs: tuple[Leg, ...]
    wheels: tuple[Wheel, ...]
    moves: tuple[Move, ...]
    postures: dict[str, Posture]
    stance: float
    leg_m: float
    pitch: float
    roll: float

    def contacts_m(self, posture: str) -> np.ndarray:
        """Points (n, 2) in actor axes where the ground supports the body."""
        rests_m = self.postures[posture].rests_m
        if rests_m is not None:
            return np.array(rests_m) * [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]]
        wheels = [self.bones[wheel.bone].joint_m for wheel in self.wheels]
        places = [leg.toe_m for leg in self.legs] + wheels
        if not places:  # a model from a file has neither: approximate feet
            return _FOOTING * self.rest().points_m[:, :2]
        return np.array([place[:2] for place in places])

    @cached_property
    def reach_m(self) -> np.ndarray:
        """How far (3,) the drawn body extends from its origin: forward or back, to either side, and up."""
        return np.abs(self.rest().points_m).max(axis=0)

    @cached_property
    def limbs(self) -> Limbs:
        """The legs, which there must be, as drawn."""
        return limbs_of(self.legs, self.bones)

    @cached_property
    def unsupported(self) -> list[int]:
        """Bones whose positions do not depend on the feet: those of no leg, and their ancestors."""
        found = set(range(len(self.bones))) - {bone for leg in self.legs for bone in leg.bones}
        found |= {self.bones[leg.bones[0]].parent for leg in self.legs}
        for bone in reversed(range(len(self.bones))):  # children before their parents
            if bone in found:
                found.add(self.bones[bone].parent)
        return sorted(found - {-1})

    @cached_property
    def borne(self) -> list[int]:
        """Bones supported by legs: not those that share a root with a wheel, of a bicycle that is pushed."""
        roots: list[int] = []
        for k, bone in enumerate(self.bones):
            roots.append(k if bone.parent < 0 else roots[bone.parent])
        rolling = {roots[wheel.bone] for wheel in self.wheels}
        return [k for k, root in enumerate(roots) if root not in rolling]

    def rest(self) -> Mesh:
        """The mesh of the whole drawn body in actor axes."""
        return joined([bone.mesh.moved(bone.joint_m) for bone in self.bones])


def variant_names(species: str) -> tuple[str, ...]:
    """Names of a species' variants."""
    return tuple(assets.load("species", species)["variants"])


def draw_variant(species: str, seed: int, name: str, k: int, behaviour: str) -> str:
    """The variant of a group's k-th member, drawn by the shares of those that have this behaviour."""
    variants = assets.load("species", species)["variants"]
    shares = {
        variant: entry["share"]
        for variant, entry in variants.items()
        if behaviour in entry.get("behaviours", [behaviour])
    }
    return drawn(shares, stream(seed, f"variant/{name}", k))


def drawn(shares: Mapping[str, float], rng: np.random.Generator) -> str:
    """One of the keys, drawn with the probabilities given by their shares."""
    bounds = np.cumsum(list(shares.values()))
    return list(shares)[int(np.searchsorted(bounds / bounds[-1], rng.random()))]


@lru_cache(maxsize=None)
def build_body(species: str, variant: str, posture: str = "walk") -> Body:
    """The body of a variant of `assets/species/<species>.json`, with parts of a posture, such as a stool."""
    return body_of(assets.load("species", species), variant, posture)


def body_of(data: dict, variant: str, posture: str = "walk") -> Body:
    """The body of a variant from the content of a species file, with parts of a posture."""
    bones = _on_its_feet(build_bones(data, variant, posture), data)
    place = {bone.name: k for k, bone in enumerate(bones)}
    gait = data.get("gait", {})
    return Body(
        parts=part_names(data),
        bones=bones,
        legs=tuple(leg for entry in _legs(data, place) for leg in _leg_pair(entry, bones, place)),
        wheels=tuple(
            Wheel(bone, entry["radius_m"])
            for entry in data.get("wheels", [])
            for bone, _ in _bones_named(entry["bone"], place)
        ),
        moves=tuple(
            move
            for entry in data.get("moves", [])
            if is_in(entry, variant, posture) and entry["bone"] not in _held_deg(data, variant)
            for move in _moves(entry, place)
        ),
        postures=_postures(data, variant, place),
        stance=gait.get("stance", 0.6),
        leg_m=gait.get("leg_m") or 0.5 * data["model"]["size_m"][2],
        pitch=gait.get("pitch", _SHARES["pitch"]),
        roll=gait.get("roll", _SHARES["roll"]),
    )


def _on_its_feet(bones: tuple[Bone, ...], data: dict) -> tuple[Bone, ...]:
    """The bones, raised or lowered so that the lowest toe is on the ground, however a variant is stretched."""
    place = {bone.name: bone for bone in bones}
    toes_m = [place[f'{entry["bones"][-1]}.left'].placed(entry["toe_m"])[2] for entry in _legs(data, place)]
    return tuple(replace(bone, joint_m=bone.joint_m - [0.0, 0.0, min(toes_m, default=0.0)]) for bone in bones)


def _legs(data: dict, place: Collection[str]) -> list[dict]:
    """The pairs of legs whose bones a variant has."""
    return [entry for entry in data.get("legs", []) if f'{entry["bones"][0]}.left' in place]


def _held_deg(data: dict, variant: str) -> dict:
    """The angles that a variant keeps in every posture, such as those of an arm that carries something."""
    return data["variants"][variant].get("holds_deg", {})


def _leg_pair(entry: dict, bones: tuple[Bone, ...], place: dict[str, int]) -> list[Leg]:
    """The left leg as drawn, and the right leg: its mirror image with a phase of its own."""
    return [
        Leg(
            bones=tuple(place[f"{bone}.{side}"] for bone in entry["bones"]),
            toe_m=bones[place[f'{entry["bones"][-1]}.{side}']].placed(
                np.array(entry["toe_m"]) * [1, sign, 1]
            ),
            phase=phase,
            glide=entry.get("glide", 0.0),
            lift_m=entry["lift_m"],
            heel_rad=np.radians(entry["heel_deg"]),
            strike_rad=np.radians(entry.get("strike_deg", 0.0)),
            foot_m=entry.get("foot_m", 0.0),
        )
        for (side, sign), phase in zip(SIDES.items(), entry["phases"])
    ]


def _moves(entry: dict, place: dict[str, int]) -> list[Move]:
    """The move of a bone, or of both bones of a pair: mirrored, or half a stride apart if `takes_turns`."""
    moves = []
    for bone, sign in _bones_named(entry["bone"], place):
        axis = "xyz".index(entry["axis"])
        turns = entry.get("takes_turns", False)
        moves.append(
            Move(
                bone=bone,
                axis=axis,
                angle_rad=np.radians(entry["deg"]) * (sign if axis != 1 and not turns else 1.0),
                per_stride=entry.get("per_stride", 0.0),
                period_s=entry.get("period_s"),
                phase=entry.get("phase", 0.0) + (0.5 if turns and sign < 0 else 0.0),
            )
        )
    return moves


def _postures(data: dict, variant: str, place: dict[str, int]) -> dict[str, Posture]:
    """All postures of the file; `walk` is the drawn pose with the variant's own angles applied."""
    entries = {"walk": {}, "graze": {}} | data.get("postures", {})
    always, held = data["variants"][variant].get("turn_deg", {}), _held_deg(data, variant)
    pairs = len(_legs(data, place))
    return {
        name: Posture(
            _angles_rad(
                (always | entry.get("turn_deg", {}) | held) if name != "graze" else entry.get("turn_deg", {}),
                place,
            ),
            entry.get("sink_m", 0.0),
            entry.get("waterline_m"),
            np.array(entry.get("shift_m", [0.0, 0.0, 0.0])),
            np.tile(entry.get("feet_m", [[0.0, 0.0], [0.0, 0.0]]), (pairs, 1)),
            entry.get("rests_m"),
        )
        for name, entry in entries.items()
    }


def _angles_rad(turn_deg: dict, place: dict[str, int]) -> np.ndarray:
    """Angles (bones, 3) from a map of bone names; the angles of a pair are mirrored."""
    angles = np.zeros((len(place), 3))
    for name, turn in turn_deg.items():
        for bone, sign in _bones_named(name, place):
            angles[bone] = np.radians(turn) * [sign, 1.0, sign]
    return angles


def _bones_named(name: str, place: dict[str, int]) -> list[tuple[int, float]]:
    """A central bone, or a pair with the sign of each side's mirrored angles; empty if the variant lacks the bone."""
    pair = [(place[f"{name}.{side}"], sign) for side, sign in SIDES.items() if f"{name}.{side}" in place]
    return pair or ([(place[name], 1.0)] if name in place else [])
