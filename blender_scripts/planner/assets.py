"""Read species, plants, structures and sites from `assets/`."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path

from . import asset_checks, models
from .config import ROOT
from .faults import ConfigError, check_known


@lru_cache(maxsize=None)
def names(kind: str) -> tuple[str, ...]:
    """Names of all files of a kind, such as `species` or `plants`, sorted."""
    return tuple(sorted(path.stem for path in _folder(kind).glob("*.json")))


@lru_cache(maxsize=None)
def load(kind: str, name: str) -> dict:
    """The content of one file, which callers must not modify. ConfigError if it cannot be read or is incomplete.

    A `model` comes with its defaults, the full path of its file and its size; plants with a model have one variant.
    """
    where = f"assets/{kind}/{name}.json"
    data = _read(where, _folder(kind) / f"{name}.json")
    asset_checks.check(where, kind, data)
    if "material" in data:
        check_known(data["material"], names("materials"), f"{where}: material", "a material")
    for part, slot in data.get("materials", {}).items():
        _check_slot(f"{where}: materials.{part}", slot)
    if kind == "species" or "model" in data:
        parts = load("materials", data["material"]).get("parts", {})
        asset_checks.check_parts(where, data, parts)
    if "model" in data:
        data["model"] = models.checked(where, _folder(kind), data["model"], parts)
        if kind == "plants":
            data["variants"] = 1
    return data


def standing(name: str) -> dict:
    """The file of a static object: a plant, or a structure."""
    return load(kind_of(name), name)


def kind_of(name: str) -> str:
    """The folder of a static object: `plants` or `structures`."""
    return "plants" if name in names("plants") else "structures"


def _check_slot(where: str, slot) -> None:
    """Raise ConfigError unless a slot names a material, or a material and one of its parts."""
    material, part = (slot, "") if isinstance(slot, str) else slot
    check_known(material, names("materials"), where, "a material")
    if part:
        check_known(part, load("materials", material).get("parts", {}), where, f"a part of {material}")


def _read(where: str, path: Path) -> dict:
    """The JSON object in a file."""
    try:
        text = path.read_text(encoding="utf-8")
        if not text.strip():
            raise ConfigError(f"{where}: the file is empty; expected JSON")
        data = json.loads(text)
    except OSError as error:
        raise ConfigError(f"{where}: expected a readable file ({error.strerror})") from error
    except ValueError as error:
        raise ConfigError(f"{where}: expected JSON ({error})") from error
    if not isinstance(data, dict):
        raise ConfigError(f"{where}: expected a JSON object")
    return data


def _folder(kind: str) -> Path:
    return ROOT / "assets" / kind
