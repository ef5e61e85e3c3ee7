"""Cut long flights into clips, keeping the parts worth rendering."""

from __future__ import annotations

import zlib

import numpy as np

from .noise import stream

_USUAL_S = 30.0  # of a clip
_GAP_S = 2.0  # a shorter stretch without actors does not end a clip

Stretch = tuple[int, int]  # first frame, number of frames


def cut(flight: dict, seen: np.ndarray, seed: int) -> list[Stretch]:
    """The clips of a flight, in order: ranges of frames, none longer than clip_length_s.

    seen (n,): the frames that contain an actor. Keeps all frames, or those with actors and, where available, as many
    others as `negatives` requests; these are chosen by the seed and the flight's id.
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
    """The clips of a config for these stretches of a flight."""
    shared = {key: flight[key] for key in ("frame_rate_hz", "flight", "camera") if key in flight}
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
    """A stretch split into as few parts as possible, of nearly equal length."""
    count = -(-frames // longest)
    ends = [first + frames * k // count for k in range(count + 1)]
    return [(begin, end - begin) for begin, end in zip(ends, ends[1:])]


def _runs(kept: np.ndarray) -> list[Stretch]:
    edges = np.flatnonzero(np.diff(np.concatenate([[False], kept, [False]]).astype(int)))
    return [(int(begin), int(end - begin)) for begin, end in zip(edges[::2], edges[1::2])]


def _without_gaps(seen: np.ndarray, longest: int) -> np.ndarray:
    """The same mask with gaps of at most the given number of frames between two frames with actors closed."""
    kept = seen.copy()
    for first, frames in _runs(~seen):
        if frames <= longest and first > 0 and first + frames < len(seen):
            kept[first : first + frames] = True
    return kept


def _chosen(empty: list[Stretch], wanted: float, name: str, seed: int) -> list[Stretch]:
    """Stretches picked at random until they have the requested number of frames; the last one is shortened."""
    chosen, left = [], round(wanted)
    for k in stream(seed, "negatives", zlib.crc32(name.encode())).permutation(len(empty)):
        if left <= 0:
            break
        first, frames = empty[k]
        chosen.append((first, min(frames, left)))
        left -= frames
    return chosen
