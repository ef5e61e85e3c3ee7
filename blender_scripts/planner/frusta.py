"""The part of space that a camera sees, bounded by planes, for many poses at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .camera import Intrinsics, edge_tangents


@dataclass(frozen=True)
class Frusta:
    """View frusta of n poses: the space inside the planes of the picture's four sides, in front of the camera.

    normals (3, 5, n): unit vectors that point outwards, in world axes; offsets_m (5, n): of the planes along them.
    """

    normals: np.ndarray
    offsets_m: np.ndarray

    def at(self, frames: np.ndarray) -> Frusta:
        """Frusta of some of the poses, by their indices."""
        return Frusta(self.normals[..., frames], self.offsets_m[..., frames])

    def may_show(self, x_m: np.ndarray, y_m: np.ndarray, z_m: tuple, radius_m) -> np.ndarray:
        """Mask (..., n) of the poses whose picture may show spheres at any height in a range.

        x_m and y_m (..., n) are their centres', z_m the range of their centres' heights, numbers or (..., n); radius_m
        is a number, (..., n) or (..., 1). False only where a sphere is entirely outside one of the planes.
        """
        east, north, up = self.normals
        x_m, y_m, low_m, high_m = (np.atleast_1d(along)[..., None, :] for along in (x_m, y_m, *z_m))
        nearest_m = np.minimum(up * low_m, up * high_m) - self.offsets_m
        inside = east * x_m + north * y_m + nearest_m < np.atleast_1d(radius_m)[..., None, :]
        return inside.all(axis=-2)


def frusta_of(intrinsics: Intrinsics, camera_to_world: np.ndarray) -> Frusta:
    """The frusta of poses (n, 4, 4)."""
    position_m = camera_to_world[:, :3, 3].T
    normals = np.einsum("nij,kj->ikn", camera_to_world[:, :3, :3], _outward(intrinsics))
    return Frusta(normals, np.einsum("ikn,in->kn", normals, position_m))


def _outward(intrinsics: Intrinsics) -> np.ndarray:
    """Unit normals (5, 3) in camera axes, pointing outwards: left, top, right, bottom, and behind the camera."""
    (left, top), (right, bottom) = edge_tangents(intrinsics)
    normals = np.array(
        [[-1.0, 0.0, -left], [0.0, -1.0, -top], [1.0, 0.0, -right], [0.0, 1.0, -bottom], [0.0, 0.0, -1.0]]
    )
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)
