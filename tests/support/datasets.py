"""Datasets made from one config: comparison and damage."""

from __future__ import annotations

import json
from pathlib import Path

from program import files_below

_PREVIEW = "preview.mp4"  # the encoder's output may depend on timing: the same pictures, other bytes


def content_of(folder: Path) -> dict:
    """The bytes of every file of a dataset by name, without the previews and their hashes."""
    return {name: _content(folder, name) for name in files_below(folder) if not name.endswith(_PREVIEW)}


def _content(folder: Path, name: str):
    file = folder / name
    if file.name == "clip.json" and ".part/" not in name:
        record = json.loads(file.read_text(encoding="utf-8"))
        record["files"].pop(_PREVIEW)
        record.pop("made_from_sha256", None)  # of the passes, which may be of another kind
        return record
    if file.name == "dataset.json":
        lines = file.read_text(encoding="utf-8").splitlines()
        return [line for line in lines if '"record_sha256"' not in line]
    return file.read_bytes()


def flip_bit(file: Path, position: int | None = None) -> None:
    """Flip the lowest bit of one byte: by default the one in the middle."""
    content = bytearray(file.read_bytes())
    content[len(content) // 2 if position is None else position] ^= 1
    file.write_bytes(content)
