"""Tells whole PNG files from broken ones: a write that a full disk cut short lacks the end (PNG, ISO/IEC 15948)."""

from __future__ import annotations

from pathlib import Path

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_END = b"\0\0\0\0IEND\xae\x42\x60\x82"


def is_whole(path: Path) -> bool:
    """Whether the file begins and ends as a PNG file does."""
    try:
        content = path.read_bytes()
    except OSError:
        return False
    return content.startswith(_SIGNATURE) and content.endswith(_END)
