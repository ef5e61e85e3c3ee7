"""Runs what `run` has made ready: `test`, the checks of `./run test`, and those of `test-blender` and `loaders`.

    python3 tests/run_tests.py test [--all|--nightly|PATTERN]
    python3 tests/run_tests.py test-blender VERSION_OR_PATH
    python3 tests/run_tests.py loaders DATASET
"""

from __future__ import annotations

import os
import re
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path
from threading import Thread

ROOT = Path.cwd()
sys.path[:0] = [str(ROOT / "tests" / "support"), str(ROOT / "cli" / "docs")]

# pylint: disable=wrong-import-position
from build_docs import check_docs
from checks import CORES, Checks, build, fail, install_python, ran, timed
from test_times import report

# Versions of the Python module bpy that `./run test --nightly` runs Blender's tests with.
BPY_VERSIONS = ("4.2.23", "4.5.15", "5.0.1")
PACKAGE = ("build/python", "tests/python/requirements.txt")
PEERS = ("build/peers", "tests/peers/requirements.txt")
ON_ALL_CORES = ("--numprocesses", CORES, "--dist", "loadfile")


def ctest(preset: str, *arguments: str) -> bool:
    """Run tests of a build. ctest and pytest write the seconds of each test into its folder Testing."""
    folder = ROOT / "build" / preset / "Testing"
    shutil.rmtree(folder, ignore_errors=True)
    written = ("--output-junit", folder / "ctest.xml")
    return ran("ctest", "--preset", preset, "--parallel", CORES, *written, *arguments)


def pytest(*arguments: object, **how) -> bool:
    """Run Python tests."""
    return ran(sys.executable, "-m", "pytest", *arguments, **how)


def pytest_of(folder: str, *arguments: object, **how) -> bool:
    """Run Python tests in an environment of `install_python`."""
    return ran(f"{folder}/bin/python", "-m", "pytest", *arguments, **how)


def pip_of(folder: str, *arguments: str) -> bool:
    """Run pip there."""
    return ran(f"{folder}/bin/python", "-m", "pip", *arguments)


def package_tests(**variables: str) -> bool:
    """Tests of the Python package."""
    options = ("--config-file", "tests/python/pytest.ini", "tests/python")
    return pytest_of(PACKAGE[0], *ON_ALL_CORES, *options, env=os.environ | variables)


def wheel() -> bool:
    """The Python package as users get it: a wheel, in an environment of its own. Without isolation, pip leaves the
    release build as it is, where most of the module is built already."""
    wheels = Path("build/wheels")
    shutil.rmtree(wheels, ignore_errors=True)
    options = ("--quiet", "--no-deps", "--no-build-isolation", "--wheel-dir", str(wheels))
    with timed("build"):
        if not pip_of(PACKAGE[0], "wheel", ".", *options, "--config-settings", "build-dir=build/release"):
            return False
    made = map(str, wheels.glob("veldt-*.whl"))
    return pip_of(PACKAGE[0], "install", "--quiet", "--force-reinstall", *made) and package_tests()


def package_memory() -> bool:
    """The same tests with AddressSanitizer in the package's module. Its runtime must be loaded before Python."""
    shutil.copytree("thermal_core/python/veldt", "build/asan/python/veldt", dirs_exist_ok=True)
    names = ("libasan.so", "libstdc++.so")  # the compiler prints one at a time
    found = [
        subprocess.check_output(["c++", f"-print-file-name={name}"], text=True).strip() for name in names
    ]
    return package_tests(
        LD_PRELOAD=" ".join(found),
        ASAN_OPTIONS="detect_leaks=0:intercept_tls_get_addr=0",
        PYTHONPATH=str(ROOT / "build/asan/python"),
        VELDT_HOME=str(ROOT),
    )


def installed_bpy(version: str) -> str:
    """The module in an environment of its own, with a program beside it that takes Blender's command line."""
    folder = ROOT / "build" / f"bpy-{version}"
    program = folder / "blender"
    if not program.exists():
        print(f"Installing bpy {version} into {folder.relative_to(ROOT)}")
        if not (
            ran(sys.executable, "-m", "venv", folder)
            and pip_of(str(folder), "install", "--quiet", f"bpy=={version}")
        ):
            shutil.rmtree(folder, ignore_errors=True)
            fail(1, f"bpy {version} could not be installed; pip's messages are above, and no test was run")
    command = f'exec "{folder}/bin/python" -B "{ROOT}/tests/support/bpy_blender.py" "$@"'
    program.write_text(f"#!/bin/sh\n{command}\n", encoding="utf-8")
    program.chmod(0o755)
    return str(program)


