"""Split the triangles of a mesh without opening cracks."""

from __future__ import annotations

import numpy as np

# Corners 0 1 2, and 3 4 5 the new vertices on edges 0-1, 1-2, 2-0.
_PATTERNS = {
    1: ([0, 3, 2], [3, 1, 2]),
    2: ([3, 1, 4], [0, 3, 4], [0, 4, 2]),
    3: ([0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]),
}


def edges_of(triangles: np.ndarray) -> np.ndarray:
    """Unique edges (e, 2) of triangles (m, 3), lower vertex first, ascending."""
    pairs = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    return _unpacked(np.unique(_packed(pairs)))


def split_edges(triangles: np.ndarray, edges: np.ndarray, first_new: int) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (k, 3) after adding one vertex on each of `edges` (e, 2), numbered from `first_new`.

    Edges are unique pairs, lower vertex first, in ascending order. Triangles with one, two or three such edges become
    two, three or four with the same orientation; neighbours share the new vertices, so no crack opens. Also returns the
    index (k,) of the original triangle of each.
    """
    if len(edges) == 0:
        return triangles, np.arange(len(triangles))
    middle = _new_vertices(triangles, edges, first_new)
    a, b, c = (middle >= 0).T.astype(np.int8)
    count = a + b + c
    whole = np.flatnonzero(count == 0)
    parts, parents = [triangles[whole]], [whole]
    for number, pattern in _PATTERNS.items():
        parent = np.flatnonzero(count == number)
        six = _six_points(triangles[parent], middle[parent], number)
        parts += [six[:, part] for part in pattern]
        parents += [parent] * len(pattern)
    return np.concatenate(parts), np.concatenate(parents)


def _six_points(triangles: np.ndarray, middle: np.ndarray, number: int) -> np.ndarray:
    """Corners and new vertices (m, 6) of the triangles with `number` split edges.

    Each is rotated so that its single split edge, or the first of two adjacent ones, comes first.
    """
    has = middle >= 0
    first = has.argmax(axis=1) if number == 1 else (has.argmin(axis=1) + 1) % 3 if number == 2 else 0
    turn = (np.reshape(first, (-1, 1)) + np.arange(3)) % 3 + np.zeros((len(triangles), 1), np.int64)
    return np.concatenate(
        [np.take_along_axis(triangles, turn, axis=1), np.take_along_axis(middle, turn, axis=1)], axis=1
    )


def _new_vertices(triangles: np.ndarray, edges: np.ndarray, first_new: int) -> np.ndarray:
    """For each triangle's edges 0-1, 1-2, 2-0, the index of the new vertex on it, or -1."""
    middle = np.full(triangles.shape, -1, triangles.dtype)
    touched = np.zeros(first_new, bool)
    touched[edges] = True
    a, b, c = (touched[corner] for corner in triangles.T)
    about = np.flatnonzero(a & b | b & c | c & a)  # only these can have one of the edges
    wanted = _packed(edges)
    keys = _packed(np.sort(triangles[about][:, [[0, 1], [1, 2], [2, 0]]], axis=2))
    place = np.minimum(np.searchsorted(wanted, keys), len(wanted) - 1)
    middle[about] = np.where(wanted[place] == keys, place + first_new, -1)
    return middle


def _packed(pairs: np.ndarray) -> np.ndarray:
    return pairs[..., 0].astype(np.int64) << 32 | pairs[..., 1]


def _unpacked(keys: np.ndarray) -> np.ndarray:
    return np.stack([keys >> 32, keys & 0xFFFFFFFF], axis=-1)
