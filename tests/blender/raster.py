"""Draw posed bodies and plants on level ground without Blender, as a reference for Blender's pictures."""

import numpy as np

from veldt import assets
from veldt.groups.actors import poses
from veldt.camera import project
from veldt.plants.plant_shapes import build_variants


def world_triangles(actor, time_s: float) -> np.ndarray:
    """Corners (m, 3, 3) of an actor's posed body in the world."""
    mesh = poses(actor, np.array([time_s])).mesh(actor.body, 0)
    return mesh.points_m[mesh.triangles]


def plant_triangles(world, name: str) -> np.ndarray:
    """Corners (m, 3, 3) of all plants of a species in the world."""
    planting, data = world.plantings[name], assets.load("plants", name)
    variants = build_variants(name, data, world.config["seed"])
    plants = []
    for point, yaw, scale, variant in zip(
        planting.points_m, planting.yaw_rad, planting.scale, planting.variant
    ):
        mesh = variants[variant]
        cos, sin = np.cos(yaw), np.sin(yaw)
        turn = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])
        plants.append((scale * mesh.points_m @ turn.T + point)[mesh.triangles])
    return np.concatenate(plants)


def covered_m2(triangles_m: np.ndarray, step_m: float = 0.04) -> float:
    """Ground that triangles (m, 3, 3) hide from straight above, counted in squares of step_m."""
    flat = triangles_m[..., :2] / step_m
    flat = flat - np.floor(flat.min(axis=(0, 1)))
    covered = np.zeros(np.ceil(flat.max(axis=(0, 1))).astype(int) + 1, bool)
    first = np.ceil(flat.min(axis=1) - 0.5).astype(int)
    spans = np.floor(flat.max(axis=1) - 0.5).astype(int) + 1 - first
    for steps in np.ndindex(*spans.max(axis=0)):  # of all triangles at once, the largest ones last
        here = np.nonzero((spans > steps).all(axis=1))[0]
        cell = first[here] + steps
        a, b, c = (flat[here] - (cell + 0.5)[:, None]).transpose(1, 0, 2)
        turns = np.stack([p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] for p, q in ((a, b), (b, c), (c, a))])
        inside = (turns >= 0).all(axis=0) | (turns <= 0).all(axis=0)
        covered[tuple(cell[inside].T)] = True
    return covered.sum() * step_m**2


def draw(world, pose: np.ndarray, triangles: dict[int, np.ndarray], ground_index: int) -> np.ndarray:
    """Object indices (height, width) seen through pixel centres: bodies by index, and the ground at height 0."""
    lens = world.intrinsics
    index = np.full((lens.height_px, lens.width_px), ground_index)
    nearness = 1.0 / _ground_depth(lens, pose)
    for number, corners_m in triangles.items():
        for corners_px, depth_m in zip(*project(lens, pose, corners_m)):
            _draw_triangle(index, nearness, number, corners_px, depth_m)
    return index


def farthest_from_an_edge(world, pose: np.ndarray, triangles: np.ndarray, pixels: np.ndarray) -> float:
    """Largest distance in px of pixel centres (n, 2) of (column, row) to their nearest projected triangle edge."""
    corners_px, _ = project(world.intrinsics, pose, triangles)
    start = corners_px.reshape(-1, 2)
    along = np.roll(corners_px, -1, axis=1).reshape(-1, 2) - start
    gaps = []
    for pixel in pixels + 0.5:
        share = ((pixel - start) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-30)
        nearest = start + np.clip(share, 0, 1)[:, None] * along
        gaps.append(np.linalg.norm(nearest - pixel, axis=1).min())
    return max(gaps, default=0.0)


def _ground_depth(lens, pose: np.ndarray) -> np.ndarray:
    """Depth of the plane z = 0 at pixel centres; infinite above the horizon."""
    column, row = np.meshgrid(np.arange(lens.width_px) + 0.5, np.arange(lens.height_px) + 0.5)
    (fx_px, fy_px), (cx_px, cy_px) = lens.focal_px, lens.centre_px
    falling = -pose[2, 0] * (column - cx_px) / fx_px - pose[2, 1] * (row - cy_px) / fy_px - pose[2, 2]
    return np.where(falling > 0, pose[2, 3] / np.maximum(falling, 1e-30), np.inf)


def _draw_triangle(index, nearness, number, corners_px, depth_m) -> None:
    """Fill the pixels whose centres the triangle covers and is nearest in; 1 / depth is linear in the picture."""
    height, width = index.shape
    low = np.clip(np.ceil(corners_px.min(axis=0) - 0.5).astype(int), 0, [width, height])
    high = np.clip(np.floor(corners_px.max(axis=0) - 0.5).astype(int) + 1, 0, [width, height])
    if (low >= high).any():
        return
    column, row = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
    (ax, ay), (bx, by), (cx, cy) = corners_px
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area == 0:
        return
    b = ((column - ax) * (cy - ay) - (row - ay) * (cx - ax)) / area
    c = ((bx - ax) * (row - ay) - (by - ay) * (column - ax)) / area
    near = (1 - b - c) / depth_m[0] + b / depth_m[1] + c / depth_m[2]
    window = np.s_[low[1] : high[1], low[0] : high[0]]
    shown = (b >= 0) & (c >= 0) & (b + c <= 1) & (near > nearness[window])
    index[window][shown] = number
    nearness[window][shown] = near[shown]
