"""A host program, or the user, may write numbers with a comma: every byte stays as it is."""

import hashlib
import json
import os
import struct
import subprocess
import sys

import pytest

import passes
from configs import tiny

# What a host program does that knows its user's language, and then works with Veldt.
HOST = """
import locale, sys
import numpy as np
import veldt
if sys.argv[1] == "comma":
    locale.setlocale(locale.LC_NUMERIC, "comma")
    assert locale.localeconv()["decimal_point"] == ","
plan, passes_folder = sys.argv[2:]
made = veldt.generate(plan_folder=plan, out="dataset")
assert made.complete
world = veldt.World(plan, "down")
captures = [world.capture(pose, time_s) for time_s, pose in zip(world.flight_s[:2], world.flight_poses)]
converter = veldt.Converter(passes_folder + "/manifest.json", settings=["sensor.preset=boson_640_14mm", "season=summer"])
plane = np.tile(np.array([1, 101, 102, 0], np.uint16), (16, 6))
frame = converter.convert(0, plane, depth_m=np.full(plane.shape, 41.3))
heat = veldt.HeatOfDay(weather={"wind_m_s": 1.3}).temperature_k("soil", [3.5, 13.25])
frames = [(one.ir8.tobytes(), one.ir16.tobytes(), one.labels) for one in (*captures, frame)]
labels = [label.values for clip in veldt.open_dataset("dataset") for one in clip for label in one.labels]
print(repr((frames, heat.tolist(), labels)))
"""


@pytest.fixture(name="comma", scope="module")
def _comma(tmp_path_factory) -> dict:
    """The environment of a program that writes 1,3: glibc's smallest locale, whose numbers alone differ from C's."""
    folder = tmp_path_factory.mktemp("locales")
    (folder / "comma").mkdir()
    texts = [b",\0", b".\0", b"\3\3\0\0", struct.pack("I", ord(",")), struct.pack("I", ord(".")), b"ASCII\0"]
    starts = [32 + sum(map(len, texts[:k])) for k in range(len(texts))]
    magic = 0x20031115 ^ 1  # of LC_NUMERIC
    content = struct.pack("8I", magic, len(texts), *starts) + b"".join(texts)
    (folder / "comma" / "LC_NUMERIC").write_bytes(content)
    (folder / "set.c").write_text(
        "#include <locale.h>\n#include <stdlib.h>\n"
        '__attribute__((constructor)) static void set(void) { if (!setlocale(LC_NUMERIC, "comma")) abort(); }\n',
        encoding="utf-8",
    )
    library = folder / "set.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, folder / "set.c"], check=True)
    loaded = os.environ.get("LD_PRELOAD", "").split()  # a sanitizer's runtime comes first
    return {"LOCPATH": str(folder), "LD_PRELOAD": " ".join([*loaded, str(library)])}


def _sums(folder) -> dict:
    """SHA-256 of each file but logs, by name."""
    files = (file for file in sorted(folder.rglob("*")) if file.is_file() and file.suffix != ".log")
    return {str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


@pytest.fixture(name="plan", scope="module")
def _plan(veldt):
    (veldt.folder / "tiny.json").write_text(json.dumps(tiny()), encoding="utf-8")
    done = veldt(
        "plan",
        "tiny.json",
        "--out",
        "locale_plan",
        "--set",
        "render.engine=embree",
        "render.posed_actors=all",
    )
    assert done.code == 0, done.err
    return veldt.folder / "locale_plan"


def test_the_package_in_a_host_with_a_comma(plan, comma, tmp_path):
    passes.write_clip(tmp_path / "passes")
    outputs, sums = [], []
    for name in ("point", "comma"):
        (tmp_path / name).mkdir()
        done = subprocess.run(
            [sys.executable, "-c", HOST, name, plan, tmp_path / "passes"],
            cwd=tmp_path / name,
            env=os.environ | {"LOCPATH": comma["LOCPATH"]},
            capture_output=True,
            text=True,
            check=False,
        )
        assert (done.returncode, done.stderr) == (0, "")
        outputs.append(done.stdout)
        sums.append(_sums(tmp_path / name))
    assert outputs[0] == outputs[1]
    assert sums[0] == sums[1] and len(sums[0]) > 20


def test_the_command_with_a_comma(veldt, plan, comma):
    passes.write_clip(veldt.folder / "for_comma")
    runs = [
        ("generate", "--plan", plan, "--out", "made"),
        (
            "convert",
            "for_comma",
            "--out",
            "converted",
            "--set",
            "sensor.preset=boson_640_14mm",
            "season=summer",
        ),
        ("export", "made", "--format", "coco", "--out", "coco", "--split", "train:0.5,val:0.5"),
        ("export", "made", "--format", "yolo", "--segmentation", "polygon", "--out", "yolo"),
        ("export", "made", "--format", "tiff", "--origin=-24.5,31.25,410.5", "--out", "tiff"),
        ("report", "made", "--out", "report.html"),
    ]
    outputs = []
    for environment in (None, comma):
        before = _sums(veldt.folder)
        outcome = [veldt(*run, "--quiet", env=environment) for run in runs]
        made = {name: total for name, total in _sums(veldt.folder).items() if name not in before}
        assert [one.code for one in outcome] == [0] * len(runs), outcome
        outputs.append(([(one.code, one.out, one.err) for one in outcome], made))
        for name in ("made", "converted", "coco", "yolo", "tiff", "report.html"):
            (veldt.folder / name).rename(veldt.folder / f"{name}_{len(outputs)}")
    assert outputs[0] == outputs[1]
