"""Reads a dataset config and fills in the defaults its schema states.

Types and ranges are checked by the `veldt` command against the same schema; what the values mean together is
checked in `checks`.
"""

from __future__ import annotations

import copy
import json
from pathlib import Path

from .faults import ConfigError

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = ROOT / "configs" / "schema" / "config.schema.json"


def load(path: Path) -> dict:
    """The config at `path` with every default filled in; ConfigError if it cannot be read as JSON."""
    try:
        config = json.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise ConfigError(f"config = {path}; expected a readable file ({error.strerror})") from error
    except ValueError as error:
        raise ConfigError(f"config = {path}; expected JSON ({error})") from error
    return resolve(config)


def resolve(config: dict) -> dict:
    """A copy of `config` with every default of the schema filled in."""
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    return with_defaults(schema, config)


def with_defaults(schema: dict, value):
    """A copy of `value` in which each missing key that has a default in `schema` is present, at every depth."""
    if isinstance(value, list):
        return [with_defaults(schema.get("items", {}), item) for item in value]
    if not isinstance(value, dict):
        return value
    properties = schema.get("properties", {})
    others = schema.get("additionalProperties")
    others = others if isinstance(others, dict) else {}
    missing = {
        key: copy.deepcopy(rule["default"])
        for key, rule in properties.items()
        if "default" in rule and key not in value
    }
    return {
        key: with_defaults(properties.get(key, others), item) for key, item in {**value, **missing}.items()
    }
