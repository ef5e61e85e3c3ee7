"""A short night of faults, with a fixed seed."""

import subprocess
import sys
from pathlib import Path

_NIGHT = Path(__file__).with_name("night.py")


def test_a_short_night(tmp_path):
    arguments = ["--seed", "3", "--rounds", "30", "--hours", "0.02", "--folder", tmp_path / "night"]
    arguments += ["--scenes", "generate,planned with scratch"]
    done = subprocess.run(
        [sys.executable, "-B", _NIGHT, *arguments], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, ""), done
