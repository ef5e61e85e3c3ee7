"""Reads what species and plants are from `assets/`."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path

from .config import ROOT
from .faults import ConfigError


@lru_cache(maxsize=None)
def names(kind: str) -> tuple[str, ...]:
    """Names of all files of a kind, `species` or `plants`, in order."""
    return tuple(sorted(path.stem for path in _folder(kind).glob("*.json")))


@lru_cache(maxsize=None)
def load(kind: str, name: str) -> dict:
    """One file's content; callers must not change it. ConfigError if it cannot be read as JSON."""
    try:
        return json.loads((_folder(kind) / f"{name}.json").read_text(encoding="utf-8"))
    except OSError as error:
        raise ConfigError(
            f"assets/{kind}/{name}.json: expected a readable file ({error.strerror})"
        ) from error
    except ValueError as error:
        raise ConfigError(f"assets/{kind}/{name}.json: expected JSON ({error})") from error


def _folder(kind: str) -> Path:
    return ROOT / "assets" / kind
