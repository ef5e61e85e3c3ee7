"""The manifest beside a clip's passes: the meaning of their indices, and camera and actor poses per frame.

Contract: configs/schema/manifest.schema.json.
"""

from __future__ import annotations

import json

import numpy as np

from . import assets, ids
from .flight.poses import Flight
from .groups.actors import Track, track
from .land.covers import SOIL
from .world import WATER, World

LAYER = "Scene"
ACTOR_LAYER = "Actors"


def frame_file(number: int) -> str:
    """Name of a frame's passes."""
    return f"{number:06d}.exr"


def build_manifest(world: World, clip: dict) -> dict:
    """The manifest of one clip."""
    flight = world.flight(clip)
    return {
        "format": "veldt-passes",
        "version": 1,
        "clip": clip["id"],
        "scene": world.config["name"],
        "seed": world.config["seed"],
        "frame_rate_hz": clip["frame_rate_hz"],
        "layer": LAYER,
        **({"actor_layer": ACTOR_LAYER} if world.config["render"]["actor_layer"] else {}),
        "supersample": world.config["render"]["supersample"],
        "overscan_px": world.overscan_px,
        "camera": _camera(world),
        "objects": _place(world) + _actors(world),
        "materials": [
            {"index": index, "material": material} | ({"part": part} if part else {})
            for (material, part), index in world.material_indices.items()
        ],
        "frames": _frames(world, flight),
    }


def to_json(manifest: dict) -> str:
    """The manifest as text, deterministic, with one frame per line."""
    frames = ",\n".join("  " + json.dumps(frame) for frame in manifest["frames"])
    head = json.dumps({**manifest, "frames": []}, indent=1)
    return head[: head.rindex("[]")] + f"[\n{frames}\n ]\n}}\n"


def _camera(world: World) -> dict:
    intrinsics = world.intrinsics
    (fx_px, fy_px), (cx_px, cy_px) = intrinsics.focal_px, intrinsics.centre_px
    return {
        "width_px": intrinsics.width_px,
        "height_px": intrinsics.height_px,
        "fx_px": fx_px,
        "fy_px": fy_px,
        "cx_px": cx_px,
        "cy_px": cy_px,
    }


def _place(world: World) -> list[dict]:
    """Ground, and the water and plants of the scene, if any."""
    place = [{"index": ids.GROUND, "name": "ground", "class": "ground", "material": SOIL}]
    if world.terrain.waters:
        place.append({"index": ids.WATER, "name": "water", "class": "water", "material": WATER})
    for name, index in world.plant_indices.items():
        if len(world.plantings[name].scale) > 0:
            material = assets.load("plants", name)["material"]
            place.append({"index": index, "name": name, "class": "plant", "material": material})
    return place


def _actors(world: World) -> list[dict]:
    return [
        {
            "index": actor.index,
            "name": actor.name,
            "class": "actor",
            "material": assets.load("species", actor.species)["material"],
            "category": assets.load("species", actor.species)["category"],
            "species": actor.species,
            "track_id": actor.index,
            "bounds_m": _rounded(actor.bounds_m),
        }
        for actor in world.actors
    ]


def _frames(world: World, flight: Flight) -> list[dict]:
    walks = [(actor.index, track(actor, flight.time_s)) for actor in world.actors]
    return [
        {
            "file": frame_file(k),
            "time_s": round(float(flight.time_s[k]), 9),
            "agl_m": round(float(flight.agl_m[k]), 6),
            "look_angle_deg": round(float(flight.look_angle_deg[k]), 6),
            "camera_to_world": _rounded(flight.camera_to_world[k].ravel(), 9),
            "actors": [_place_of(index, walk, k) for index, walk in walks],
        }
        for k in range(len(flight.time_s))
    ]


def _place_of(index: int, walk: Track, k: int) -> dict:
    return {
        "index": index,
        "position_m": _rounded(walk.position_m[k]),
        "heading_rad": round(float(walk.heading_rad[k]), 9),
    }


def _rounded(values: np.ndarray, digits: int = 6) -> list:
    """Numbers rounded to the micrometre: far less than a pixel, and more than the cosines of two machines differ by."""
    return (np.round(values, digits) + 0.0).tolist()  # + 0.0 turns -0.0 into 0.0
