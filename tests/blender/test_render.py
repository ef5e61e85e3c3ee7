"""A real Blender renders a small scene: files, events, indices, determinism, resume and faults."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from rendering import PLANES, Run, render
from scenes import tiny
from planner import ids
from planner.blender_images import is_whole_exr

pytestmark = pytest.mark.blender

CLIPS = ("down", "side")


def _assert_same_pixels(one: Run, other: Run, clip: str, frames: int = 3) -> None:
    for frame in range(frames):
        first, second = one.planes(clip, frame), other.planes(clip, frame)
        assert all(np.array_equal(first[name], second[name]) for name in PLANES)


def test_files_are_whole_and_nothing_else_is_left(full):
    for clip in CLIPS:
        names = sorted(path.name for path in (full.out / clip).iterdir())
        assert names == ["000000.exr", "000001.exr", "000002.exr"]
        planes = full.planes(clip, 2)
        assert set(PLANES) <= set(planes)
        assert all(plane.shape == (80, 96) for plane in planes.values())


def test_a_clip_with_its_own_camera_is_rendered_as_by_that_camera(full, tmp_path):
    focal = {"camera": {"focal_length_m": 0.02}}
    (tmp_path / "own").mkdir()
    own = render(tmp_path / "own", tiny(lambda config: config["clips"][1].update(focal)))
    (tmp_path / "all").mkdir()
    usual = render(tmp_path / "all", tiny(lambda config: config["camera"].update(focal["camera"])))
    _assert_same_pixels(own, usual, "side")
    _assert_same_pixels(own, full, "down")
    assert own.meaning("side")["camera"]["fx_px"] == usual.meaning("side")["camera"]["fx_px"]


def test_events_are_complete_and_in_order(full):
    expected = ["scene_built"]
    for clip in CLIPS:
        expected += [
            ("clip", clip),
            *[("frame", clip, k, f"{k:06d}.exr") for k in range(3)],
            ("clip_done", clip),
        ]
    expected.append("done")
    reported = [
        {"frame": lambda e: ("frame", e["clip"], e["index"], e["file"])}.get(
            event["event"], lambda e: (e["event"], e["clip"]) if "clip" in e else e["event"]
        )(event)
        for event in full.events
    ]
    assert reported == expected
    assert full.events[0]["seconds"] > 0
    assert full.events[1] == {"event": "clip", "clip": "down", "first_frame": 0, "frames": 3}


def test_index_planes_hold_whole_listed_numbers(full):
    for clip in CLIPS:
        meaning = full.meaning(clip)
        objects = {entry["index"] for entry in meaning["objects"]} | {0}
        materials = {entry["index"] for entry in meaning["materials"]} | {0}
        for frame in range(3):
            planes = full.planes(clip, frame)
            assert set(np.unique(planes["Scene.IndexOB.X"])) <= objects
            assert set(np.unique(planes["Scene.IndexMA.X"])) <= materials


def test_objects_wear_their_own_materials(full):
    for clip in CLIPS:
        meaning = full.meaning(clip)
        material = {entry["index"]: entry["material"] for entry in meaning["materials"]}
        worn = {entry["index"]: {entry["material"]} for entry in meaning["objects"]} | {
            ids.GROUND: {"soil", "grass", "wet_soil", "rock"}
        }
        planes = full.planes(clip, 0)
        pairs = np.stack([planes["Scene.IndexOB.X"], planes["Scene.IndexMA.X"]], axis=-1).reshape(-1, 2)
        for index, slot in np.unique(pairs[pairs[:, 0] > 0].astype(int), axis=0):
            assert material[slot] in worn[index]


def test_the_scene_shows_what_it_should(full):
    seen = {
        int(k) for clip in CLIPS for frame in range(3) for k in np.unique(full.planes(clip, frame)[PLANES[0]])
    }
    assert {ids.GROUND, ids.WATER, ids.FIRST_PLANT, ids.FIRST_PLANT + 1, 103, 104} <= seen


def test_clips_and_threads_change_no_pixel(full, tmp_path):
    """One thread, the clips in the other order: the same pixels as with two threads in the config's order."""
    run = render(tmp_path, tiny(), "--clip", "side", "--clip", "down", threads=1)
    assert run.code == 0, run.log
    assert [event["clip"] for event in run.events if event["event"] == "clip"] == ["side", "down"]
    for clip in CLIPS:
        _assert_same_pixels(full, run, clip)


