"""The ten slowest tests of a run, and its processor time against the budget in tests/README.md.

Processors differ, so the budget is a multiple of a reference: work that never changes, done on all cores here and now.
With VELDT_HOLD_BUDGET=1, a run that takes more than 25 % above the budget fails.
"""

from __future__ import annotations

import hashlib
import os
import re
import resource
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[2]
TOLERANCE = 1.25


def slowest(folder: Path, count: int = 10) -> list[tuple[float, str]]:
    """Seconds and names of tests. What has a file of its own, one run of pytest, counts test by test."""
    groups = {file.stem for file in folder.glob("*.xml")}
    found = []
    for file in folder.glob("*.xml"):
        for case in ElementTree.parse(file).iter("testcase"):
            name = case.get("name", "")
            if name not in groups:
                place = "" if file.stem == "ctest" else case.get("classname", "").rpartition(".")[2] + ": "
                found.append((float(case.get("time", 0)), place + name))
    return sorted(found, reverse=True)[:count]


def budget() -> float:
    """Processor time of `./run test` in multiples of the reference."""
    text = (ROOT / "tests" / "README.md").read_text(encoding="utf-8")
    return float(re.search(r"budget of `./run test` is \*\*(\d+)\*\*", text)[1])


def work() -> None:
    """The reference: Python's loop, and bytes in and out of the cache."""
    total = sum(k * k % 7 for k in range(12_000_000))
    block = total.to_bytes(8, "little") * 4096
    for _ in range(5000):
        block = hashlib.sha256(block).digest() + block[32:]


def reference_s() -> float:
    """Processor time of the reference, with all cores at it."""
    cores = len(os.sched_getaffinity(0))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    running = [subprocess.Popen([sys.executable, "-B", __file__]) for _ in range(cores)]
    assert not any(one.wait() for one in running)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime) / cores


def report(folder: Path, taken_s: float) -> bool:
    """Print what a run took; whether that is within the budget, or does not matter."""
    print("\nthe ten slowest tests [s]:")
    for seconds, name in slowest(folder):
        print(f"{seconds:8.1f}  {name}")
    reference, allowed = reference_s(), budget()
    used = taken_s / reference
    print(
        f"processor time: {taken_s:.0f} s, {used:.0f} times the reference of {reference:.2f} s on this machine;"
        f" the budget is {allowed:.0f}"
    )
    return os.environ.get("VELDT_HOLD_BUDGET") != "1" or used <= TOLERANCE * allowed


if __name__ == "__main__":
    work()
