"""Read the files of a plan: the baked scene and the tracks of clips. `veldt` has checked them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from ..camera import Intrinsics, intrinsics_of, widened
from ..faults import check_known
from .arrays import read


@dataclass(frozen=True)
class BakedScene:
    """The header of a scene and its arrays by name; configs/schema/scene.schema.json describes both."""

    header: dict
    arrays: dict[str, np.ndarray]

    @property
    def intrinsics(self) -> Intrinsics:
        """Intrinsics of the picture."""
        return intrinsics_of(self.header["camera"])

    @property
    def passes_intrinsics(self) -> Intrinsics:
        """Intrinsics of the passes' pinhole camera, at the camera's resolution."""
        return widened(self.intrinsics, self.header["view_margin_px"])

    def passes_of(self, track: BakedTrack) -> Intrinsics:
        """The same in a clip, which may have a camera of its own."""
        return widened(intrinsics_of(track.camera or self.header["camera"]), self.header["view_margin_px"])

    @cached_property
    def heights_m(self) -> tuple[float, float]:
        """Minimum and maximum of the ground grid's heights."""
        height_m = self.arrays[self.header["ground"]["height_m"]]
        return float(height_m.min()), float(height_m.max())


@dataclass(frozen=True)
class BakedTrack:
    """The track of a clip of n frames.

    time_s (n,); camera_to_world (n, 4, 4); agl_m (n,) over ground or water; look_angle_deg (n,); actor_position_m
    (actors, n, 3) on the ground; actor_heading_rad (actors, n); posed (actors, n): whether the picture may show an
    actor. bones_of: the number of bones of each actor. camera: the clip's own, if it differs from the scene's.
    """

    clip: str
    time_s: np.ndarray
    camera_to_world: np.ndarray
    agl_m: np.ndarray
    look_angle_deg: np.ndarray
    actor_position_m: np.ndarray
    actor_heading_rad: np.ndarray
    posed: np.ndarray
    bones_of: tuple[int, ...]
    all_bones: np.ndarray
    camera: dict | None = None

    def bones(self, actor: int, frame: int) -> np.ndarray:
        """Transforms (bones, 3, 4) of a posed actor, by its index in the scene's list, in a frame."""
        first = self._first[actor, frame]
        return self.all_bones[first : first + self.bones_of[actor]]

    @cached_property
    def _first(self) -> np.ndarray:
        """Row of the first bone (actors, n) of each actor in each frame."""
        count = self.posed * np.array(self.bones_of, np.int64)[:, None]
        return (np.cumsum(count) - count.ravel()).reshape(count.shape)


@dataclass(frozen=True)
class BakedSheet:
    """A preview's map, of width_m x height_m around centre_m, and the poses of its `stills`."""

    header: dict
    arrays: dict[str, np.ndarray]

    def mesh(self, layer: int) -> tuple[np.ndarray, np.ndarray]:
        """Points (n, 3) and triangles (m, 3) of a layer."""
        return self.arrays[f"layers/{layer}/points_m"], self.arrays[f"layers/{layer}/triangles"]


def read_sheet(path: Path) -> BakedSheet:
    """The map in `path`.json and `path`.bin."""
    return BakedSheet(*read(path))


def read_plan(folder: Path) -> dict:
    """The plan in a folder; configs/schema/plan.schema.json describes it."""
    return json.loads((folder / "plan.json").read_text(encoding="utf-8"))


def clip_of(plan: dict, clip_id: str) -> dict:
    """The plan's clip with the given id. ConfigError if there is none."""
    known = {clip["id"]: clip for clip in plan["clips"]}
    check_known(clip_id, known, "--clip", "a clip of the plan")
    return known[clip_id]


def read_scene(path: Path) -> BakedScene:
    """The scene in `path`.json and `path`.bin."""
    return BakedScene(*read(path))


def read_track(path: Path, scene: BakedScene) -> BakedTrack:
    """The track in `path`.json and `path`.bin, of an actor each of the scene."""
    header, arrays = read(path)
    return BakedTrack(
        clip=header["clip"],
        posed=arrays.pop("posed") != 0,
        bones_of=tuple(len(actor["bones"]) for actor in scene.header["actors"]),
        all_bones=arrays.pop("bones"),
        camera=header.get("camera"),
        **arrays,
    )
