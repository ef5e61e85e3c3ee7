"""Fuzzes the readers of files, for `./run fuzz`; README.md of tests says how a fault is treated.

    python3 tests/fuzz/run_fuzzers.py [--fast] [SECONDS [TARGET…]]
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, "tests/support")

# pylint: disable=wrong-import-position
from checks import CORES, Checks, fail, from_run, install_python, ran

BUILD = Path("build/fuzz")
READERS_IN_PYTHON = ("log", "plan")
HEADER = Path("tests/fuzz/targets.h").read_text(encoding="utf-8")
TARGETS = sorted([*re.findall(r"^void (\w+)", HEADER, re.MULTILINE), *READERS_IN_PYTHON])

LIMITS = "-timeout=5 -rss_limit_mb=2048 -malloc_limit_mb=512".split()
SUMMARY = re.compile(r"^#(\d+).*DONE[^:]*cov: (\d+) .*corp: (\d+)", re.MULTILINE)
FAULT = re.compile(r"ERROR: |SUMMARY: |runtime error: |what\(\): |Uncaught Python")


class Fuzzing(Checks):
    """Fuzzers of one build."""

    def __init__(self, preset: str) -> None:
        super().__init__()
        self.preset = preset

    def program(self, target: str) -> list[str]:
        """The command that runs a target."""
        if target in READERS_IN_PYTHON:
            return ["build/fuzz_python/bin/python", "-B", "tests/fuzz/flight_files.py", target]
        return [f"build/{self.preset}/bin/fuzz_{target}"]

    def run(self, target: str, seconds: str, scratch: str) -> None:
        """Run a target. Inputs that reach new code stay in build/fuzz/corpus, where the next run starts."""
        corpus, found = BUILD / "corpus" / target, BUILD / "found" / target
        for folder in (corpus, found):
            folder.mkdir(parents=True, exist_ok=True)
        earlier = Path("tests/fuzz/found", target)
        inputs = [corpus, BUILD / "seeds" / target, *([earlier] if earlier.is_dir() else [])]
        files = (f"-dict={BUILD}/seeds/{target}.dict", f"-artifact_prefix={found}/")
        command = (*self.program(target), f"-max_total_time={seconds}", *LIMITS, *files, *inputs)
        with (BUILD / f"{target}.log").open("wb") as log:
            ran(*command, stdout=log, stderr=log, env=os.environ | {"TMPDIR": scratch})

    def runs(self, target: str) -> int | None:
        """Print how a target went, after a fault with the command that reproduces it; how often it ran without one."""
        log = (BUILD / f"{target}.log").read_text(encoding="utf-8", errors="replace")
        if done := SUMMARY.search(log):
            runs, edges, kept = map(int, done.groups())
            print(f"{target:14} {runs:11} runs, {edges:5} edges reached, {kept:5} inputs kept")
            return runs
        saved = re.findall(r"Test unit written to (.*)", log)[-1:] or ["(no input was saved)"]
        print(f"{target:14} A FAULT; {BUILD}/{target}.log has its trace. To reproduce it:")
        print(f"  {' '.join(self.program(target) + saved)}")
        print("".join(f"  {line}\n" for line in log.splitlines() if FAULT.search(line)), end="")
        return None

    def fuzz(self, seconds: str, targets: list[str]) -> bool:
        """One target a core. Scratch files are in memory where the system has a folder for that."""
        make_seeds = (sys.executable, "-B", "tests/fuzz/make_seeds.py", BUILD / "seeds")
        if not (ran(*from_run("build", self.preset, "fuzz")) and ran(*make_seeds)):
            return False
        if not install_python("build/fuzz_python", "tests/fuzz/requirements.txt", "--system-site-packages"):
            targets = [one for one in targets if one not in READERS_IN_PYTHON]
            left = " ".join(READERS_IN_PYTHON)
            self.skipped.append(f"fuzzing {left}: atheris could not be installed; pip's messages are above")
        memory = "/dev/shm" if Path("/dev/shm").is_dir() else None
        with tempfile.TemporaryDirectory(dir=memory) as scratch, ThreadPoolExecutor(CORES) as pool:
            list(pool.map(lambda target: self.run(target, seconds, scratch), targets))
        runs = [self.runs(target) for target in targets]
        print(f"{'all targets':14} {sum(one or 0 for one in runs):11} runs")
        return None not in runs


def main(arguments: list[str]) -> None:
    """Check the arguments, and fuzz."""
    is_fast = arguments[:1] == ["--fast"]
    seconds, *targets = arguments[is_fast:] or ["60"]
    if not re.fullmatch("[1-9][0-9]*", seconds):
        fail(2, f'fuzz = "{seconds}"; expected seconds, a whole number, then targets')
    for target in targets:
        if target not in TARGETS:
            fail(2, f'unknown target "{target}"; expected one of {" ".join(TARGETS)}')
    fuzzing = Fuzzing("fuzz_fast" if is_fast else "fuzz")
    fuzzing.check(f"fuzzing for {seconds} s each", fuzzing.fuzz, seconds, targets or TARGETS)
    fuzzing.conclude("fuzz")


if __name__ == "__main__":
    main(sys.argv[1:])
