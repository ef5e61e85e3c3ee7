"""Location of the files that come with Veldt: materials, sensors, schemas."""

from __future__ import annotations

import os
from pathlib import Path


def home() -> str:
    """$VELDT_HOME, or the files of the package."""
    return os.environ.get("VELDT_HOME") or str(Path(__file__).parent / "share")
