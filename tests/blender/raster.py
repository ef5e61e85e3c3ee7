"""Draw posed bodies and plants on level ground without Blender, as a reference for Blender's pictures."""

import numpy as np

from planner import assets
from planner.groups.actors import poses
from planner.camera import project
from planner.plants.plant_shapes import build_variants

_SMALL_PX = 8  # side of boxes around triangles that are drawn together


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
    covered = np.zeros(np.ceil(flat.max(axis=(0, 1))).astype(int)[::-1] + 1, bool)
    for _, row, column, *_ in _fragments(flat, covered.shape):
        covered[row, column] = True
    return covered.sum() * step_m**2


def draw(world, pose: np.ndarray, triangles: dict[int, np.ndarray], ground_index: int) -> np.ndarray:
    """Object indices (height, width) seen through pixel centres: bodies by index, and the ground at height 0."""
    lens = world.intrinsics
    index = np.full((lens.height_px, lens.width_px), ground_index)
    nearness = 1.0 / _ground_depth(lens, pose)
    for number, corners_m in triangles.items():
        corners_px, depth_m = project(lens, pose, corners_m)
        for triangle, row, column, b, c in _fragments(corners_px, index.shape):
            depths_m = depth_m[triangle].T
            near = (1 - b - c) / depths_m[0] + b / depths_m[1] + c / depths_m[2]
            farthest_first = np.argsort(near, kind="stable")
            row, column, near = row[farthest_first], column[farthest_first], near[farthest_first]
            shown = near > nearness[row, column]
            index[row[shown], column[shown]] = number
            nearness[row[shown], column[shown]] = near[shown]
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


def _fragments(corners_px: np.ndarray, shape: tuple[int, int]):
    """Pixels whose centres triangles (m, 3, 2) cover, in batches: the triangle, row and column of each (n,), and the
    weights b, c (n,) of its second and third corner there."""
    low = np.clip(np.ceil(corners_px.min(axis=1) - 0.5).astype(int), 0, shape[::-1])
    spans = np.clip(np.floor(corners_px.max(axis=1) - 0.5).astype(int) + 1, 0, shape[::-1]) - low
    (ax, ay), (bx, by), (cx, cy) = corners_px.transpose(1, 2, 0)
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    seen = np.nonzero((spans > 0).all(axis=1) & (area != 0))[0]
    small = seen[(spans[seen] <= _SMALL_PX).all(axis=1)]
    for triangle, column, row in _places(low, spans, small, np.setdiff1d(seen, small)):
        x, y = column + 0.5 - ax[triangle], row + 0.5 - ay[triangle]
        b = (x * (cy - ay)[triangle] - y * (cx - ax)[triangle]) / area[triangle]
        c = ((bx - ax)[triangle] * y - (by - ay)[triangle] * x) / area[triangle]
        inside = (b >= 0) & (c >= 0) & (b + c <= 1)
        yield triangle[inside], row[inside], column[inside], b[inside], c[inside]


def _places(low: np.ndarray, spans: np.ndarray, small: np.ndarray, large: np.ndarray):
    """All pixels of the boxes around triangles: the same one of all small boxes at once, then box by box."""
    for step in np.ndindex(_SMALL_PX, _SMALL_PX):
        some = small[(spans[small] > step).all(axis=1)]
        yield some, *(low[some] + step).T
    for triangle in large:
        column, row = np.indices(spans[triangle]).reshape(2, -1) + low[triangle][:, None]
        yield np.full(len(column), triangle), column, row
