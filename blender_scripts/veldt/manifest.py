"""The manifest beside a clip's passes: the meaning of their indices, and camera and actor poses per frame.

Contract: configs/schema/manifest.schema.json.
"""

from __future__ import annotations

import json

import numpy as np

from .bake.baked import BakedScene, BakedTrack

LAYER = "Scene"
ACTOR_LAYER = "Actors"


def frame_file(number: int) -> str:
    """Name of a frame's passes."""
    return f"{number:06d}.exr"


def build_manifest(
    scene: BakedScene, track: BakedTrack, clip: dict, supersample: int, actor_layer: bool
) -> dict:
    """The manifest of one clip of a plan."""
    header = scene.header
    return {
        "format": "veldt-passes",
        "version": 1,
        "clip": track.clip,
        **({"of_flight": clip["of_flight"]} if clip["of_flight"] else {}),
        "scene": header["name"],
        "seed": header["seed"],
        "frame_rate_hz": clip["frame_rate_hz"],
        "layer": LAYER,
        **({"actor_layer": ACTOR_LAYER} if actor_layer else {}),
        "supersample": supersample,
        "overscan_px": header["view_margin_px"],
        "camera": track.camera or header["camera"],
        "objects": header["objects"],
        "materials": header["materials"],
        **({"beds": header["beds"]} if "beds" in header else {}),
        "frames": _frames(track, [actor["object"] for actor in header["actors"]]),
    }


def to_json(manifest: dict) -> str:
    """The manifest as text, deterministic, with one frame per line."""
    frames = ",\n".join("  " + json.dumps(frame) for frame in manifest["frames"])
    head = json.dumps({**manifest, "frames": []}, indent=1)
    return head[: head.rindex("[]")] + f"[\n{frames}\n ]\n}}\n"


def _frames(track: BakedTrack, indices: list[int]) -> list[dict]:
    return [
        {
            "file": frame_file(k),
            "time_s": round(float(track.time_s[k]), 9),
            "agl_m": round(float(track.agl_m[k]), 6),
            "look_angle_deg": round(float(track.look_angle_deg[k]), 6),
            "camera_to_world": _rounded(track.camera_to_world[k].ravel(), 9),
            "actors": [_place_of(index, track, actor, k) for actor, index in enumerate(indices)],
        }
        for k in range(len(track.time_s))
    ]


def _place_of(index: int, track: BakedTrack, actor: int, frame: int) -> dict:
    return {
        "index": index,
        "position_m": _rounded(track.actor_position_m[actor, frame]),
        "heading_rad": round(float(track.actor_heading_rad[actor, frame]), 9),
    }


def _rounded(values: np.ndarray, digits: int = 6) -> list:
    """Numbers rounded to the micrometre: far less than a pixel, and more than the differences of cosines between
    machines.
    """
    return (np.round(values, digits) + 0.0).tolist()  # + 0.0 turns -0.0 into 0.0
