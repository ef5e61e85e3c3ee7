"""Checks of species and plant files that their schema, which `veldt` checks, cannot state; faults name file and key."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from fnmatch import fnmatchcase

from .faults import ConfigError, check_known

_PLAIN_PARTS = ("head", "torso")  # need no entry in the material: they use its own temperature
_WALK = "walk"  # the posture of all that have legs
_STANDING = ("material", "form", "variants", "height_m", "crown_diameter_m")
_FOLIAGE = ("crown_thickness_m", "trunk_radius_m", "clumps", "leaves", "leaf_m")
_FORM_KEYS = {
    "umbrella": (*_FOLIAGE, "limbs"),
    "many_stemmed": (*_FOLIAGE, "limbs"),
    "bush": _FOLIAGE,
    "bottle": ("trunk_radius_m", "trunk_height_m", "limbs"),
    "tussock": ("trunk_radius_m", "leaves", "leaf_m"),
    "mound": (),
    "rock": ("limbs",),
    "log": ("trunk_radius_m", "limbs"),
}


def is_named(name: str, patterns: Iterable[str]) -> bool:
    """Whether one of the patterns, which may have a *, such as "stand*", is the name."""
    return any(fnmatchcase(name, pattern) for pattern in patterns)


def check(where: str, kind: str, data: dict) -> None:
    """Raise ConfigError if what the file `where`, an asset of the given kind, states does not go together."""
    if kind == "species" and "model" in data:
        _check_rigid(where, data)
    elif kind == "species":
        _check_drawn(where, data)
    elif "shapes" in data:
        _check_keys(where, data, ("materials",))
        for k, shape in enumerate(data["shapes"]):
            check_known(shape["part"], data["materials"], f"{where}: shapes[{k}].part", "a key of materials")
    elif kind == "plants" and "model" in data:
        _check_keys(where, data, ("material",))
    elif kind == "plants":
        _check_keys(where, data, _STANDING)
        _check_keys(where, data, _FORM_KEYS[data["form"]])


def check_parts(where: str, data: dict, parts: Collection[str]) -> None:
    """Raise ConfigError if a drawn species has a part for which its material, with `parts`, has no temperature."""
    for name, bone in data.get("bones", {}).items():
        for k, shape in enumerate(bone["shapes"]):
            place = f"{where}: bones.{name}.shapes[{k}]"
            check_known(shape["part"], {*parts, *_PLAIN_PARTS}, f"{place}.part", "a part")
            for j, patch in enumerate(shape.get("patches", [])):
                check_known(patch["part"], {*parts, *_PLAIN_PARTS}, f"{place}.patches[{j}].part", "a part")


def _check_keys(where: str, data: dict, keys: Iterable[str]) -> None:
    for key in keys:
        if key not in data:
            raise ConfigError(f"{where}: {key} is missing; expected a value")


def _check_rigid(where: str, data: dict) -> None:
    for key in ("bones", "legs", "wheels", "moves"):
        if key in data:
            raise ConfigError(f"{where}: {key} is given; expected none, since a model from a file is rigid")


def _check_drawn(where: str, data: dict) -> None:
    _check_keys(where, data, ("gait", "bones"))
    for place, name in _bones_named(data):
        check_known(
            name.removesuffix(".left").removesuffix(".right"), data["bones"], f"{where}: {place}", "a bone"
        )
    known = [*data["variants"], _WALK, *data.get("postures", {})]
    for place, pattern in _patterns(data):
        if not any(is_named(name, [pattern]) for name in known):
            check_known(pattern, known, f"{where}: {place}", "variants or postures")


def _bones_named(data: dict) -> Iterator[tuple[str, str]]:
    """Every position in a species file that names a bone, with the name."""
    for name, bone in data["bones"].items():
        yield from ((f"bones.{name}.parent", bone[key]) for key in ("parent",) if key in bone)
    for k, leg in enumerate(data.get("legs", [])):
        yield from ((f"legs[{k}].bones[{j}]", name) for j, name in enumerate(leg["bones"]))
    for kind in ("wheels", "moves"):
        yield from ((f"{kind}[{k}].bone", entry["bone"]) for k, entry in enumerate(data.get(kind, [])))
    for kind in ("variants", "postures"):
        for name, entry in data.get(kind, {}).items():
            for key in ("turn_deg", "holds_deg", "stretch"):
                yield from ((f"{kind}.{name}.{key}", bone) for bone in entry.get(key, {}))


def _patterns(data: dict) -> Iterator[tuple[str, str]]:
    """Every position in a species file that names variants or postures, with the pattern."""
    entries = {f"moves[{k}]": move for k, move in enumerate(data.get("moves", []))}
    for name, bone in data["bones"].items():
        shapes = {f"bones.{name}.shapes[{k}]": shape for k, shape in enumerate(bone["shapes"])}
        entries |= {f"bones.{name}": bone, **shapes}
    for place, entry in entries.items():
        yield from ((f"{place}.only[{k}]", pattern) for k, pattern in enumerate(entry.get("only", [])))
