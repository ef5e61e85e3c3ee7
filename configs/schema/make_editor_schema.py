"""Write editor.schema.json, which editors and validators use for configs as people write them; each build does it.

config.schema.json describes resolved configs, which hold values alone. In a config as written, most values may be
distributions, and sections of clips and flights hold only what differs. This derives the one from the other.
"""

from __future__ import annotations

import json
from pathlib import Path

_HERE = Path(__file__).resolve().parent
_SECTIONS = ("camera", "sensor", "weather", "terms", "labels", "output")
_FIXED = ("id", "count", "drawn", "of_flight")  # keys of clips and flights
_KEPT_OUTSIDE = ("description", "default")
_DISTRIBUTION = {"$ref": "#/$defs/distribution"}
_PAIR = {"type": "array", "minItems": 2, "maxItems": 2}
_DEFINITION = {
    "description": "A value drawn for each clip; in scene, once for the dataset.",
    "oneOf": [
        {"$ref": "#/$defs/uniform"},
        {"$ref": "#/$defs/normal"},
        {"$ref": "#/$defs/choice"},
    ],
}
_KINDS = {
    "uniform": {
        "type": "object",
        "additionalProperties": False,
        "required": ["uniform"],
        "properties": {
            "uniform": {
                **_PAIR,
                "items": {"type": ["number", "string"]},
                "description": "Lowest and highest, both included; of times and dates, first and last.",
            }
        },
    },
    "normal": {
        "type": "object",
        "additionalProperties": False,
        "required": ["normal"],
        "properties": {
            "normal": {
                **_PAIR,
                "items": {"type": "number"},
                "description": "Mean and standard deviation; drawn again until the key's range has the value."
                " Refused if fewer than one in a hundred would be in it.",
            }
        },
    },
    "choice": {
        "type": "object",
        "additionalProperties": False,
        "required": ["choice"],
        "properties": {
            "choice": {
                "type": "array",
                "minItems": 1,
                "description": "Values, null for none, or distributions.",
            },
            "weights": {"type": "array", "minItems": 1, "items": {"type": "number", "minimum": 0}},
        },
    },
}


def editor_schema(resolved: dict) -> dict:
    """The schema of configs as written, from that of resolved ones."""
    schema = json.loads(json.dumps(resolved))
    keys, defs = schema["properties"], schema["$defs"]
    schema["title"] += ", as written"
    keys["scene"] = _inside(keys["scene"])
    for name in _SECTIONS:
        defs[name] = _drawable(keys[name], partial=True)
        keys[name] = {"$ref": f"#/$defs/{name}"}
    defs["flight"] = _drawable(defs["flight"])
    for kind in ("clips", "flights"):
        entry = keys[kind]["items"]["properties"]
        for name, rules in entry.items():
            if name in _SECTIONS:
                rules["$ref"] = f"#/$defs/{name}"
            elif name not in _FIXED and "$ref" not in rules:
                entry[name] = _drawable(rules)
    schema["$defs"] = defs | {"distribution": _DEFINITION} | _KINDS
    return schema


def _drawable(rules: dict, partial: bool = False) -> dict:
    """Rules of a value that may be a distribution; partial: also null, and without keys that are required."""
    outside = {key: rules[key] for key in _KEPT_OUTSIDE if key in rules}
    inside = _inside({key: value for key, value in rules.items() if key not in _KEPT_OUTSIDE}, partial)
    nothing = [{"type": "null"}] if partial else []
    return {**outside, "anyOf": [inside, _DISTRIBUTION, *nothing]}


def _inside(rules: dict, partial: bool = False) -> dict:
    """The same rules, with members that may be distributions."""
    found = {key: value for key, value in rules.items() if not (partial and key == "required")}
    if "properties" in found:
        found["properties"] = {k: _drawable(v, partial) for k, v in found["properties"].items()}
    if isinstance(found.get("additionalProperties"), dict):
        found["additionalProperties"] = _inside(found["additionalProperties"], partial)
    if "items" in found:
        found["items"] = _drawable(found["items"], partial)
    return found


if __name__ == "__main__":
    source = json.loads((_HERE / "config.schema.json").read_text(encoding="utf-8"))
    text = json.dumps(editor_schema(source), indent=1, ensure_ascii=False) + "\n"
    (_HERE / "editor.schema.json").write_text(text, encoding="utf-8")
