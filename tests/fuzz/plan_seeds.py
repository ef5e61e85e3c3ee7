"""Plans of a small place, one a kind of file: what scene_plan.cpp, baked_scene.cpp, ground_maps.cpp and
tracks.cpp read."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

ALIGNMENT_BYTES = 64
CAMERA = {"width_px": 8, "height_px": 6, "fx_px": 9.5, "fy_px": 9.5, "cx_px": 4, "cy_px": 3}
FLIGHT = {"pattern": "zigzag", "area_m": [0, 0, 9, 9], "altitude_m": 61}
CONFIG = {
    "name": "t",
    "render": {"engine": "embree"},
    "clips": [{"id": "one", "season": "winter", "frames": 2, "flight": FLIGHT}],
    "flights": [{"id": "long", "season": "summer", "duration_s": 4, "clip_length_s": 2, "flight": FLIGHT}],
}
_FINE_CELLS = 5


def planned_clip(name: str, flight: str, start_s: float, frames: int) -> dict:
    """An entry of plan.json."""
    return {
        "id": name,
        "of_flight": flight,
        "start_s": start_s,
        "frames": frames,
        "frame_rate_hz": 9,
        "duration_s": frames / 9,
        "frames_with_actors": 1,
        "min_agl_m": 60.5,
        "max_agl_m": 61.5,
        "mean_agl_m": 61,
        "mean_look_angle_deg": 90,
    }


PLAN = {
    "format": "veldt-plan",
    "version": 1,
    "config": {"name": "t"},
    "files": {"assets/a.json": "0" * 64},
    "clips": [
        planned_clip("one", "", 0, 2),
        planned_clip("long_0000", "long", 0, 18),
        planned_clip("long_0001", "long", 2, 18),
    ],
    "actors": 1,
    "plants": 1,
    "outline": {"covers": {"soil": 0.75, "water": 0.25}, "actors": ["human"]},
}

Arrays = dict[str, tuple[str, object]]  # NumPy's type and values, by name


def packed(header: dict, arrays: Arrays) -> bytes:
    """JSON, a NUL byte, and the arrays it describes."""
    entries, data = {}, b""
    for name, (kind, values) in arrays.items():
        array = np.array(values, kind)
        entries[name] = {"type": kind, "shape": list(array.shape), "offset": len(data)}
        data += array.tobytes()
        data += b"\0" * (-len(data) % ALIGNMENT_BYTES)
    text = json.dumps(header | {"bytes": len(data), "arrays": entries}, separators=(",", ":"))
    return text.encode() + b"\0" + data


def _mesh(name: str, smooth: bool) -> dict:
    parts = ("points_m", "triangles", "material_index")
    return {"name": name, "smooth": smooth} | {part: f"{name}/{part}" for part in parts}


def _mesh_arrays(name: str, points_m: list, triangles: list, material: int) -> Arrays:
    return {
        f"{name}/points_m": ("<f4", points_m),
        f"{name}/triangles": ("<u4", triangles),
        f"{name}/material_index": ("<u2", [material] * len(triangles)),
    }


def _objects() -> list[dict]:
    plain = (("ground", "ground", "soil"), ("lake", "water", "water"), ("shrub", "plant", "shrub"))
    objects = [
        {"index": k, "name": name, "class": kind, "material": material}
        for k, (name, kind, material) in enumerate(plain, 1)
    ]
    walker = {"index": 10, "name": "walker", "class": "actor", "material": "human", "category": "human"}
    bounds = [[-0.3, -0.3, 0], [0.3, 0.3, 1.8]]
    return objects + [walker | {"species": "human", "track_id": 7, "bounds_m": bounds}]


def _fine_arrays() -> dict[str, tuple]:
    """What the ground is made of: bare soil, and its shares."""
    shares = {"kind": 0, "grass": 255, "trodden": 9, "ash": 1, "border": 255}
    return {name: ("|u1", np.full((_FINE_CELLS, _FINE_CELLS), share)) for name, share in shares.items()}


def scene(water: bool) -> bytes:
    """A place of two cells a side, with a shrub and a walker of one bone."""
    header = {
        "format": "veldt-scene",
        "version": 1,
        "name": "t",
        "seed": 5,
        "camera": CAMERA,
        "view_margin_px": 0,
        "depth_range_m": [0.1, 20000.0],
        "materials": [{"index": 1, "material": "soil"}, {"index": 2, "material": "human", "part": "face"}],
        "mirrors": ["water"] * water,
        "objects": _objects(),
        "meshes": [_mesh("field", True), _mesh("body", False)],
        "surfaces": [{"object": 1, "mesh": 0}] + [{"object": 2, "mesh": 0}] * water,
        "plants": [{"name": "shrub", "object": 3, "transform": "shrub/transform", "mesh": "shrub/mesh"}],
        "actors": [{"object": 10, "name": "walker", "group": "g", "bones": [{"name": "b", "mesh": 1}]}],
        "ground": {"size_m": 40.0, "cells": 2, "covers": ["soil"], "fine_cells": _FINE_CELLS}
        | {part: part for part in ("height_m", "cover", "canopy", *_fine_arrays())}
        | ({"shore_m": "shore_m"} if water else {}),
    }
    corner = [[-20, -20, 0], [20, -20, 0], [20, 20, 1], [-20, 20, 0]]
    tip = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 2]]
    arrays = {
        **_mesh_arrays("field", corner, [[0, 1, 2], [0, 2, 3]], 1),
        **_mesh_arrays("body", tip, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], 2),
        "shrub/transform": ("<f8", [[[1, 0, 0, 3], [0, 1, 0, 4], [0, 0, 1, 0]]]),
        "shrub/mesh": ("<u4", [1]),
        "height_m": ("<f4", np.zeros((3, 3))),
        "cover": ("|u1", np.full((1, 2, 2), 255)),
        "canopy": ("|u1", np.zeros((2, 2))),
        **_fine_arrays(),
    }
    return packed(header, arrays | ({"shore_m": ("<f4", np.full((3, 3), -1))} if water else {}))


def track(posed: list[list[int]]) -> bytes:
    """A clip of two actors, of one bone and of two, posed in some frames."""
    frames = len(posed[0])
    bones = sum(posed[0]) + 2 * sum(posed[1])
    pose = [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 40], [0, 0, 0, 1]]
    body = [[1, 0, 0, 2], [0, 1, 0, 3], [0, 0, 1, 0]]
    arrays = {
        "time_s": ("<f8", np.arange(frames) / 9),
        "camera_to_world": ("<f8", [pose] * frames),
        "agl_m": ("<f8", [40.0] * frames),
        "look_angle_deg": ("<f8", [90.0] * frames),
        "actor_position_m": ("<f8", np.ones((2, frames, 3))),
        "actor_heading_rad": ("<f8", np.full((2, frames), 0.5)),
        "posed": ("|u1", posed),
        "bones": ("<f4", np.array([body] * bones).reshape((bones, 3, 4))),
    }
    return packed({"format": "veldt-track", "version": 1, "clip": "one", "frames": frames}, arrays)


def ground_maps(days: list[int]) -> bytes:
    """Maps of the place of `scene`, of three cells a side, with the sun of these days of the year."""
    header = {
        "format": "veldt-ground-maps",
        "version": 2,
        "size_m": 40.0,
        "cells": 3,
        "fine_cells": _FINE_CELLS,
        "kinds": ["soil", "grass"],
        "sun_paths": [{"latitude_deg": -19.0, "day_of_year": day} for day in days],
    }
    arrays = {
        "sky_view": ("|u1", np.full((3, 3), 200)),
        "height_m": ("<f4", np.full((3, 3), -1.5)),
        "crown_top_m": ("<f4", np.eye(3)),
        "moisture": ("|u1", np.zeros((3, 3))),
        **_fine_arrays(),
        "sunlit": ("<u4", np.full((len(days), 3, 3), 0x3FFC0)),
    }
    return packed(header, arrays)


def write_plan_seeds(folder: Path) -> None:
    """Write the seeds of the four targets."""
    config = json.dumps({"plan": PLAN, "config": CONFIG})
    (folder / "scene_plan" / "plan.json").write_text(config, encoding="utf-8")
    (folder / "baked_scene" / "dry").write_bytes(scene(False))
    (folder / "baked_scene" / "lake").write_bytes(scene(True))
    (folder / "ground_maps" / "two_days").write_bytes(ground_maps([190, 15]))
    (folder / "ground_maps" / "dark").write_bytes(ground_maps([]))
    (folder / "tracks" / "posed").write_bytes(track([[1, 1], [0, 1]]))
    (folder / "tracks" / "nothing").write_bytes(track([[0], [0]]))
