"""`doctor` reports what is installed, and how to install what is missing."""

import os
import re

PARTS = [
    "veldt",
    "assets and scripts",
    "cores",
    "Blender",
    "Embree",
    "Python",
    "OpenEXR",
    "OpenImageIO",
    "OpenCV",
    "ISA-L",
    "FFmpeg",
    "oneTBB",
    "OpenSSL",
]
VERSION = re.compile(r"\d+\.\d+")


def _cores(veldt, **how):
    report = veldt("doctor", "--json", **how).json()
    return next(finding["found"] for finding in report if finding["what"] == "cores")


def test_everything_it_needs_has_a_version(veldt):
    """Blender may be missing where the tests run; everything else is linked in, or runs them."""
    report = {finding["what"]: finding for finding in veldt("doctor", "--json").json()}
    assert list(report)[: len(PARTS)] == PARTS
    for what in set(report) - {"Blender", "assets and scripts", "cores"}:
        assert VERSION.search(report[what]["found"]), what
    assert report["Python"]["found"].endswith("python3") and "with NumPy" in report["Python"]["found"]


def test_what_is_missing_is_said_with_its_remedy(veldt):
    done = veldt("doctor", env={"PATH": ""})
    assert (done.code, done.err) == (0, "")  # the engine embree is enough
    missing = [line for line in done.out.splitlines() if "missing" in line]
    assert missing == [
        "Blender              missing, needed for the engine blender, 3D models of your own, render --preview and "
        "bench --suite render: apt-get install blender, or name one with --blender PATH",
    ]


def test_a_blender_that_does_not_start_counts_as_missing(veldt):
    veldt.write("blender", "#!/bin/sh\nexit 1\n").chmod(0o755)
    done = veldt("doctor", "--json", env={"PATH": str(veldt.folder)})
    assert done.code == 0
    (missing,) = [finding for finding in done.json() if not finding["found"]]
    assert missing["what"] == "Blender" and missing["needed_for"].startswith("the engine blender, ")


def test_a_blender_is_named_with_its_version_and_place(veldt):
    veldt.write("blender", "#!/bin/sh\necho Blender 9.8.7\necho built today\n").chmod(0o755)
    done = veldt("doctor", env={"PATH": str(veldt.folder)})
    assert f"Blender              Blender 9.8.7, {veldt.folder}/blender\n" in done.out
    assert (done.code, done.err) == (0, "")


def test_cores_are_those_that_affinity_allows(veldt):
    allowed = os.sched_getaffinity(0)
    assert re.match(rf"\d+ usable of {os.cpu_count()}\b", _cores(veldt))
    found = _cores(veldt, under=("taskset", "-c", str(min(allowed))))
    reason = "" if os.cpu_count() == 1 else ": CPU affinity allows 1"
    assert found == f"1 usable of {os.cpu_count()}{reason}"


def test_what_everything_needs_is_required(veldt):
    done = veldt("doctor", "--json", env={"VELDT_PYTHON": "/nowhere/python3"})
    assert done.code == 1
    (missing,) = [finding for finding in done.json() if not finding["found"]]
    assert (missing["what"], missing["needed_for"]) == ("Python", "")


def test_embree_is_named_with_its_version_and_instructions(veldt):
    assert re.search(r"^Embree {15}[34]\.\d+\.\d+, (4|8|16) rays at once$", veldt("doctor").out, re.MULTILINE)


def test_a_home_that_is_none_is_said(veldt):
    done = veldt("doctor", env={"VELDT_HOME": "/proc"})
    assert done.code == 1
    assert 'missing: VELDT_HOME = "/proc"; expected a folder with assets and blender_scripts' in done.out
