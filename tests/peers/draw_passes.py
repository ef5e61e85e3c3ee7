"""Draw passes for the tests beside it; run by the Python that has OpenImageIO, which their environment lacks.

draw_passes.py FOLDER writes FOLDER/{masks_a,masks_b}, clips with irregular masks, and FOLDER/{march_a,march_b}, clips
of boxes that are easy to calculate with, FOLDER/survey, a clip with poses of its camera, and beside
each its object planes, (frames, height, width), as .npy.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

import passes
from pictures import write_exr

GROUND, FIRST = passes.GROUND, 101
CATEGORIES = ("human", "elephant", "zebra")
ACTORS = 6  # of index FIRST and on, two of each category
MASKS_HEIGHT, MASKS_WIDTH = 41, 67
MARCH_HEIGHT, MARCH_WIDTH = 96, 160
SURVEY_FRAMES = 12
BOX_WIDTH, BOX_HEIGHT = 20, 9  # of the marching actors


def _ground(height: int, width: int) -> np.ndarray:
    return np.full((height, width), GROUND, np.float32)


def _odd_masks(seed: int) -> list[np.ndarray]:
    """Object planes with masks that are hard for run-length codes."""
    planes = [_ground(MASKS_HEIGHT, MASKS_WIDTH) for _ in range(9)]
    planes[0][:] = FIRST  # all of the picture
    planes[1][0, 0], planes[1][-1, -1] = FIRST, FIRST + 1  # the first pixel, the last
    planes[1][0, -1], planes[1][-1, 0] = FIRST + 2, FIRST + 3
    planes[1][20, 30] = FIRST + 4
    planes[2][:, 0], planes[2][:, 30:32], planes[2][:, -1] = (
        FIRST,
        FIRST + 1,
        FIRST + 2,
    )  # columns of full height
    planes[3][0, :], planes[3][7:9, :], planes[3][-1, :] = FIRST, FIRST + 1, FIRST + 2  # rows of full width
    planes[4][10:20, 5:10] = planes[4][10:20, 40:60] = FIRST  # in two parts, a trunk between
    rows, columns = np.mgrid[:MASKS_HEIGHT, :MASKS_WIDTH]
    planes[5][(rows + columns) % 2 == 0] = FIRST  # as many runs as there are pixels
    planes[5][(rows + columns) % 2 == 1] = FIRST + 1
    random = np.random.default_rng(seed)
    for plane in planes[6:8]:  # all but the last, which is empty
        noise = random.integers(0, ACTORS + 2, plane.shape)
        plane[noise < ACTORS] = FIRST + noise[noise < ACTORS]
    planes[7][random.random(planes[7].shape) < 0.9] = GROUND
    return planes


def _march(seed: int) -> list[np.ndarray]:
    """Actors in lanes of their own, so that no box meets another; the third comes and goes, the last frame is empty."""
    planes = [_ground(MARCH_HEIGHT, MARCH_WIDTH) for _ in range(21)]
    for frame, plane in enumerate(planes[:-1]):
        for k in range(ACTORS):
            if k == 2 and 5 <= frame < 9:
                continue
            x, y = 5 + seed + 5 * frame, 3 + 15 * k
            plane[y : y + BOX_HEIGHT, x : x + BOX_WIDTH] = FIRST + k
    return planes


def _turned(yaw_deg: float, pitch_deg: float, roll_deg: float) -> np.ndarray:
    """Axes of a camera (x right, y down, z forward) in columns, in east, north, up: a body whose front is the picture's
    top and whose down is the view, turned by yaw about down, then pitch about right, then roll about front.
    """
    yaw, pitch, roll = np.radians([yaw_deg, pitch_deg, roll_deg])
    about_down = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
    about_right = np.array([[np.cos(pitch), 0, np.sin(pitch)], [0, 1, 0], [-np.sin(pitch), 0, np.cos(pitch)]])
    about_front = np.array([[1, 0, 0], [0, np.cos(roll), -np.sin(roll)], [0, np.sin(roll), np.cos(roll)]])
    front, right, down = (about_down @ about_right @ about_front).T  # in north, east, down
    axes = np.column_stack([right, -front, down])
    return axes[[1, 0, 2]] * [[1], [1], [-1]]


def _survey_poses() -> list[dict]:
    """Poses of a flight, of all headings and up to 1.5 km from the origin, and their angles."""
    random = np.random.default_rng(3)
    poses = []
    for k in range(SURVEY_FRAMES):
        angles = [360 * k / SURVEY_FRAMES, random.uniform(-20, 80), random.uniform(-30, 30)]
        pose = np.eye(4)
        pose[:3, :3] = _turned(*angles)
        pose[:3, 3] = *random.uniform(-1500, 1500, 2), random.uniform(-5, 400)
        poses.append({"angles_deg": angles, "camera_to_world": pose.ravel().tolist()})
    return poses


def _write_survey(folder: Path) -> None:
    poses = _survey_poses()
    planes = _odd_masks(0)[:1] * len(poses)
    _write(folder, planes)
    document = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    for frame, pose in zip(document["frames"], poses):
        frame["camera_to_world"] = pose["camera_to_world"]
    passes.write_manifest(folder, document)
    folder.with_suffix(".json").write_text(json.dumps(poses), encoding="utf-8")


def _manifest(clip: str, planes: list[np.ndarray]) -> dict:
    document = passes.manifest(clip, len(planes))
    height, width = planes[0].shape
    document["camera"] |= {"width_px": width, "height_px": height, "cx_px": width / 2, "cy_px": height / 2}
    document["objects"] = document["objects"][:1] + [
        {"index": FIRST + k, "name": f"actor{k}", "class": "actor", "track_id": 10 + k}
        | {"material": CATEGORIES[k % 3], "category": CATEGORIES[k % 3]}
        for k in range(ACTORS)
    ]
    return document


def _write(folder: Path, planes: list[np.ndarray]) -> None:
    folder.mkdir(parents=True)
    for frame, plane in enumerate(planes):
        depth = np.full(plane.shape, 40.0, np.float32)
        write_exr(folder / f"{frame:06d}.exr", {passes.OBJECTS: plane, passes.DEPTH: depth})
    passes.write_manifest(folder, _manifest(folder.name, planes))
    np.save(folder.with_suffix(".npy"), np.stack(planes).astype(int))


def main(folder: Path) -> None:
    """Draw all of them."""
    for seed, name in enumerate("ab"):
        _write(folder / f"masks_{name}", _odd_masks(seed))
        _write(folder / f"march_{name}", _march(seed))
    _write_survey(folder / "survey")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
