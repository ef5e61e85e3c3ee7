"""`bench`: rendering and engines are measured scene by scene, with a Blender that only pretends.

Speed is not checked, since it depends on the machine.
"""

import sys
from pathlib import Path

import pytest

import configs
from program import ROOT

# Stands in for Blender: one frame of passes, and times that are easy to distinguish. Of a plan that has a scene, it
# keeps frames on which all is ground.
FAKE = f"""#!{sys.executable} -B
import json, sys
from pathlib import Path
sys.path.insert(0, {str(ROOT / "tests" / "support")!r})
import numpy
from pictures import write_exr

options = {{}}
for word in sys.argv[1:]:
    if word.startswith("--"):
        values = options.setdefault(word, [])
    else:
        values.append(word)
single = {{name: values[0] for name, values in options.items() if values}}
with open(int(single["--events-fd"]), "w") as events:
    def report(**event):
        print(json.dumps(event), file=events, flush=True)

    if Path(__file__).with_name("fails").exists():
        report(event="error", kind="internal", message="ValueError: out of trees", where="blender_scripts/a.py:7")
        sys.exit(1)
    plan = json.loads((Path(single["--plan"]) / "plan.json").read_text())
    if single["--python"].endswith("profile_render.py"):
        for size in map(int, options["--supersample"]):
            for clip in options.get("--clip", ["one"]):
                split_s = {{"pose": 0.001, "scene": 0.02, "sync_and_trees": 0.03, "trace": 0.125 * size}}
                times = {{"split_s": split_s | {{"write": 0.0625}}, "frame_s": 0.25}}
                report(event="profile", clip=clip, pixels=24 * size**2, objects=7, peak_mb=100, frames=7, **times)
                folder = Path(single["--out"]) / clip / f"{{size}}x{{size}}"
                for frame in range(4 if (Path(single["--plan"]) / "scene.json").exists() and size == 1 else 0):
                    folder.mkdir(parents=True, exist_ok=True)
                    camera = plan["config"]["camera"]
                    ground = numpy.ones((camera["height_px"], camera["width_px"]))
                    write_exr(folder / f"{{frame:06d}}.exr", {{"Scene.IndexOB.X": ground, "Scene.IndexMA.X": ground}})
        sys.exit(0)
    assert "--actor-layer" in sys.argv
    folder = Path(single["--out"]) / single["--clip"]
    folder.mkdir(parents=True)
    channels = ("IndexOB.X", "IndexMA.X", "Depth.Z", "Normal.X", "Normal.Y", "Normal.Z")
    planes = {{f"Scene.{{name}}": numpy.ones((4, 6)) for name in channels}}
    planes["Actors.IndexOB.X"] = numpy.ones((4, 6))
    planes["Scene.Depth.Z"][0, :2] += single["--threads"] == "1"
    for frame in range(plan["clips"][0]["frames"]):
        write_exr(folder / f"{{frame:06d}}.exr", planes)
        report(event="frame", clip=single["--clip"], index=frame)
"""


# Stands in for Python: writes the least that is a plan, without its scene.
FAKE_PLANNER = f"""#!{sys.executable} -B
import json, sys
from pathlib import Path

config = json.load(sys.stdin)
known = {{"duration_s": 1, "frames_with_actors": 0, "min_agl_m": 1, "max_agl_m": 1, "mean_agl_m": 1}}
clips = [
    {{"id": clip["id"], "of_flight": "", "start_s": 0, "frames": clip["frames"], "frame_rate_hz": 9, **known}}
    | {{"mean_look_angle_deg": 90}}
    for clip in config["clips"]
]
plan = {{"format": "veldt-plan", "version": 1, "config": config, "files": {{}}, "clips": clips, "actors": 0}}
plan |= {{"plants": 0, "outline": {{"covers": {{}}, "actors": []}}}}
(Path(sys.argv[sys.argv.index("--out") + 1]) / "plan.json").write_text(json.dumps(plan))
print(json.dumps(plan))
"""


@pytest.fixture(name="fake")
def _fake(veldt, monkeypatch) -> Path:
    planner, file = veldt.write("fake_python", FAKE_PLANNER), veldt.write("fake_blender", FAKE)
    for program in (planner, file):
        program.chmod(0o755)
    monkeypatch.setenv("VELDT_PYTHON", str(planner))
    return file


