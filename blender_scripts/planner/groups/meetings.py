"""Choose where groups start on their paths, so that intended meetings happen and groups do not collide."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..noise import stream
from .collision_discs import HORIZON_S, Crowd, clear_until_s, nearest_m

_STARTS = 96  # candidates, evenly spaced along the path, tried in an order drawn from the seed
_GAP_M = 0.5
_SOON_S = 600.0  # by when intended meetings have happened


def choose_start(
    path_m: float,
    begun_at: Callable[[float], Crowd],
    others: Sequence[Crowd],
    meets: Sequence[Crowd],
    within_m: float,
    seed: int,
    name: str,
) -> float | None:
    """A starting distance along a path of length path_m; None if no start brings the group to those it `meets`.

    begun_at returns the group, called `name`, for a start. Of the starts that bring it to within_m of each of `meets`
    within ten minutes, chooses one that keeps it clear of `others` until HORIZON_S, or else for as long as possible.
    """
    best_m, longest_s = None, -1.0
    for start_m in _starts(path_m, seed, name):
        crowd = begun_at(start_m)
        if any(nearest_m(crowd, other, 2.0 * within_m, _SOON_S) > within_m for other in meets):
            continue
        clear_s = _clear_of_all_until_s(crowd, others, longest_s)
        if clear_s > longest_s:
            best_m, longest_s = start_m, clear_s
        if clear_s == HORIZON_S:
            break
    return best_m


def _clear_of_all_until_s(crowd: Crowd, others: Sequence[Crowd], enough_s: float) -> float:
    """Until when a crowd stays clear of all others, or of those up to the first that it meets by enough_s."""
    clear_s = HORIZON_S
    for other in others:
        clear_s = min(clear_s, clear_until_s(crowd, other, _GAP_M))
        if clear_s <= enough_s:
            break
    return clear_s


def _starts(path_m: float, seed: int, name: str) -> list[float]:
    rng = stream(seed, f"start/{name}")
    return (path_m * (rng.permutation(_STARTS) + rng.uniform()) / _STARTS).tolist()
