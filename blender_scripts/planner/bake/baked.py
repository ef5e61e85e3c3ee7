"""Read the files of a plan: the baked scene and the tracks of clips."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from ..camera import Intrinsics, intrinsics_of, widened
from ..faults import check_known
from .arrays import BadBake, check_finite, read, read_header
from .forms import PLAN, PREVIEW, SCENE, TRACK, VERSION


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
    """The map in `path`.json and `path`.bin. BadBake if it is damaged."""
    return BakedSheet(*read(path, PREVIEW, VERSION))


def read_plan(folder: Path) -> dict:
    """The plan in a folder; configs/schema/plan.schema.json describes it. BadBake if it is of another version."""
    return read_header(folder / "plan.json", PLAN, VERSION)


def clip_of(plan: dict, clip_id: str) -> dict:
    """The plan's clip with the given id. ConfigError if there is none."""
    known = {clip["id"]: clip for clip in plan["clips"]}
    check_known(clip_id, known, "--clip", "a clip of the plan")
    return known[clip_id]


def read_scene(path: Path) -> BakedScene:
    """The scene in `path`.json and `path`.bin. BadBake if it is damaged, OSError if it is not there."""
    header, arrays = read(path, SCENE, VERSION)
    known = {entry["index"] for entry in header["materials"]}
    for mesh in header["meshes"]:
        check_finite(path, mesh["points_m"], arrays[mesh["points_m"]])
        _check_below(
            path, mesh["triangles"], arrays[mesh["triangles"]], len(arrays[mesh["points_m"]]), "points"
        )
        unnamed = set(np.unique(arrays[mesh["material_index"]]).tolist()) - known
        if unnamed:
            raise BadBake(
                f"{path}: arrays.{mesh['material_index']} = {min(unnamed)}; expected an index of materials"
            )
    objects = {entry["index"] for entry in header["objects"]}
    for kind in ("surfaces", "plants", "actors"):
        for k, entry in enumerate(header[kind]):
            if entry["object"] not in objects:
                raise BadBake(f"{path}: {kind}[{k}].object = {entry['object']}; expected an index of objects")
    meshes = len(header["meshes"])
    for plants in header["plants"]:
        check_finite(path, plants["transform"], arrays[plants["transform"]])
        _check_below(path, plants["mesh"], arrays[plants["mesh"]], meshes, "meshes")
    return BakedScene(header, arrays)


def read_track(path: Path, scene: BakedScene) -> BakedTrack:
    """The track in `path`.json and `path`.bin. BadBake if it is damaged or does not belong to the scene."""
    header, arrays = read(path, TRACK, VERSION)
    bones_of = np.array([len(actor["bones"]) for actor in scene.header["actors"]], np.int64)
    posed = arrays["posed"] != 0
    shapes = _track_shapes(len(bones_of), header["frames"], int((posed.sum(axis=1) @ bones_of)))
    for name, shape in shapes.items():
        if arrays[name].shape != shape:
            raise BadBake(
                f"{path}.json: arrays.{name}.shape = {list(arrays[name].shape)}; expected {list(shape)}"
            )
        check_finite(path, name, arrays[name])
    del arrays["posed"]
    return BakedTrack(
        clip=header["clip"],
        posed=posed,
        bones_of=tuple(bones_of.tolist()),
        all_bones=arrays.pop("bones"),
        camera=header.get("camera"),
        **arrays,
    )


def _check_below(path: Path, name: str, numbers: np.ndarray, count: int, what: str) -> None:
    most = int(numbers.max(initial=0))
    if len(numbers) and most >= count:
        raise BadBake(f"{path}.json: {name} = {most}; expected one of the {count} {what}")


def _track_shapes(actors: int, frames: int, bones: int) -> dict[str, tuple[int, ...]]:
    return {
        "time_s": (frames,),
        "camera_to_world": (frames, 4, 4),
        "agl_m": (frames,),
        "look_angle_deg": (frames,),
        "actor_position_m": (actors, frames, 3),
        "actor_heading_rad": (actors, frames),
        "posed": (actors, frames),
        "bones": (bones, 3, 4),
    }