class Tests(Checks):
    """The checks of `run`'s commands."""

    def daily(self) -> None:
        """What a change should pass before it is committed. Prints the slowest tests, so that it stays fast."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.check("tests", ctest, "release", "--label-regex", "^daily$")
        planner = ("--junitxml", "build/release/Testing/planner.xml", "-m", "not blender", "tests/blender")
        self.check("tests of the planner", pytest, *ON_ALL_CORES, *planner)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        taken_s = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
        if not report(Path("build/release/Testing"), taken_s):
            self.failed.append("tests take more processor time than their budget")

    def rest(self) -> None:
        """What `./run test --all` adds."""
        self.check("the rest of the tests", ctest, "release", "--label-regex", "^all$")
        self.check("Blender's tests", pytest, *ON_ALL_CORES, "-m", "blender", "tests/blender")
        installing = Thread(target=install_python, args=PACKAGE)
        installing.start()
        build("asan", "all", "VELDT_PYTHON=ON")
        self.check("tests with sanitizers", ctest, "asan", "--label-exclude", "^nightly$")
        build("tsan", "threads")
        installing.join()
        self.check("threads with ThreadSanitizer", ctest, "tsan", "--label-exclude", "^nightly$")
        if self.installed("tests/peers", *PEERS):
            self.check("other programs read our exports", pytest_of, PEERS[0], "tests/peers")
        if self.installed("tests/python", *PACKAGE):
            self.check("the Python package", wheel)
            self.check("the Python package with AddressSanitizer", package_memory)
        check_docs(self)

    def installed(self, tests: str, folder: str, requirements: str) -> bool:
        """Install what tests need; if that fails, the summary says so."""
        with timed("packages"):
            done = install_python(folder, requirements)
        if not done:
            self.skipped.append(
                f"{tests}: the Python packages they need could not be installed; pip's messages are above"
            )
        return done

    def night(self) -> None:
        """What `./run test --nightly` adds."""
        self.check("benches, clusters and CI", ctest, "release", "--label-regex", "^nightly$")
        self.check("the rest of the tests with sanitizers", ctest, "asan", "--label-regex", "^nightly$")
        build("tsan", "all")
        self.check("commands with ThreadSanitizer", ctest, "tsan", "--label-regex", "^nightly$")
        faults = ("--hours", 1, "--seed", time.strftime("%j"), "--log", "build/night.jsonl")
        self.check("an hour of faults", ran, sys.executable, "tests/faults/night.py", *faults)
        for version in BPY_VERSIONS:
            self.blender(installed_bpy(version))

    def blender(self, program: str) -> None:
        """Tests that need Blender, with another one."""
        with_it = os.environ | {"BLENDER": program}
        self.check(f"Blender tests with {program}", pytest, "tests/blender", env=with_it)
        self.check(f"integration tests with {program}", pytest, "tests/integration", env=with_it)

    def matching(self, pattern: str) -> None:
        """Test programs, and files of Python tests, by their names."""
        folders = ("cli", "integration", "blender", "cluster", "faults")
        found = (file for folder in folders for file in Path("tests", folder).rglob("test_*.py"))
        files = sorted(file for file in found if re.search(pattern, file.name))
        options = ("--label-exclude", "^pytest$", "--no-tests=ignore")
        command = ("ctest", "--preset", "release", "--parallel", CORES, "--tests-regex", pattern)
        self.check("test programs", ran, *command, *options)
        if files:
            self.check("Python tests", pytest, *ON_ALL_CORES, *files)

    def test(self, which: str = "") -> None:
        """`./run test`."""
        if which and not which.startswith("-"):
            self.matching(which)
        else:
            self.daily()
            if which:
                self.rest()
            if which == "--nightly":
                self.night()
        self.conclude("test")

    def test_blender(self, which: str) -> None:
        """`./run test-blender`."""
        program = which if "/" in which else installed_bpy(which)
        if not ran(program, "--version"):
            fail(1, f"{program} cannot be run; no test was run")
        build("release", "veldt")
        self.blender(program)
        self.conclude(f"test with {which}")

    def loaders(self, dataset: str) -> None:
        """`./run loaders`. Too large for tests: PyTorch from the Python package index brings CUDA."""
        folder = "build/loaders"
        if not install_python(folder, "tests/loaders/requirements.txt"):
            fail(1, "loaders: the Python packages could not be installed")
        if not pip_of(folder, "install", "--quiet", "--force-reinstall", "--no-deps", "."):
            sys.exit(1)
        for script in sorted(Path("tests/loaders").glob("*_check.py")):
            self.check(str(script), ran, f"{folder}/bin/python", script, dataset)
        self.conclude("loaders")


if __name__ == "__main__":
    getattr(Tests(), sys.argv[1].replace("-", "_"))(*sys.argv[2:])
