"""Read a dataset config and fill in the defaults stated in its schema.

The `veldt` command checks types and ranges against the same schema; `checks` checks values against each other.
"""

from __future__ import annotations

import copy
import json
import sys
from pathlib import Path

from .faults import ConfigError

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = ROOT / "configs" / "schema" / "config.schema.json"
SENSORS = ROOT / "assets" / "sensors"
MAPS = ("heightmap", "density_map")  # of scene.terrain, each with a file


def load(path: Path) -> dict:
    """The config at `path`, or on standard input for "-", with every default filled in.

    ConfigError if it cannot be read as JSON.
    """
    try:
        content = sys.stdin.buffer.read() if str(path) == "-" else Path(path).read_bytes()
        config = json.loads(content)
    except OSError as error:
        raise ConfigError(f"config = {path}; expected a readable file ({error.strerror})") from error
    except ValueError as error:
        raise ConfigError(f"config = {path}; expected JSON ({error})") from error
    return _with_whole_paths(resolve(config), Path(path).resolve().parent)


def _with_whole_paths(config: dict, folder: Path) -> dict:
    """The config, with files that it names relative to its own folder named in full."""
    terrain = config["scene"]["terrain"]
    plans = [entry["flight"] for entry in (*config["clips"], *config["flights"]) if "flight" in entry]
    for given in (*(terrain.get(name) for name in MAPS), *(plan.get("waypoints") for plan in plans)):
        if given is not None:
            given["file"] = str(folder / given["file"])
    return config


def resolve(config: dict) -> dict:
    """A copy of `config` with every default filled in: its camera preset's, then the schema's."""
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    name = config.get("sensor", {}).get(
        "preset", schema["properties"]["sensor"]["properties"]["preset"]["default"]
    )
    try:
        preset = json.loads((SENSORS / f"{name}.json").read_text(encoding="utf-8"))
    except OSError as error:
        raise ConfigError(f'sensor.preset = "{name}"; expected a file of {SENSORS}') from error
    given = merged({key: preset.get(key, {}) for key in ("camera", "sensor")}, config)
    return with_defaults(schema, given, schema["$defs"])


def merged(below: dict, above: dict) -> dict:
    """`below` with everything that `above` has instead, objects key by key."""
    both = {
        key: merged(below[key], above[key])
        for key in below.keys() & above.keys()
        if _are_dicts(below[key], above[key])
    }
    return {**below, **above, **both}


def _are_dicts(*values) -> bool:
    return all(isinstance(value, dict) for value in values)


def with_defaults(schema: dict, value, definitions: dict):
    """A copy of `value` in which each missing key that has a default in `schema` is present, at every depth.

    definitions: what schemas refer to as "#/$defs/NAME".
    """
    if "$ref" in schema:
        schema = definitions[schema["$ref"].rsplit("/", 1)[-1]]
    if isinstance(value, list):
        return [with_defaults(schema.get("items", {}), item, definitions) for item in value]
    if not isinstance(value, dict):
        return value
    properties = schema.get("properties", {})
    others = schema.get("additionalProperties")
    others = others if isinstance(others, dict) else {}
    whole = {**_defaults(properties), **_preset_values(properties, value), **value}
    return {key: with_defaults(properties.get(key, others), item, definitions) for key, item in whole.items()}


def _defaults(properties: dict) -> dict:
    return {key: copy.deepcopy(rule["default"]) for key, rule in properties.items() if "default" in rule}


def _preset_values(properties: dict, value: dict) -> dict:
    """What keys of `value` stand for that are presets of several others."""
    presets = (
        rule["presets"].get(value.get(key), {}) for key, rule in properties.items() if "presets" in rule
    )
    return {key: chosen for preset in presets for key, chosen in preset.items()}
