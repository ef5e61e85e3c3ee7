"""`merge`: datasets made as shards become one dataset, identical to one made in a single run."""

import json
import os
import shutil

import pytest

import fake_blender
from configs import CLIPS, FRAMES, tiny
from datasets import content_of
from program import Veldt, check_fault, files_below

THREE = (*CLIPS, "third")


def _three(config: dict) -> None:
    """A third clip, so that one shard has two."""
    config["clips"].append(config["clips"][0] | {"id": "third", "start_s": 3})


def _make(veldt, out: str, *options, config="config.json") -> None:
    blender = veldt.folder / "fake_blender"
    done = veldt("generate", config, "--out", out, "--quiet", "--blender", blender, *options)
    assert (done.code, done.out, done.err) == (0, "", "")


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A place with a whole dataset, and the same in three shards."""
    veldt = Veldt(tmp_path_factory.mktemp("shards"))
    fake_blender.install(veldt.folder)
    veldt.write("config.json", tiny(_three))
    _make(veldt, "whole")
    shutil.rmtree(veldt.folder / "whole" / "plan")  # merged datasets have none
    for k in range(3):
        _make(veldt, f"shard_{k}", "--shard", f"{k}/3")
    return veldt


SHARDS = ["shard_0", "shard_1", "shard_2"]


def _merge(place, *options, out):
    return place("merge", *options, "--out", out, "--progress", "none")


def _bytes_of(folder) -> dict:
    return {name: (folder / name).read_bytes() for name in files_below(folder)}


# --- what comes out ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("sources", [SHARDS, SHARDS[::-1]])
@pytest.mark.parametrize("link", ["hard", "copy"])
def test_shards_become_the_undivided_dataset(place, tmp_path, sources, link):
    before = [_bytes_of(place.folder / shard) for shard in SHARDS]
    done = _merge(place, *sources, "--link", link, out=tmp_path / "out")
    assert (done.code, done.err) == (0, "")
    assert done.out == f"{tmp_path}/out: 3 clips merged, 24 frames\n"
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")
    assert [_bytes_of(place.folder / shard) for shard in SHARDS] == before
    assert place("validate", tmp_path / "out").code == 0
    picture = tmp_path / "out" / "clips" / "down" / "ir16" / "000003.png"
    same = os.path.samefile(picture, place.folder / "shard_0" / "clips" / "down" / "ir16" / "000003.png")
    assert same == (link == "hard")


def test_once_more_there_is_nothing_to_do(place, tmp_path):
    _merge(place, *SHARDS, out=tmp_path / "out")
    times = {file: file.stat().st_mtime_ns for file in (tmp_path / "out").rglob("*")}
    done = _merge(place, *SHARDS, out=tmp_path / "out")
    assert (done.code, done.err) == (0, "")
    assert done.out == f"{tmp_path}/out: nothing to do, 3 clips already existed\n"
    assert {file: file.stat().st_mtime_ns for file in (tmp_path / "out").rglob("*")} == times


def test_missing_clips_are_named_and_a_later_merge_adds_them(place, tmp_path):
    done = _merge(place, "shard_0", "shard_2", out=tmp_path / "out")
    assert done.code == 3
    assert done.out == f"{tmp_path}/out: 2 clips merged, 16 frames; the dataset is not complete yet\n"
    assert done.err == f"veldt: {tmp_path}/out lacks clips side; none of shard_0, shard_2 has them complete\n"
    statuses = [
        clip["status"] for clip in json.loads((tmp_path / "out" / "dataset.json").read_text())["clips"]
    ]
    assert statuses == ["done", "pending", "done"]
    done = _merge(place, "shard_1", out=tmp_path / "out")
    assert (done.code, done.err) == (0, "")
    assert done.out == f"{tmp_path}/out: 1 clip merged, 8 frames; 2 already existed\n"
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")


def test_missing_clips_are_named_even_if_there_is_nothing_to_merge(place, tmp_path):
    _merge(place, "shard_0", out=tmp_path / "out")
    done = _merge(place, "shard_0", out=tmp_path / "out")
    assert done.code == 3
    assert done.out == f"{tmp_path}/out: nothing to do, 1 clip already existed\n"
    assert done.err == f"veldt: {tmp_path}/out lacks clips side, third; none of shard_0 has them complete\n"


def test_generate_makes_what_is_missing(place, tmp_path):
    _merge(place, "shard_0", "shard_2", out=tmp_path / "out")
    _make(place, str(tmp_path / "out"))
    shutil.rmtree(tmp_path / "out" / "plan")
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")
    assert place("validate", "shard_0").out.count("not made yet") == 2  # as before


def test_a_clip_that_is_in_two_of_them_comes_once(place, tmp_path):
    done = _merge(place, "whole", *SHARDS, out=tmp_path / "out")
    assert (done.code, done.err) == (0, "")
    assert content_of(tmp_path / "out") == content_of(place.folder / "whole")


def test_progress_counts_frames(place, tmp_path):
    done = place("merge", *SHARDS, "--out", tmp_path / "out", "--progress", "json")
    lines = [json.loads(line) for line in done.err.splitlines()]
    assert {line["clip"] for line in lines} == set(THREE)
    assert {line["frames_total"] for line in lines} == {3 * FRAMES}
    assert [line["frames_done"] for line in lines] == sorted(line["frames_done"] for line in lines)
    assert lines[-1]["frames_done"] == 3 * FRAMES


# --- what is wrong ----------------------------------------------------------------------------------------------------


@pytest.fixture(name="shards")
def _shards(place, veldt) -> Veldt:
    """A copy of the shards that a test may damage."""
    assert _merge(place, "shard_0", "--link", "copy", out=veldt.folder / "a").code == 3
    assert _merge(place, "shard_1", "shard_2", "--link", "copy", out=veldt.folder / "b").code == 3
    return veldt


def test_a_folder_that_is_no_dataset(shards):
    (shards.folder / "empty").mkdir()
    for name in ("empty", "nowhere"):
        done = _merge(shards, "a", name, out="out")
        check_fault(done, 2, f"DIR = {name}; expected a dataset, with a dataset.json")
    assert not (shards.folder / "out").exists()


def test_shards_of_different_configs(place, shards):
    config = tiny(_three)
    config["seed"] = 8
    place.write("other.json", config)
    _make(place, str(shards.folder / "c"), "--clips", "side", config="other.json")
    message = "seed is 7 here and 8 there; expected shards of one config"
    check_fault(_merge(shards, "a", "c", out="out"), 2, f"a and c have different configs: {message}")
    assert not (shards.folder / "out").exists()
    _merge(shards, "a", out="out")
    message = "seed is 8 here and 7 there; expected the same config, or another folder"
    check_fault(_merge(shards, "c", out="out"), 2, f"out holds a dataset made from another config: {message}")


def test_shards_of_another_version(shards):
    index = shards.read("b/dataset.json")
    version, index["veldt_version"] = index["veldt_version"], "0.0.1"
    shards.write("b/dataset.json", index)
    done = _merge(shards, "a", "b", out="out")
    check_fault(done, 2, f"b: veldt_version = 0.0.1; expected {version}, this program's version")


def test_two_of_one_clip_that_differ(place, shards):
    record = shards.read("a/clips/down/clip.json")
    record["pixels_sha256"] = "0" * 64
    shards.write("a/clips/down/clip.json", record)
    done = _merge(place, "shard_0", shards.folder / "a", out=shards.folder / "out")
    folders = f"shard_0/clips/down and {shards.folder}/a/clips/down"
    check_fault(done, 1, f"{folders} differ; expected the same pixels and labels")
    assert not (shards.folder / "out" / "dataset.json").exists()


def test_the_folder_of_a_source(shards):
    done = _merge(shards, "a", "b", out="b")
    rule = "expected a folder that is not among DIR; to add the others to it, leave it out of DIR"
    check_fault(done, 2, f"--out = b; {rule}")
    done = _merge(shards, "a", out="b")
    assert (done.code, done.out, done.err) == (0, "b: 1 clip merged, 8 frames; 2 already existed\n", "")


DAMAGE = {
    "a picture is missing": ("ir16/000002.png", lambda file: file.unlink(), "missing"),
    "a picture has changed": (
        "ir8/000001.png",
        lambda file: file.write_bytes(b"x"),
        "changed since it was written",
    ),
    "the record has changed": (
        "clip.json",
        lambda file: file.write_text(file.read_text().replace("winter", "summer")),
        "changed since it was written",
    ),
}


@pytest.mark.parametrize("name", DAMAGE)
def test_a_damaged_clip_fails_alone_unless_another_source_has_it(place, shards, name):
    file, spoil, what = DAMAGE[name]
    spoil(shards.folder / "a" / "clips" / "down" / file)
    done = _merge(shards, "a", "b", out="out")
    assert done.code == 3
    assert done.err == f"veldt: clip down failed: a/clips/down/{file}: {what}\n"
    assert done.out == "out: 2 clips merged, 16 frames; the dataset is not complete yet\n"
    assert not list((shards.folder / "out" / "clips").glob("down*"))
    done = _merge(shards, "a", place.folder / "shard_0", "b", out="out")
    assert (done.code, done.err) == (0, "")
    assert content_of(shards.folder / "out") == content_of(place.folder / "whole")


def test_way_to_link_that_there_is_not(shards):
    done = _merge(shards, "a", "--link", "soft", out="out")
    check_fault(done, 2, "--link: soft not in {hard,copy}; see veldt merge --help")
