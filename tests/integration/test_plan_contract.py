"""The contract between the Python that writes plans and the C++ that reads them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from configs import tiny
from program import PROGRAM, ROOT, Veldt
from planner.bake.baked import read_plan, read_scene, read_track

ECHO = Path(os.environ.get("VELDT_PLAN_ECHO") or PROGRAM.parent / "plan_echo")
SCHEMAS = ROOT / "configs" / "schema"


@pytest.fixture(scope="module", name="plan")
def _plan(tmp_path_factory) -> Path:
    veldt = Veldt(tmp_path_factory.mktemp("planned"))
    veldt.write("config.json", tiny())
    assert veldt("plan", "config.json", "--out", "plan", "--quiet").code == 0
    return veldt.folder / "plan"


def _echo(plan: Path, out: Path, *clips: str) -> subprocess.CompletedProcess:
    return subprocess.run([ECHO, ROOT, plan, out, *clips], capture_output=True, text=True, check=False)


def _read(folder: Path, *clips: str) -> list:
    scene = read_scene(folder / "scene")
    return [scene, *(read_track(folder / "tracks" / clip, scene) for clip in clips)]


def test_files_keep_to_their_schemas(plan):
    for kind, name in (
        ("plan", "plan"),
        ("scene", "scene"),
        ("track", "tracks/down"),
        ("track", "tracks/side"),
    ):
        schema = json.loads((SCHEMAS / f"{kind}.schema.json").read_text(encoding="utf-8"))
        jsonschema.validate(json.loads((plan / f"{name}.json").read_text(encoding="utf-8")), schema)
    assert [clip["id"] for clip in read_plan(plan)["clips"]] == ["down", "side"]


def test_a_plan_read_by_one_side_and_written_again_is_the_same_to_the_other(plan, tmp_path):
    done = _echo(plan, tmp_path / "out", "down", "side")
    assert (done.returncode, done.stderr) == (0, "")
    (scene, *tracks), (again, *tracks_again) = (
        _read(folder, "down", "side") for folder in (plan, tmp_path / "out")
    )
    for one, other in ((scene, again), *zip(tracks, tracks_again)):
        arrays, others = (vars(side).get("arrays") or vars(side) for side in (one, other))
        assert arrays.keys() == others.keys()
        assert all(np.array_equal(arrays[name], others[name]) for name in arrays)
    described, described_again = (
        {key: value for key, value in side.header.items() if key != "arrays"} for side in (scene, again)
    )
    assert described == described_again


def _header(name: str, change: Callable[[dict], None]) -> Callable[[Path], None]:
    def tamper(plan: Path) -> None:
        file = plan / f"{name}.json"
        header = json.loads(file.read_text(encoding="utf-8"))
        change(header)
        file.write_text(json.dumps(header), encoding="utf-8")

    return tamper


def _value(name: str, array: str, kind: str, place: int, value) -> Callable[[Path], None]:
    def tamper(plan: Path) -> None:
        header = json.loads((plan / f"{name}.json").read_text(encoding="utf-8"))
        data = bytearray((plan / f"{name}.bin").read_bytes())
        number = np.array([value], kind).tobytes()
        start = header["arrays"][array]["offset"] + place * len(number)
        data[start : start + len(number)] = number
        (plan / f"{name}.bin").write_bytes(data)

    return tamper


def _cut(name: str) -> Callable[[Path], None]:
    def tamper(plan: Path) -> None:
        data = (plan / f"{name}.bin").read_bytes()
        (plan / f"{name}.bin").write_bytes(data[:-64])

    return tamper


GROUND = "meshes/0/points_m"
# By name: what is done to a plan, and what is said.
FAULTS = {
    "scene of another version": (
        _header("scene", lambda header: header.update(version=2)),
        "{plan}/scene.json: version = 2; expected at least 1 and at most 1",
    ),
    "track of another version": (
        _header("tracks/down", lambda header: header.update(version=0)),
        "{plan}/tracks/down.json: version = 0; expected at least 1 and at most 1",
    ),
    "another format": (
        _header("scene", lambda header: header.update(format="veldt-plan")),
        '{plan}/scene.json: format = "veldt-plan"; expected veldt-scene',
    ),
    "scene that does not say what mirrors": (
        _header("scene", lambda header: header.pop("mirrors")),
        "{plan}/scene.json: mirrors is missing; expected a value",
    ),
    "truncated scene": (
        _cut("scene"),
        "{plan}/scene.bin: {less} bytes; expected {bytes}",
    ),
    "truncated track": (_cut("tracks/side"), "{plan}/tracks/side.bin: "),
    "offset outside": (
        _header("scene", lambda header: header["arrays"][GROUND].update(offset=header["bytes"])),
        f"{{plan}}/scene.json: arrays.{GROUND}.offset = {{bytes}}; expected a multiple of 64 within the {{bytes}}"
        " bytes of scene.bin, with all of the array",
    ),
    "offset not aligned": (
        _header("scene", lambda header: header["arrays"][GROUND].update(offset=4)),
        f"{{plan}}/scene.json: arrays.{GROUND}.offset = 4; expected a multiple of 64 within the {{bytes}} bytes of"
        " scene.bin, with all of the array",
    ),
    "shape beyond the file": (
        _header("scene", lambda header: header["arrays"][GROUND].update(shape=[10**9, 10**9, 10**9])),
        f"{{plan}}/scene.json: arrays.{GROUND}.offset = 0; expected a multiple of 64 within the {{bytes}} bytes of"
        " scene.bin, with all of the array",
    ),
    "NaN in a plant's transform": (
        _value("scene", "plants/acacia/transform", "<f8", 3, np.nan),
        "{plan}/scene.json: plants/acacia/transform[3] = nan; expected a finite number",
    ),
    "NaN in a bone's transform": (
        _value("tracks/side", "bones", "<f4", 7, np.nan),
        "{plan}/tracks/side.json: bones[7] = nan; expected a finite number",
    ),
    "infinity in a pose": (
        _value("tracks/side", "camera_to_world", "<f8", 3, np.inf),
        "{plan}/tracks/side.json: camera_to_world[3] = inf; expected a finite number",
    ),
    "material without a name": (
        _value("scene", "meshes/0/material_index", "<u2", 5, 999),
        "{plan}/scene.json: meshes/0/material_index[5] = 999; expected an index of materials",
    ),
    "object without a name": (
        _header("scene", lambda header: header["surfaces"][0].update(object=77)),
        "{plan}/scene.json: surfaces[0].object = 77; expected an index of objects",
    ),
    "vertex that is not there": (
        _value("scene", "meshes/0/triangles", "<u4", 2, 4000000000),
        "{plan}/scene.json: meshes/0/triangles = 4000000000; expected one of the {points} points",
    ),
    "mesh that is not there": (
        _value("scene", "plants/acacia/mesh", "<u4", 0, 5000),
        "{plan}/scene.json: plants/acacia/mesh = 5000; expected one of the {meshes} meshes",
    ),
    "too few bones": (
        _header("tracks/side", lambda header: header["arrays"]["bones"]["shape"].__setitem__(0, 3)),
        "{plan}/tracks/side.json: arrays.bones.shape = [3,3,4]; expected [{bones}, 3, 4]",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_the_reader_refuses(plan, tmp_path, name):
    tamper, message = FAULTS[name]
    header = json.loads((plan / "scene.json").read_text(encoding="utf-8"))
    side = json.loads((plan / "tracks" / "side.json").read_text(encoding="utf-8"))
    damaged = tmp_path / "plan"
    shutil.copytree(plan, damaged)
    tamper(damaged)
    done = _echo(damaged, tmp_path / "out", "down", "side")
    expected = message.format(
        plan=damaged,
        bytes=header["bytes"],
        less=header["bytes"] - 64,
        points=header["arrays"][GROUND]["shape"][0],
        meshes=len(header["meshes"]),
        bones=side["arrays"]["bones"]["shape"][0],
    )
    assert done.returncode == 1
    assert done.stderr == f"{expected}\n" or (message.endswith(": ") and done.stderr.startswith(expected))
