"""Plans whose files do not agree, with checksums that are right: what somebody may hand to a job of a cluster."""

import hashlib
import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from configs import tiny
from program import Veldt, check_fault


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    veldt = Veldt(tmp_path_factory.mktemp("forged"))
    config = tiny() | {"render": {"engine": "embree"}}
    config["clips"][1]["frames"] = 2
    flight = config["clips"][0]["flight"]
    config["flights"] = [{"id": "long", "season": "winter", "duration_s": 1, "flight": flight}]
    veldt.write("config.json", config)
    assert veldt("plan", "config.json", "--out", "plan", "--quiet").code == 0
    return veldt


def _edit(file: Path, change: Callable[[dict], None]) -> None:
    content = json.loads(file.read_text(encoding="utf-8"))
    change(content)
    file.write_text(json.dumps(content), encoding="utf-8")


def _sign(plan: Path) -> None:
    """Write the checksums of the files as they are."""
    files = [file for file in plan.rglob("*") if file.is_file() and file.name != "checksums.json"]
    sums = {str(file.relative_to(plan)): hashlib.sha256(file.read_bytes()).hexdigest() for file in files}
    (plan / "checksums.json").write_text(json.dumps(sums), encoding="utf-8")


def _in(name: str, change: Callable[[dict], None]) -> Callable[[Path], None]:
    return lambda plan: _edit(plan / name, change)


def _clip(number: int, **values) -> Callable[[Path], None]:
    return _in("plan.json", lambda plan: plan["clips"][number].update(values))


def _use_the_track_of_another_clip(plan: Path) -> None:
    for ending in ("json", "bin"):
        shutil.copy(plan / "tracks" / f"side.{ending}", plan / "tracks" / f"down.{ending}")
    _edit(plan / "tracks" / "down.json", lambda track: track.update(clip="down"))


# By name: what is done to a plan, and what the program says.
FORGERIES = {
    "unknown flight": (
        _clip(2, of_flight="short"),
        'plan.json: clips[2].of_flight = "short"; expected a flight of the config',
    ),
    "clip of no flight": (
        _clip(2, of_flight=""),
        'plan.json: clips[2].of_flight = ""; expected a flight of the config',
    ),
    "clip that is not the config's": (
        _clip(1, id="up"),
        'plan.json: clips[1].id = "up"; expected "side", as in the config',
    ),
    "clip of both": (
        _clip(1, of_flight="long"),
        'plan.json: clips[1].of_flight = "long"; expected "", for a clip of the config',
    ),
    "missing clip": (
        _in("plan.json", lambda plan: plan["clips"].__delitem__(slice(1, None))),
        'plan.json: clips[1].id = ""; expected "side", as in the config',
    ),
    "clip twice": (_clip(2, id="down"), 'plan.json: clips[2].id = "down"; expected each id once'),
    "more frames than the config": (
        _clip(1, frames=3),
        "plan.json: clips[1].frames = 3; expected 2, as in the config",
    ),
    "more frames than an int has": (
        _clip(2, frames=2**31),
        "plan.json: clips[2].frames = 2147483648; expected at least 1 and at most 20736000",
    ),
    "more frames in all than an int has": (
        _in(
            "plan.json",
            lambda plan: plan["clips"].extend(
                plan["clips"][2] | {"id": f"n{k}", "frames": 20736000} for k in range(104)
            ),
        ),
        "plan.json: clips have {frames} frames; expected at most 2147483647",
    ),
    "other picture": (
        _in("scene.json", lambda scene: scene["camera"].update(width_px=100000)),
        "scene.json: camera = 100000 x 80 px; expected 96 x 80, as in the config",
    ),
    "depths in the wrong order": (
        _in("scene.json", lambda scene: scene.update(depth_range_m=[9, 2])),
        "scene.json: depth_range_m = [9,2]; expected the nearest depth, then the farthest",
    ),
    "object twice": (
        _in("scene.json", lambda scene: scene["objects"].append(scene["objects"][0])),
        "scene.json: objects[{objects}].index = 1; expected each value once",
    ),
    "actor without an id": (
        _in("scene.json", lambda scene: scene["objects"][-1].pop("track_id")),
        "scene.json: objects[{last}].track_id is missing; expected one for every actor",
    ),
    "actor that is the ground": (
        _in("scene.json", lambda scene: scene["actors"][0].update(object=1)),
        "scene.json: actors[0].object = 1; expected the index of an actor in objects",
    ),
}


@pytest.mark.parametrize("name", FORGERIES)
def test_what_does_not_agree_is_refused(place, tmp_path, name):
    forge, message = FORGERIES[name]
    plan = tmp_path / "plan"
    shutil.copytree(place.folder / "plan", plan)
    objects = len(json.loads((plan / "scene.json").read_text(encoding="utf-8"))["objects"])
    forge(plan)
    _sign(plan)
    frames = sum(clip["frames"] for clip in json.loads((plan / "plan.json").read_text("utf-8"))["clips"])
    done = place("generate", "--plan", plan, "--out", tmp_path / "out", "--quiet")
    expected = message.format(objects=objects, last=objects - 1, frames=frames)
    check_fault(done, 1, f"{plan}/{expected}")


def test_a_track_with_other_frames_makes_no_clip(place, tmp_path):
    plan = tmp_path / "plan"
    shutil.copytree(place.folder / "plan", plan)
    _use_the_track_of_another_clip(plan)
    _sign(plan)
    for command in ("generate", "render"):
        done = place(command, "--plan", plan, "--clips", "down", "--out", tmp_path / command, "--quiet")
        assert done.code == 1
        assert f"{plan}/tracks/down.json: frames = 2; expected 8, as plan.json has them" in done.err