def test_what_blender_keeps_from_frame_to_frame_changes_no_pixel(full, tmp_path):
    script = Path(__file__).parent / "render_forgetfully.py"
    run = render(tmp_path, tiny(), script=script)
    assert run.code == 0, run.log
    for clip in CLIPS:
        _assert_same_pixels(full, run, clip)


def test_a_killed_clip_goes_on_where_it_stopped(full, tmp_path):
    out = tmp_path / "out"
    shutil.copytree(full.out / "down", out / "down")
    for name in ("000001.exr", "000002.exr"):
        (out / "down" / name).unlink()
    (out / "down" / "part_000001.exr").write_bytes(b"half a frame")
    kept = (out / "down" / "000000.exr").stat().st_mtime_ns
    run = render(tmp_path, tiny(), "--clip", "down", out=out)
    assert run.code == 0, run.log
    assert run.events[1] == {"event": "clip", "clip": "down", "first_frame": 1, "frames": 3}
    assert [event["index"] for event in run.events if event["event"] == "frame"] == [1, 2]
    assert (out / "down" / "000000.exr").stat().st_mtime_ns == kept
    assert not list((out / "down").glob("part*"))
    _assert_same_pixels(full, run, "down")


def test_a_damaged_frame_is_rendered_again(full, tmp_path):
    out = tmp_path / "out"
    shutil.copytree(full.out / "down", out / "down")
    frame = out / "down" / "000001.exr"
    frame.write_bytes(frame.read_bytes()[:-100])
    run = render(tmp_path, tiny(), "--clip", "down", out=out)
    assert run.code == 0, run.log
    assert [event["index"] for event in run.events if event["event"] == "frame"] == [1, 2]
    _assert_same_pixels(full, run, "down")


def test_an_unknown_clip_is_reported(tmp_path):
    run = render(tmp_path, tiny(), "--clip", "dwn")
    assert run.code == 2
    assert run.events[-1]["message"] == (
        '--clip = "dwn"; expected a clip of the plan: down, side; did you mean "down"?'
    )


def test_a_failure_names_the_line(tmp_path):
    (tmp_path / "out").write_text("a file where the folder should be")
    run = render(tmp_path, tiny())
    assert run.code == 1
    error = run.events[-1]
    assert (error["event"], error["kind"]) == ("error", "internal")
    assert error["message"].startswith("NotADirectoryError: [Errno 20] Not a directory: ")
    assert error["where"].startswith("blender_scripts/render_passes.py:")


def test_a_frame_cut_short_never_gets_its_final_name(tmp_path):
    """Blender itself reports such a frame as saved."""
    run = render(tmp_path, tiny(), largest_file_bytes=30_000)
    assert run.code == 1
    frame = run.out / "down" / "000000.exr"
    why = "Blender could not write all of it; is the disk full?"
    assert run.events[-1]["message"] == f"OSError: {frame}: {why}"
    assert not [event for event in run.events if event["event"] == "frame"]
    assert not frame.exists()
    assert run.log.count("Saved:") == 1  # and the frames after it are not tried


def test_truncated_files_are_detected(full, tmp_path):
    whole = (full.out / "down" / "000000.exr").read_bytes()
    copy = tmp_path / "copy.exr"
    zeroed = whole[:800] + bytes(200) + whole[1000:]
    for content in (
        whole,
        whole[:-1],
        whole + b"x",
        whole[: len(whole) // 2],
        whole[:300],
        whole[:3],
        b"",
        zeroed,
    ):
        copy.write_bytes(content)
        assert is_whole_exr(copy) == (content is whole)
    assert not is_whole_exr(tmp_path / "none.exr")
