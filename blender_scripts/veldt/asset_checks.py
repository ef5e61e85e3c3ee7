"""Checks of species, plant and material files; faults name the file and the key."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator
from fnmatch import fnmatchcase

from .faults import ConfigError, check_known, did_you_mean, listing

# By kind: required keys and their types. `veldt` checks materials against their schema.
_TEXT, _NUMBER, _PAIR, _TABLE, _LIST, _COUNT, _POINT = (
    "text",
    "a number",
    "[least, most]",
    "an object",
    "a list",
    "a whole number from 1",
    "[x, y, z]",
)
_KEYS = {
    "species": {
        "category": _TEXT,
        "material": _TEXT,
        "source": _TABLE,
        "speed_m_s": _NUMBER,
        "variants": _TABLE,
    },
    "plants": {
        "source": _TABLE,
        "scale_range": _PAIR,
        "cover_m2": _NUMBER,
        "foot_m": _NUMBER,
        "spacing_m": _NUMBER,
        "clearance_m": _NUMBER,
        "patch_m": _NUMBER,
        "slope_deg": _PAIR,
    },
    "structures": {"source": _TABLE, "cover_m2": _NUMBER, "foot_m": _NUMBER, "clearance_m": _NUMBER},
    "sites": {"source": _TABLE, "radius_m": _NUMBER, "objects": _LIST},
    "materials": {"emissivity": _NUMBER, "winter_k": _NUMBER, "summer_k": _NUMBER, "source": _TEXT},
}
_PLAIN_PARTS = ("head", "torso")  # need no entry in the material: they use its own temperature
_WALK = "walk"  # the posture of all species with legs
_DRAWN = {"gait": _TABLE, "bones": _TABLE}
_PATCH = {"part": _TEXT, "from_m": _POINT, "to_m": _POINT}
_STANDING = {"form": _TEXT, "variants": _COUNT, "height_m": _NUMBER, "crown_diameter_m": _NUMBER}
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


def _is_number(value) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


_IS: dict[str, Callable] = {
    _TEXT: lambda value: isinstance(value, str) and value != "",
    _NUMBER: lambda value: _is_number(value) and value >= 0,
    _PAIR: lambda value: isinstance(value, list) and len(value) == 2 and all(map(_is_number, value)),
    _TABLE: lambda value: isinstance(value, dict) and len(value) > 0,
    _LIST: lambda value: isinstance(value, list) and len(value) > 0,
    _COUNT: lambda value: isinstance(value, int) and value >= 1,
    _POINT: lambda value: isinstance(value, list) and len(value) == 3 and all(map(_is_number, value)),
}


def is_named(name: str, patterns: Iterable[str]) -> bool:
    """Whether a name matches one of the patterns, which may have a *, such as "stand*"."""
    return any(fnmatchcase(name, pattern) for pattern in patterns)


def check(where: str, kind: str, data: dict) -> None:
    """Raise ConfigError if the content of the file `where`, an asset of the given kind, lacks something."""
    _check_keys(f"{where}: ", data, _KEYS.get(kind, {}))
    if kind == "species":
        _check_species(where, data)
    elif kind == "structures" or "shapes" in data:
        _check_shapes(where, data)
    elif kind == "plants":
        _check_keys(f"{where}: ", data, {"material": _TEXT})
        if "model" not in data:
            _check_form(where, data)


def check_parts(where: str, data: dict, parts: Collection[str]) -> None:
    """Raise ConfigError if a drawn species has a part for which its material, with `parts`, has no temperature."""
    for name, bone in data.get("bones", {}).items():
        for k, shape in enumerate(bone["shapes"]):
            place = f"{where}: bones.{name}.shapes[{k}]"
            check_known(shape["part"], {*parts, *_PLAIN_PARTS}, f"{place}.part", "a part")
            for j, patch in enumerate(shape.get("patches", [])):
                check_known(patch["part"], {*parts, *_PLAIN_PARTS}, f"{place}.patches[{j}].part", "a part")


def _check_keys(where: str, data: dict, keys: dict[str, str]) -> None:
    for key, rule in keys.items():
        if key not in data:
            raise ConfigError(f"{where}{key} is missing; expected {rule}")
        if not _IS[rule](data[key]):
            raise ConfigError(f"{where}{key} = {data[key]}; expected {rule}")


def _check_species(where: str, data: dict) -> None:
    _check_keys(f"{where}: ", data, {"wet_s": _PAIR} if "wet_s" in data else {})
    for name, variant in data["variants"].items():
        _check_object(f"{where}: variants.{name}", variant, {"share": _NUMBER, "size_range": _PAIR})
    if "model" in data:
        for key in ("bones", "legs", "wheels", "moves"):
            if key in data:
                raise ConfigError(
                    f"{where}: {key} is given; expected none, since a model from a file is rigid"
                )
        return
    _check_keys(f"{where}: ", data, _DRAWN)
    _check_object(f"{where}: gait", data["gait"], {"leg_m": _NUMBER})
    for name, bone in data["bones"].items():
        if not isinstance(bone, dict) or not isinstance(bone.get("shapes"), list) or "joint_m" not in bone:
            raise ConfigError(f"{where}: bones.{name}; expected joint_m and a list of shapes")
        for k, shape in enumerate(bone["shapes"]):
            _check_object(f"{where}: bones.{name}.shapes[{k}]", shape, {"part": _TEXT})
            for j, patch in enumerate(shape.get("patches", [])):
                _check_object(f"{where}: bones.{name}.shapes[{k}].patches[{j}]", patch, _PATCH)
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


def _check_object(where: str, data, keys: dict[str, str]) -> None:
    if not isinstance(data, dict):
        raise ConfigError(f"{where} = {data}; expected an object with {listing(keys)}")
    _check_keys(f"{where}.", data, keys)


def _check_shapes(where: str, data: dict) -> None:
    _check_keys(f"{where}: ", data, {"materials": _TABLE, "shapes": _LIST})
    for part, slot in data["materials"].items():
        if not (
            _IS[_TEXT](slot) or (isinstance(slot, list) and len(slot) == 2 and all(map(_IS[_TEXT], slot)))
        ):
            raise ConfigError(
                f"{where}: materials.{part} = {slot}; expected a material, or [material, part of it]"
            )
    for k, shape in enumerate(data["shapes"]):
        _check_object(f"{where}: shapes[{k}]", shape, {"part": _TEXT})
        check_known(shape["part"], data["materials"], f"{where}: shapes[{k}].part", "a key of materials")


def _check_form(where: str, data: dict) -> None:
    _check_keys(f"{where}: ", data, _STANDING)
    form = data["form"]
    if form not in _FORM_KEYS:
        near = did_you_mean(form, _FORM_KEYS)
        raise ConfigError(f'{where}: form = "{form}"; expected one of {listing(_FORM_KEYS)}{near}')
    _check_keys(f"{where}: ", data, dict.fromkeys(_FORM_KEYS[form], _NUMBER))
