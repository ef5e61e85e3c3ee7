"""Triangle meshes of the basic solids of bodies and plants. Lengths in m."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

_RING_STEPS = 4  # rings per given ring, on curves through them
_CAP_RINGS_DEG = {2: (48.0, 89.0), 3: (35.0, 65.0, 89.0)}  # positions of rings on a rounded end, from its rim


@dataclass(frozen=True)
class Mesh:
    """points_m (n, 3); triangles (m, 3), counter-clockwise seen from outside; slot (m,), material slot of each."""

    points_m: np.ndarray
    triangles: np.ndarray
    slot: np.ndarray

    def moved(self, by_m) -> Mesh:
        """The mesh, translated."""
        return Mesh(self.points_m + np.asarray(by_m, float), self.triangles, self.slot)

    def mirrored(self) -> Mesh:
        """The mirror image in the plane y = 0, with triangles that still face outward."""
        return Mesh(self.points_m * [1.0, -1.0, 1.0], self.triangles[:, ::-1], self.slot)

    def scaled(self, by) -> Mesh:
        """The mesh, scaled about the origin by one number, or by (3,) along x, y and z."""
        return Mesh(self.points_m * by, self.triangles, self.slot)

    def with_slot(self, slot: int) -> Mesh:
        """The mesh with all triangles in one material slot."""
        return Mesh(self.points_m, self.triangles, np.full(len(self.triangles), slot))

    def painted(self, from_m, to_m, slot: int) -> Mesh:
        """The mesh with the triangles whose middle is in a box, with corners (3,), in a material slot."""
        middle_m = self.points_m[self.triangles].mean(axis=1)
        inside = ((middle_m >= from_m) & (middle_m <= to_m)).all(axis=1)
        return Mesh(self.points_m, self.triangles, np.where(inside, slot, self.slot))


NOTHING = Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64), np.zeros(0, np.int64))


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """All meshes joined into one."""
    meshes = [NOTHING, *meshes]
    first = np.cumsum([0] + [len(mesh.points_m) for mesh in meshes])
    return Mesh(
        np.concatenate([mesh.points_m for mesh in meshes]),
        np.concatenate([mesh.triangles + start for mesh, start in zip(meshes, first)]),
        np.concatenate([mesh.slot for mesh in meshes]),
    )


def facets(points_m: np.ndarray, triangles: np.ndarray) -> Mesh:
    """A mesh of unconnected triangles in slot 0."""
    return Mesh(np.asarray(points_m, float), np.asarray(triangles), np.zeros(len(triangles), np.int64))


def tube(
    rings_m: np.ndarray,
    sides: int | None = None,
    roundness: float = 0.5,
    steps: int = _RING_STEPS,
    caps: int = 3,
) -> Mesh:
    """A smooth tube through elliptic rings, with rounded ends.

    rings_m (n, 5), n >= 2: centre x y z, half width (along y), half height (in the plane x z).
    sides: number per ring; default: more for thicker tubes.
    roundness: length of the rounded ends, in smaller half axes of the last ring.
    steps: rings per given ring, on curves through them.
    caps: number of rings of each rounded end, 2 or 3.
    """
    sides = sides or _sides_for(rings_m[:, 3:].max())
    rings = _with_caps(_smoothed_rings(np.asarray(rings_m, float), steps), roundness, caps)
    centre, wide, high = rings[:, :3], rings[:, 3], rings[:, 4]
    across, up = _ring_axes(centre)
    angle = 2.0 * np.pi * np.arange(sides) / sides
    points = (
        centre[:, None]
        + np.cos(angle)[:, None] * (wide[:, None] * across)[:, None]
        + np.sin(angle)[:, None] * (high[:, None] * up)[:, None]
    )
    return facets(points.reshape(-1, 3), _tube_triangles(len(rings), sides))


def ellipsoid(
    centre_m, radii_m, yaw_deg: float = 0.0, tilt_deg: float = 0.0, rings: int = 9, sides: int | None = None
) -> Mesh:
    """An ellipsoid with radii along its own x, y, z, tilted about its x axis, then rotated about the vertical."""
    sides = sides or _sides_for(max(radii_m))
    polar = np.pi * (np.arange(rings) + 0.5) / rings
    angle = 2.0 * np.pi * np.arange(sides) / sides
    unit = np.stack(
        [
            np.outer(np.sin(polar), np.cos(angle)),
            np.outer(np.sin(polar), np.sin(angle)),
            np.outer(np.cos(polar), np.ones(sides)),
        ],
        axis=-1,
    )
    points = unit.reshape(-1, 3) * np.asarray(radii_m, float) @ _rotation(yaw_deg, tilt_deg).T
    return facets(points + np.asarray(centre_m, float), _tube_triangles(rings, sides)[:, ::-1])


def sheet(
    outline_m: np.ndarray, thickness_m: float, centre_m, yaw_deg: float = 0.0, tilt_deg: float = 0.0
) -> Mesh:
    """A thin flap, thickest in its middle, inside a smooth closed outline through points (n, 2) in its own x, z.

    The outline runs from x towards z and contains (0, 0), which is moved to centre_m after tilting about x and rotating
    about the vertical, as for an ellipsoid.
    """
    rim = _smoothed_ring(outline_m)
    layers = [(0.05, 0.5), (0.55, 0.42), (0.9, 0.2), (1.0, 0.0), (0.9, -0.2), (0.55, -0.42), (0.05, -0.5)]
    points = [np.insert(share * rim, 1, -thickness_m * y, axis=1) for share, y in layers]
    points = np.concatenate(points) @ _rotation(yaw_deg, tilt_deg).T + np.asarray(centre_m, float)
    return facets(points, _tube_triangles(len(layers), len(rim))[:, ::-1])


def _sides_for(radius_m: float) -> int:
    """A number of sides for a round outline: 8 for a leg, 16 for an elephant's body."""
    return int(np.clip(6 + 30 * radius_m, 8, 16))


