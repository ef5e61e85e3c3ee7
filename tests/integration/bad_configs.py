"""Invalid configs and lists of variants."""

# Messages are whole, however long.
# pylint: disable=line-too-long

from __future__ import annotations

import json
from pathlib import Path

from bad_input import NOTHING, BadInput


def _config(name: str, content, message: str, option: str = "--config") -> BadInput:
    """A file of JSON, text or bytes, or a function that makes it at a path."""

    def spoil(folder: Path) -> None:
        file = folder.parent / "asked.json"
        if callable(content):
            content(file)
        else:
            file.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())

    return BadInput(option[2:], name, spoil, 2, message, NOTHING, (option, "asked.json"))


CONFIGS = [
    _config("missing", lambda file: None, "cannot read asked.json: No such file or directory"),
    _config("a folder", lambda file: file.mkdir(), "cannot read asked.json: Is a directory"),
    _config(
        "not JSON",
        b"seed = 5",
        "asked.json:1:1: not JSON: syntax error while parsing value - invalid literal; last read: 's'",
    ),
    _config(
        "100,000 brackets",
        b"[" * 100_000,
        "asked.json: lists and objects are nested more than 64 deep; expected fewer",
    ),
    _config(
        "not UTF-8",
        b'{"name": "\xff"}',
        "asked.json:1:11: not JSON: syntax error while parsing value - invalid string: ill-formed UTF-8 byte; last read: '\"\\xff'",
    ),
    _config("a list", [], "asked.json: document = a list of 0; expected an object"),
    _config(
        "a clip named ../x",
        {"name": "x", "clips": [{"id": "../x", "season": "winter", "frames": 3}]},
        'asked.json: clips[0].id = "../x"; expected 1 to 200 letters, digits, _ or -, not beginning with -',
    ),
    _config(
        "not JSON",
        b"variants",
        "asked.json:1:1: not JSON: syntax error while parsing value - invalid literal; last read: 'v'",
        "--variants",
    ),
    _config(
        "a variant named ../x",
        {"variants": [{"name": "../x"}]},
        'asked.json: variants[0].name = "../x"; expected 1 to 200 letters, digits, _ or -, not beginning with -',
        "--variants",
    ),
    _config(
        "a variant twice",
        {"variants": [{"name": "x"}, {"name": "x"}]},
        'asked.json: variants[1].name = "x"; expected each name once',
        "--variants",
    ),
]
