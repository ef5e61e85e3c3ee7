"""Small bodies in the format of species files, and ground to walk on, for tests that are independent of the assets."""

from dataclasses import dataclass

import numpy as np

from planner.anatomy.gait import Footing


def apart(feet: Footing) -> list[Footing]:
    """The foot of each leg alone: toe_m (n, 3), rotation (n, 3, 3), bearing (n,), strike_rad (n,)."""
    toes_m, rotations = np.moveaxis(feet.toe_m, 0, -1), np.moveaxis(feet.rotation, (0, 1), (-2, -1))
    return [Footing(*foot) for foot in zip(toes_m, rotations, feet.bearing, feet.strike_rad)]


def _legs(joints_m: list, phases: list, heel_deg: float, name: str) -> tuple[dict, dict]:
    """Bones of a pair of legs drawn through three joints, and the entry for their gait."""
    names = [f"{name}_{part}" for part in ("upper", "lower", "foot")]
    joints = [*joints_m, [joints_m[-1][0] + 0.08, joints_m[-1][1], 0.02]]
    bones = {
        bone: {
            "parent": (["trunk"] + names)[k],
            "mirror": True,
            "joint_m": joints[k],
            "shapes": [{"part": "legs", "tube_m": [[*joints[k], 0.06, 0.06], [*joints[k + 1], 0.04, 0.04]]}],
        }
        for k, bone in enumerate(names)
    }
    toe_m = [joints[-1][0], joints[-1][1], 0.0]
    return bones, {"bones": names, "toe_m": toe_m, "phases": phases, "lift_m": 0.12, "heel_deg": heel_deg}


_FORE = _legs([[0.5, 0.18, 0.95], [0.47, 0.18, 0.5], [0.52, 0.18, 0.1]], [0.25, 0.75], 25, "fore")
_HIND = _legs([[-0.5, 0.18, 0.95], [-0.42, 0.18, 0.5], [-0.55, 0.18, 0.1]], [0.0, 0.5], 25, "hind")
_CALM = {"share": 1.0, "size_range": [0.9, 1.1]}

PONY = {
    "category": "animal",
    "material": "zebra",
    "speed_m_s": 1.1,
    "variants": {"mare": _CALM, "foal": _CALM | {"share": 0.5, "stretch": {"head": 1.2}}},
    "gait": {"leg_m": 0.95, "stance": 0.62, "pitch": 1.0, "roll": 0.4},
    "bones": {
        "trunk": {
            "joint_m": [0, 0, 1.0],
            "shapes": [
                {
                    "part": "torso",
                    "tube_m": [[-0.6, 0, 1.05, 0.2, 0.2], [0, 0, 1, 0.25, 0.27], [0.6, 0, 1.05, 0.2, 0.2]],
                }
            ],
        },
        "neck": {
            "parent": "trunk",
            "joint_m": [0.6, 0, 1.15],
            "shapes": [{"part": "torso", "tube_m": [[0.55, 0, 1.1, 0.12, 0.17], [0.95, 0, 1.5, 0.08, 0.1]]}],
        },
        "head": {
            "parent": "neck",
            "joint_m": [0.95, 0, 1.5],
            "shapes": [{"part": "head", "tube_m": [[0.95, 0, 1.5, 0.09, 0.1], [1.3, 0, 1.3, 0.06, 0.07]]}],
        },
        "tail": {
            "parent": "trunk",
            "joint_m": [-0.75, 0, 1.1],
            "shapes": [
                {"part": "tail", "tube_m": [[-0.75, 0, 1.1, 0.03, 0.03], [-0.85, 0, 0.6, 0.02, 0.02]]},
                {"part": "tail", "centre_m": [-0.85, 0, 0.6], "radii_m": [0.05, 0.05, 0.1], "only": ["mare"]},
            ],
        },
        **_FORE[0],
        **_HIND[0],
    },
    "legs": [_FORE[1], _HIND[1] | {"glide": 0.2}],
    "moves": [
        {"bone": "neck", "axis": "y", "deg": 3, "per_stride": 2, "phase": 0.1},
        {"bone": "tail", "axis": "x", "deg": 10, "period_s": 2.5},
    ],
    "postures": {
        "graze": {"turn_deg": {"neck": [0, 75, 0], "head": [0, 20, 0]}},
        "lie": {"turn_deg": {"fore_upper": [0, -80, 0], "hind_upper": [0, -80, 0]}, "sink_m": 0.7},
        "float": {"waterline_m": 1.0},
    },
}

CART = {
    "category": "vehicle",
    "material": "truck",
    "speed_m_s": 5.0,
    "variants": {"plain": {"share": 1.0, "size_range": [1.0, 1.0]}},
    "gait": {"leg_m": 1.0, "pitch": 1.0, "roll": 1.0},
    "bones": {
        "bed": {
            "joint_m": [0, 0, 0.8],
            "shapes": [{"part": "bed", "centre_m": [0, 0, 0.9], "radii_m": [2, 0.9, 0.5]}],
        }
    }
    | {
        name: {
            "parent": "bed",
            "mirror": True,
            "joint_m": [x, 0.8, 0.4],
            "shapes": [{"part": "tyres", "centre_m": [x, 0.8, 0.4], "radii_m": [0.4, 0.12, 0.4]}],
        }
        for name, x in (("front_wheel", 1.3), ("back_wheel", -1.3))
    },
    "wheels": [{"bone": "front_wheel", "radius_m": 0.4}, {"bone": "back_wheel", "radius_m": 0.4}],
}


@dataclass(frozen=True)
class Hills:
    """Round hills about a slope: their steepest is `slope` (rise over run) anywhere, in any direction."""

    slope: float
    wave_m: float = 30.0
    tilt: tuple[float, float] = (0.0, 0.0)
    water_m: float = -100.0

    def height_m(self, x_m, y_m) -> np.ndarray:
        """Of the ground."""
        k = 2.0 * np.pi / self.wave_m
        waves = np.sin(k * np.asarray(x_m, float)) + np.sin(k * np.asarray(y_m, float) + 1.0)
        return self.slope / (k * np.sqrt(2.0)) * waves + self.tilt[0] * x_m + self.tilt[1] * y_m

    def surface_m(self, x_m, y_m) -> np.ndarray:
        """Of ground or water."""
        return np.maximum(self.height_m(x_m, y_m), self.water_m)


def circle(radius_m: float):
    """A path round the origin, counter-clockwise; a very large one is straight."""

    def path(walked_m):
        angle = np.asarray(walked_m, float) / radius_m
        heading = np.stack([-np.sin(angle), np.cos(angle)], axis=-1)
        return radius_m * np.stack([np.cos(angle), np.sin(angle)], axis=-1), heading

    return path
