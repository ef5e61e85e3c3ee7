"""Cuts long flights into clips, of what is worth keeping."""

from __future__ import annotations

import zlib

import numpy as np

from .noise import stream

_USUAL_S = 30.0  # of a clip
_GAP_S = 2.0  # without actors, which is no reason to end a clip

Stretch = tuple[int, int]  # first frame, number of frames


def cut(flight: dict, seen: np.ndarray, seed: int) -> list[Stretch]:
    """The clips of a flight, in order: stretches of frames, none longer than clip_length_s.

    seen (n,): in which of its frames there is an actor. All frames, or those and as many others as `negatives` asks
    for, as far as there are any; which, hangs on the seed and the flight's id.
    """
    rate_hz = flight["frame_rate_hz"]
    longest = max(1, int(np.floor(flight.get("clip_length_s", _USUAL_S) * rate_hz + 1e-9)))
    if flight["keep"] == "all":
        return _parts(0, len(seen), longest)
    kept = _without_gaps(seen, int(_GAP_S * rate_hz))
    shown = [part for first, frames in _runs(kept) for part in _parts(first, frames, longest)]
    empty = [part for first, frames in _runs(~kept) for part in _parts(first, frames, longest)]
    wanted = flight["negatives"] / (1.0 - flight["negatives"]) * kept.sum()
    return sorted(shown + _chosen(empty, wanted, flight["id"], seed))


def clips_of(flight: dict, stretches: list[Stretch]) -> list[dict]:
    """The clips of a config that these stretches of a flight are."""
    shared = {key: flight[key] for key in ("season", "frame_rate_hz", "flight")}
    return [
        {
            "id": f"{flight['id']}_{k:04d}",
            "start_s": round(flight["start_s"] + first / flight["frame_rate_hz"], 9),
            "frames": frames,
            "of_flight": flight["id"],
            **shared,
        }
        for k, (first, frames) in enumerate(stretches)
    ]


def _parts(first: int, frames: int, longest: int) -> list[Stretch]:
    """A stretch in as few parts as possible, as equal as can be."""
    count = -(-frames // longest)
    ends = [first + frames * k // count for k in range(count + 1)]
    return [(begin, end - begin) for begin, end in zip(ends, ends[1:])]


def _runs(kept: np.ndarray) -> list[Stretch]:
    edges = np.flatnonzero(np.diff(np.concatenate([[False], kept, [False]]).astype(int)))
    return [(int(begin), int(end - begin)) for begin, end in zip(edges[::2], edges[1::2])]


def _without_gaps(seen: np.ndarray, longest: int) -> np.ndarray:
    """The same, with gaps between two frames with actors closed that are no longer than so many frames."""
    kept = seen.copy()
    for first, frames in _runs(~seen):
        if frames <= longest and first > 0 and first + frames < len(seen):
            kept[first : first + frames] = True
    return kept


def _chosen(empty: list[Stretch], wanted: float, name: str, seed: int) -> list[Stretch]:
    """Stretches picked at random until they have as many frames as wanted; the last one is shortened."""
    chosen, left = [], round(wanted)
    for k in stream(seed, "negatives", zlib.crc32(name.encode())).permutation(len(empty)):
        if left <= 0:
            break
        first, frames = empty[k]
        chosen.append((first, min(frames, left)))
        left -= frames
    return chosen