@pytest.fixture(name="small_home")
def _small_home(veldt) -> dict[str, str]:
    """The environment of a Veldt whose demo and savanna are small."""
    home = veldt.folder / "home"
    (home / "configs").mkdir(parents=True)
    for name in ("assets", "blender_scripts", "configs/schema"):
        (home / name).symlink_to(ROOT / name)
    for name in ("demo", "savanna"):
        veldt.write(f"home/configs/{name}.json", configs.tiny())
    return {"VELDT_HOME": str(home)}


def test_rendering_is_reported_by_scene_step_and_processes(veldt, fake, small_home):
    done = veldt("bench", "--suite", "render", "--blender", fake, "--json", env=small_home)
    assert done.code == 0, done.err
    assert done.err == "".join(
        f"measuring {what}\n"
        for what in (
            "demo, planning",
            "demo, 1x1 rays per pixel",
            "demo, 2x2 rays per pixel",
            "savanna, planning",
            "savanna, 1x1 rays per pixel",
            "savanna, 2x2 rays per pixel",
            "demo with actor layers, one process of two threads",
            "demo with actor layers, two processes of one thread",
        )
    )
    rows = {(row["group"], row["name"]): row["figures"] for row in done.json()["rows"]}
    assert [name for group, name in rows if group == "frame, s"] == [
        "demo 1x1",
        "demo 2x2",
        "savanna 1x1",
        "savanna 2x2",
    ]
    assert rows["frame, s", "savanna 2x2"] == {
        "pixels": 96,
        "objects": 7,
        "frame": 0.25,
        "pose": 0.001,
        "scene": 0.02,
        "sync_and_trees": 0.03,
        "trace": 0.25,
        "write": 0.0625,
    }
    processes = [figures for (group, _), figures in rows.items() if group == "demo with actor layers"]
    assert [figures["differing_px"] for figures in processes] == [0, 2]
    assert all(figures["frames_per_s"] > 0 for figures in processes)
    files = {name: figures for (group, name), figures in rows.items() if group == "file of passes"}
    assert list(files) == [
        "the converter reads it",
        "its bytes copied",
        "its bytes written",
    ]
    assert len({figures["mb"] for figures in files.values()}) == 1
    assert all(figures["ms"] > 0 for figures in files.values())


def test_rendering_is_reported_in_a_table(veldt, fake, small_home):
    done = veldt("bench", "--suite", "render", "--blender", fake, "--quiet", env=small_home)
    assert (done.code, done.err) == (0, "")
    head, first = done.out.splitlines()[1:3]
    assert head.split() == "frame, s pixels objects frame pose scene sync_and_trees trace write".split()
    assert first.split() == "demo 1x1 24 7 0.25 0.001 0.02 0.03 0.125 0.0625".split()
    assert len(head) == len(first) == 32 + 8 * 15


def test_a_blender_that_fails_gives_its_reason(veldt, fake, small_home):
    veldt.write("fails", "")
    done = veldt("bench", "--suite", "render", "--blender", fake, "--quiet", env=small_home)
    assert (done.code, done.out) == (1, "")
    why = "ValueError: out of trees (blender_scripts/a.py:7)"
    assert done.err == f"veldt: Blender failed while measuring frames: {why}\n"


def test_a_blender_that_ends_without_a_reason_is_quoted(veldt, fake, small_home):
    """Its log is in a folder that is removed with the run."""
    fake.write_text("#!/bin/sh\necho no display; exit 3\n")
    done = veldt("bench", "--suite", "render", "--blender", fake, "--quiet", env=small_home)
    assert (done.code, done.out) == (1, "")
    assert done.err == "veldt: Blender ended with exit code 3 while measuring frames: no display\n"


def test_measuring_frames_needs_a_blender(veldt):
    done = veldt("bench", "--suite", "render", "--blender", "nowhere")
    assert (done.code, done.out) == (2, "")
    assert done.err == "veldt: --blender = nowhere; expected an executable program\n"