def _smoothed_ring(points: np.ndarray) -> np.ndarray:
    """A closed Catmull-Rom curve through points (n, 2): (2 n, 2)."""
    before, after, next_after = (np.roll(points, k, axis=0) for k in (1, -1, -2))
    between = (9.0 * (points + after) - before - next_after) / 16.0
    return np.stack([points, between], axis=1).reshape(-1, 2)


def _smoothed_rings(rings: np.ndarray, steps: int) -> np.ndarray:
    """Catmull-Rom curves through all five columns."""
    if len(rings) < 3:
        return rings
    ends = np.concatenate([[2 * rings[0] - rings[1]], rings, [2 * rings[-1] - rings[-2]]])
    p0, p1, p2, p3 = ends[:-3], ends[1:-2], ends[2:-1], ends[3:]
    u = (np.arange(steps) / steps)[None, :, None]
    p0, p1, p2, p3 = (p[:, None] for p in (p0, p1, p2, p3))
    inner = 0.5 * (
        2 * p1
        + u * (p2 - p0)
        + u**2 * (2 * p0 - 5 * p1 + 4 * p2 - p3)
        + u**3 * (3 * p1 - p0 - 3 * p2 + p3)
    )
    return np.concatenate([inner.reshape(-1, 5), rings[-1:]])


def _with_caps(rings: np.ndarray, roundness: float, caps: int) -> np.ndarray:
    """The rings, with shrinking rings added past each end, the last of which is nearly a point."""
    return np.concatenate(
        [
            _cap(rings[0], rings[0] - rings[1], roundness, caps)[::-1],
            rings,
            _cap(rings[-1], rings[-1] - rings[-2], roundness, caps),
        ]
    )


def _cap(ring: np.ndarray, outward: np.ndarray, roundness: float, caps: int) -> np.ndarray:
    direction = outward[:3] / max(np.linalg.norm(outward[:3]), 1e-12)
    reach = roundness * ring[3:].min()
    angle = np.radians(_CAP_RINGS_DEG[caps])[:, None]
    return np.concatenate([ring[:3] + reach * np.sin(angle) * direction, ring[3:] * np.cos(angle)], axis=1)


def _ring_axes(centre: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors (n, 3) across (horizontal, roughly +y) and up of each ring, both perpendicular to the tube."""
    along = np.gradient(centre, axis=0)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    across = np.array([0.0, 1.0, 0.0]) - along[:, 1:2] * along
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
    return across, np.cross(along, across)


def _tube_triangles(rings: int, sides: int) -> np.ndarray:
    """Side faces between successive rings, and a fan that closes each end."""
    here = np.arange(rings * sides).reshape(rings, sides)
    right = np.roll(here, -1, axis=1)
    a, b, c, d = here[:-1].ravel(), right[:-1].ravel(), right[1:].ravel(), here[1:].ravel()
    fan = np.stack([np.zeros(sides - 2, np.int64), np.arange(2, sides), np.arange(1, sides - 1)], axis=1)
    return np.concatenate(
        [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1), fan, fan[:, ::-1] + (rings - 1) * sides]
    )


def _rotation(yaw_deg: float, tilt_deg: float) -> np.ndarray:
    cy, sy = np.cos(np.radians(yaw_deg)), np.sin(np.radians(yaw_deg))
    ct, st = np.cos(np.radians(tilt_deg)), np.sin(np.radians(tilt_deg))
    yaw = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    return yaw @ np.array([[1.0, 0.0, 0.0], [0.0, ct, -st], [0.0, st, ct]])
