"""What must be true after a disturbed run and one that resumes it."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable
from pathlib import Path

from datasets import content_of

_MOST = 4  # names in a message
_TEMPORARY = (".part", ".tmp", ".spool")

Committed = dict[str, dict[str, tuple[int, int]]]


def committed(work: Path) -> Committed:
    """Inode and time of each file of the clips that are complete, by folder; the next run makes others again."""
    found: Committed = {}
    for record in sorted(work.glob("*/clips/*/clip.json")):
        clip = record.parent
        if clip.name.endswith(".part") or json.loads(record.read_text(encoding="utf-8")).get("skipped"):
            continue
        files = [file for file in clip.rglob("*") if file.is_file()]
        found[str(clip.relative_to(work))] = {
            str(file.relative_to(clip)): (file.stat().st_ino, file.stat().st_mtime_ns) for file in files
        }
    return found


_NAMED = re.compile(r"veldt: warning: cannot remove (.+?): [^:]+; the next run tries again")


def left_over_in(messages: Iterable[str], work: Path) -> set[Path]:
    """Temporary files and folders that runs in a folder could not remove, and named."""
    return {work / name for text in messages for name in _NAMED.findall(text)}


def problems(work: Path, wanted: Path, earlier: Committed, named: Collection[Path] = ()) -> list[str]:
    """What is wrong with a folder that should be as `wanted`, and should have kept what was committed earlier. What was
    named may be left over."""
    found = _differences(work, wanted, named) + _temporary(work, named)
    now = committed(work)
    for clip, files in earlier.items():
        if clip not in now:
            found.append(f"{clip} was committed and is gone")
        elif now[clip] != files:
            found.append(f"{clip} was committed and is made again")
    return found


def _differences(work: Path, wanted: Path, named: Collection[Path]) -> list[str]:
    ours, theirs = content_of(work), content_of(wanted)
    extra, extra_folders, extra_previews = (
        {name for name in found if not _is_below(work / name, named)}
        for found in (
            ours.keys() - theirs.keys(),
            _folders(work) - _folders(wanted),
            _previews(work) - _previews(wanted),
        )
    )
    changed = [name for name in ours if name in theirs and ours[name] != theirs[name]]
    found = [
        _listed("lost", theirs.keys() - ours.keys()),
        _listed("extra", extra),
        _listed("changed", changed),
        _listed("extra folders", extra_folders),
        _listed("lost folders", _folders(wanted) - _folders(work)),
        _listed("lost previews", _previews(wanted) - _previews(work)),
        _listed("extra previews", extra_previews),
    ]
    return [line for line in found if line]


def _temporary(work: Path, named: Collection[Path]) -> list[str]:
    paths = [path for path in work.rglob("*") if path.name.endswith(_TEMPORARY)] + [*(work / "tmp").iterdir()]
    names = [str(path.relative_to(work)) for path in paths if not _is_below(path, named)]
    return [_listed("temporary", names)] if names else []


def _is_below(path: Path, places: Collection[Path]) -> bool:
    return any(place == path or place in path.parents for place in places)


def _folders(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_dir()}


def _previews(folder: Path) -> set[str]:
    """Their bytes may vary; that they are there, and not empty, may not."""
    return {str(path.relative_to(folder)) for path in folder.rglob("preview.mp4") if path.stat().st_size > 0}


def _listed(what: str, names) -> str:
    names = sorted(names)
    if not names:
        return ""
    more = f" and {len(names) - _MOST} more" if len(names) > _MOST else ""
    return f"{what}: {', '.join(names[:_MOST])}{more}"