VIEWS = ("demo", "savanna 61 m down", "savanna 122 m oblique", "savanna horizon", "savanna x 10 plants")
RAYS = ("1 ray", "4 rays", "16 rays")
FROM_EMBREE = {
    "frame, s": [f"{view}, {rays}" for view in VIEWS for rays in RAYS],
    "frame, s, adaptive sampling": [f"{view}, {rays}" for view in VIEWS for rays in RAYS[1:]],
    "peak memory so far, MB": [f"{view}, {rays}" for view in VIEWS for rays in RAYS],
    "memory by plants": ["10000 plants", "100000 plants", "1000000 plants"],
    "memory by threads": ["1 thread, 100000 plants", "2 threads, 100000 plants"],
    "memory by frames of a clip": ["10 frames", "100 frames", "1000 frames"],
}


def test_engines_are_compared_view_by_view(veldt, fake, small_home):
    done = veldt("bench", "--suite", "engines", "--blender", fake, "--json", env=small_home)
    assert done.code == 0, done.err
    scenes = ("demo", "savanna", "savanna x 10 plants")
    steps = [f"{scene}, planning" for scene in scenes] + ["memory of Embree by plants, threads and frames"]
    steps += [f"{scene}, {engine}" for scene in scenes for engine in ("Cycles", "Embree")]
    assert done.err == "".join(f"measuring {step}\n" for step in steps)
    groups: dict[str, dict[str, dict[str, float]]] = {}
    for row in done.json()["rows"]:
        groups.setdefault(row["group"], {})[row["name"]] = row["figures"]
    differing = groups.pop("pixels that differ, 1 ray")
    assert {group: list(rows) for group, rows in groups.items()} == FROM_EMBREE
    frame = groups["frame, s"]["demo, 4 rays"]
    assert (frame["cycles"], frame["cycles_trace"]) == (0.25 - 0.0625, 0.25)
    assert frame["cycles/embree"] == pytest.approx(frame["cycles"] / frame["embree"])
    assert 0 < groups["frame, s, adaptive sampling"]["demo, 4 rays"]["all_rays_share"] < 1
    assert groups["peak memory so far, MB"]["demo, 4 rays"]["cycles"] == 100
    assert list(differing) == list(VIEWS)
    for figures in differing.values():
        assert figures["pixels"] == 96 * 80
        assert 0 < figures["object_mean"] <= figures["object_most"] <= 96 * 80
        assert 0 < figures["material_mean"] <= figures["material_most"] <= 96 * 80
    plants = {name: rows["plants"] for name, rows in groups["peak memory so far, MB"].items()}
    assert plants["savanna x 10 plants, 1 ray"] > 2 * plants["savanna horizon, 1 ray"] > 0
    figures = [value for rows in groups.values() for row in rows.values() for value in row.values()]
    assert all(value >= 0 for value in figures)


def test_without_a_blender_embree_is_measured_alone(veldt, small_home):
    done = veldt(
        "bench", "--suite", "engines", "--quiet", "--threads", "1", env=small_home | {"PATH": "/none"}
    )
    missing = "no blender on PATH: Cycles is not measured; name one with --blender PATH\n"
    assert (done.code, done.err) == (0, missing)
    lines = done.out.splitlines()
    assert lines[1].split() == ["frame,", "s", "embree"]
    assert [line for line in lines if "cycles" in line or "differ" in line] == []
    assert len(lines) == sum(2 + len(rows) for rows in FROM_EMBREE.values())


def test_maps_are_measured_where_pixels_read_them(veldt, small_home):
    done = veldt("bench", "--suite", "maps", "--json", env=small_home)
    assert done.code == 0, done.err
    names = ("demo", "savanna", "savanna horizon")
    steps = [f"{name}{step}" for name in names for step in (", planning", "", ", 2584 rays")]
    assert done.err == "".join(f"measuring {step}\n" for step in steps)
    rows = {row["name"]: row["figures"] for row in done.json()["rows"]}
    assert tuple(rows) == names
    for figures in rows.values():
        assert figures["processor s"] > 0
        assert 0 < figures["traced share"] < 1
        assert figures["pixels"] > 10
        assert 0 < figures["sky view rms"] < 0.022  # as 89 rays a cell
