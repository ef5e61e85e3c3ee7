"""Where on their paths groups begin, so that those who shall meet do, and nobody walks through anybody."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..noise import stream
from .crowds import HORIZON_S, Crowd, clear_until_s, nearest_m

_STARTS = 96  # tried, evenly along the path, in an order drawn from the seed
_GAP_M = 0.5
_SOON_S = 600.0  # by when those who shall meet have met


def choose_start(
    path_m: float,
    begun_at: Callable[[float], Crowd],
    others: Sequence[Crowd],
    meets: Sequence[Crowd],
    within_m: float,
    seed: int,
    name: str,
) -> float | None:
    """A distance along a path of length path_m to begin at; None where no start brings a group to those it `meets`.

    begun_at gives the group, called `name`, that begins there. Of the starts that bring it within_m of each of `meets`
    in ten minutes, it takes one that keeps it clear of `others` up to HORIZON_S, or else the one that does so longest.
    """
    best_m, longest_s = None, -1.0
    for start_m in _starts(path_m, seed, name):
        crowd = begun_at(start_m)
        if any(nearest_m(crowd, other, 2.0 * within_m, _SOON_S) > within_m for other in meets):
            continue
        clear_s = min((clear_until_s(crowd, other, _GAP_M) for other in others), default=HORIZON_S)
        if clear_s > longest_s:
            best_m, longest_s = start_m, clear_s
        if clear_s == HORIZON_S:
            break
    return best_m


def _starts(path_m: float, seed: int, name: str) -> list[float]:
    rng = stream(seed, f"start/{name}")
    return (path_m * (rng.permutation(_STARTS) + rng.uniform()) / _STARTS).tolist()
