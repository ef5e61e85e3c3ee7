"""`export --format webdataset`: tar files of samples, with the dataset's own bytes, the same in every run."""

import json
import os
import shutil
import signal
import tarfile
from pathlib import Path

import pytest

import passes
from exports import CLIPS, with_three_clips
from processes import PATIENCE_S, interrupt
from program import Veldt, check_fault, files_below

FRAMES = passes.FRAMES
FORMAT = ("--format", "webdataset")
KEYS = [f"{clip}_{k:06d}" for clip in CLIPS for k in range(FRAMES)]


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    return with_three_clips(tmp_path_factory.mktemp("webdataset"))


def _made(place, out, *options, source="data", env=None) -> Path:
    done = place("export", source, "--out", out, *FORMAT, *options, "--quiet", env=env)
    assert (done.code, done.out, done.err) == (0, "", "")
    return place.folder / out


def _members(*shards: Path) -> dict[str, bytes]:
    """Content of all files of some tar files, in their order."""
    content: dict[str, bytes] = {}
    for shard in shards:
        with tarfile.open(shard) as tar:
            for member in tar:
                assert member.name not in content
                content[member.name] = tar.extractfile(member).read()
    return content


def _labels(members: dict[str, bytes]) -> dict[str, dict]:
    return {name[:-5]: json.loads(text) for name, text in members.items() if name.endswith(".json")}


# --- samples ----------------------------------------------------------------------------------------------------------


def test_pictures_are_those_of_the_dataset(place, tmp_path):
    done = place("export", "data", "--out", tmp_path / "x", *FORMAT, "--progress", "none")
    assert (done.code, done.err) == (0, "")
    assert done.out == (
        f"{tmp_path}/x: 9 pictures and 16 labels as webdataset\n"
        "  split          clips  pictures  labels   human  elephant\n"
        "  train              3         9      16       8         8\n"
    )
    assert files_below(tmp_path / "x") == ["export.json", "train/made_up-000000.tar"]
    members = _members(tmp_path / "x/train/made_up-000000.tar")
    assert list(members) == [f"{key}.{end}" for key in KEYS for end in ("json", "png")]
    for clip in CLIPS:
        for k in range(FRAMES):
            picture = place.folder / "data" / "clips" / clip / "ir8" / f"{k:06d}.png"
            assert members[f"{clip}_{k:06d}.png"] == picture.read_bytes()


def test_labels_are_those_of_the_dataset(place, tmp_path):
    out = _made(place, tmp_path / "x")
    labels = _labels(_members(out / "train/made_up-000000.tar"))
    document = place.read("data/annotations.json")
    names = {category["id"]: category["name"] for category in document["categories"]}
    videos = {video["id"]: video["name"] for video in document["videos"]}
    for key, image in zip(KEYS, document["images"], strict=True):
        sample = dict(labels[key])
        found = sample.pop("annotations")
        assert sample == {
            "clip": videos[image["video_id"]],
            "frame_index": image["frame_index"],
            "width": passes.WIDTH,
            "height": passes.HEIGHT,
            "time_s": image["time_s"],
            "frame_rate_hz": 9,
        }
        expected = [a for a in document["annotations"] if a["image_id"] == image["id"]]
        assert len(found) == len(expected)
        for made, truth in zip(found, expected):
            assert made.pop("category") == names[truth["category_id"]]
            assert made == {key: truth[key] for key in made}
            assert {"id", "category_id", "bbox", "area", "track_id", "iscrowd", "ignore"} <= made.keys()
    assert labels["three_000002"]["annotations"] == []
    assert sum(len(sample["annotations"]) for sample in labels.values()) == 16


def test_visibility_and_flags(veldt):
    (veldt.folder / "a.png").write_bytes(b"a picture")
    image = {"id": 1, "file_name": "a.png", "width": 9, "height": 8}
    label = {"id": 4, "image_id": 1, "category_id": 1, "bbox": [1, 1, 2.5, 2]}
    flags = {"iscrowd": 1, "ignore": 1, "visibility": 0.25, "track_id": 3, "occluded": 1, "truncated": True}
    document = {"images": [image], "annotations": [label, label | {"id": 5} | flags]}
    veldt.write("labels.json", document | {"categories": [{"id": 1, "name": "lion"}]})
    labels = _labels(_members(_made(veldt, "x", source="labels.json") / "train/labels-000000.tar"))
    (sample,) = labels.values()
    assert sample.keys() == {"clip", "frame_index", "width", "height", "annotations"}
    plain, flagged = sample["annotations"]
    assert plain["bbox"] == [1, 1, 2.5, 2]
    assert not plain.keys() & {"track_id", "visibility", "occluded"}
    assert (plain["iscrowd"], plain["ignore"]) == (0, False)
    assert {key: flagged[key] for key in flags} == flags


def test_pictures_of_sixteen_bits(place, tmp_path):
    out = _made(place, tmp_path / "x", "--images", "ir16")
    members = _members(out / "train/made_up-000000.tar")
    picture = place.folder / "data/clips/two/ir16/000001.png"
    assert members["two_000001.png"] == picture.read_bytes()


def test_bytes_depend_on_the_dataset_alone(place, tmp_path):
    one, other = _made(place, tmp_path / "x"), _made(place, tmp_path / "y", "--threads", 1)
    os.utime(place.folder / "data/clips/one/ir8/000000.png", (1, 1))
    (place.folder / "data/clips/one/ir8/000001.png").chmod(0o400)
    again = _made(place, tmp_path / "z")
    shard = "train/made_up-000000.tar"
    assert (one / shard).read_bytes() == (other / shard).read_bytes() == (again / shard).read_bytes()
    with tarfile.open(one / shard) as tar:
        for member in tar:
            assert (member.mtime, member.uid, member.gid, member.mode) == (0, 0, 0, 0o644)
            assert (member.uname, member.gname, member.pax_headers) == ("", "", {})
    assert (one / shard).read_bytes()[257:263] == b"ustar\0"


def test_names_of_any_kind(veldt):
    """Dots end a key, so none may be in it; a name that ustar cannot hold still fits."""
    names = ["a.b/c.d.png", "Übung/ñ.png", f"{'long' * 20}/{'name' * 20}.jpg"]
    for name in names:
        (veldt.folder / name).parent.mkdir()
        (veldt.folder / name).write_bytes(name.encode())
    images = [{"id": k, "file_name": name, "width": 9, "height": 8} for k, name in enumerate(names)]
    veldt.write("labels.json", {"images": images, "annotations": [], "categories": []})
    out = _made(veldt, "x", source="labels.json")
    members = _members(out / "train/labels-000000.tar")
    keys = ["a_b_c_d", "Übung_ñ", f"{'long' * 20}_{'name' * 20}"]
    ends = ["png", "png", "jpg"]
    assert list(members) == [f"{key}.{end}" for key, e in zip(keys, ends) for end in ("json", e)]
    assert [members[f"{key}.{end}"].decode() for key, end in zip(keys, ends)] == names


# --- shards -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("samples, sizes", [(1, [1] * 9), (4, [4, 4, 1]), (9, [9]), (1000000, [9])])
def test_samples_per_shard(place, tmp_path, samples, sizes):
    out = _made(place, tmp_path / "x", "--samples-per-shard", samples)
    shards = [out / f"train/made_up-{k:06d}.tar" for k in range(len(sizes))]
    assert files_below(out) == ["export.json", *(f"train/{shard.name}" for shard in shards)]
    assert [len(_labels(_members(shard))) for shard in shards] == sizes
    assert list(_labels(_members(*shards))) == KEYS
    record = json.loads((out / "export.json").read_text())
    assert record["request"]["samples_per_shard"] == samples
    assert "link" not in record["request"]


def test_splits_have_shards_of_their_own(place, tmp_path):
    out = _made(place, tmp_path / "x", "--split", "train:0.67,val:0.33", "--samples-per-shard", 2)
    found = {split: sorted((out / split).iterdir()) for split in ("train", "val")}
    assert {split: len(shards) for split, shards in found.items()} == {"train": 3, "val": 2}
    keys = {split: list(_labels(_members(*shards))) for split, shards in found.items()}
    assert sorted(keys["train"] + keys["val"]) == sorted(KEYS)
    clips = {split: {key[:-7] for key in of_split} for split, of_split in keys.items()}
    assert not clips["train"] & clips["val"]
    for of_split in keys.values():
        assert of_split == [key for key in KEYS if key in of_split]


def test_selected_frames(place, tmp_path):
    videos = [{"name": "one", "frames": [1]}, {"name": "three", "frames": [0, 2]}]
    dataset = {"path": "data", "name": "made_up", "videos": videos}
    selection = {"format": "veldt-selection", "version": 1, "datasets": [dataset]}
    out = _made(place, tmp_path / "x", "--selection", place.write("selection.json", selection))
    labels = _labels(_members(out / "train/made_up-000000.tar"))
    assert list(labels) == ["one_000001", "three_000000", "three_000002"]


# --- once more, and stopped -------------------------------------------------------------------------------------------


def test_once_more_there_is_nothing_to_do(place, tmp_path):
    out = _made(place, tmp_path / "x")
    before = (out / "export.json").stat().st_mtime_ns
    for options in ([], ["--samples-per-shard", "1000"], ["--scratch", tmp_path / "scratch"]):
        done = place("export", "data", "--out", out, *FORMAT, *options)
        assert (done.code, done.out) == (0, f"{out}: nothing to do; this export already exists\n")
    assert (out / "export.json").stat().st_mtime_ns == before
    done = place("export", "data", "--out", out, *FORMAT, "--samples-per-shard", 5)
    what = "samples_per_shard is 5 here and 1000 there"
    rule = "expected the same request, or an empty or new folder"
    check_fault(done, 2, f"{out} holds another export: {what}; {rule}")


def _many(veldt) -> None:
    """A COCO file with so many pictures that their progress fills a pipe, which blocks the run until it is read."""
    (veldt.folder / "pictures").mkdir()
    images = [{"id": k, "file_name": f"pictures/{k:05d}.png", "width": 4, "height": 4} for k in range(3000)]
    for image in images:
        (veldt.folder / image["file_name"]).write_bytes(b"a picture")
    veldt.write("many.json", {"images": images, "annotations": [], "categories": []})


def _held(veldt, *options):
    run = veldt.start("export", "many.json", *FORMAT, "--out", "x", "--progress", "json", *options)
    run.stderr.readline()
    return run


@pytest.mark.parametrize("options", [[], ["--scratch", "scratch", "--samples-per-shard", "10"]])
def test_stopped_it_leaves_nothing(veldt, options):
    _many(veldt)
    run = _held(veldt, *options)
    interrupt(run.pid, signal.SIGINT)
    out, err = run.communicate(timeout=PATIENCE_S)
    assert (run.returncode, out) == (128 + signal.SIGINT, "")
    assert err.splitlines()[-1] == "veldt: stopped on request; run the same command again to resume"
    assert not (veldt.folder / "x").exists() and not (veldt.folder / "x.part").exists()
    assert not files_below(veldt.folder / "scratch")


@pytest.mark.parametrize("options", [[], ["--scratch", "scratch"]])
def test_killed_it_starts_again(veldt, options):
    _many(veldt)
    options = [*options, "--samples-per-shard", "10"]
    run = _held(veldt, *options)
    while not list(veldt.folder.glob("x*/train/many-*.tar")):
        run.stderr.readline()
    run.kill()
    run.communicate(timeout=PATIENCE_S)
    assert not (veldt.folder / "x" / "export.json").exists()
    assert bool(options[:-2]) == (veldt.folder / "x").exists()
    out = _made(veldt, "x", *options, source="many.json")
    shards = sorted((out / "train").iterdir())
    assert (len(shards), len(_labels(_members(*shards)))) == (300, 3000)
    assert files_below(veldt.folder / "scratch") == []
    assert not (veldt.folder / "x.part").exists()


# --- object stores ----------------------------------------------------------------------------------------------------


def test_an_object_store_gets_whole_tar_files(place, tmp_path, store):
    bucket, scratch = tmp_path / "bucket", tmp_path / "scratch"
    env = {"LD_PRELOAD": str(store), "OBJECT_STORE": str(bucket)}
    options = ["--samples-per-shard", 4]
    out = _made(place, bucket / "x", "--scratch", scratch, *options, env=env)
    usual = _made(place, tmp_path / "x", *options)
    assert files_below(bucket) == [f"x/{name}" for name in files_below(usual)]
    for name in files_below(usual):
        assert (out / name).read_bytes() == (usual / name).read_bytes()
    assert files_below(scratch) == []


def test_an_object_store_needs_the_scratch_disk(place, tmp_path, store):
    env = {"LD_PRELOAD": str(store), "OBJECT_STORE": str(tmp_path)}
    done = place("export", "data", *FORMAT, "--out", tmp_path / "x", "--quiet", env=env)
    check_fault(done, 1, f"cannot lock {tmp_path}/x.part/.lock: Operation not supported")


def test_scratch_replaces_only_what_an_export_has_left(place, tmp_path):
    usual = _made(place, tmp_path / "usual", "--samples-per-shard", 4)
    shutil.copytree(usual, tmp_path / "x")
    (tmp_path / "x" / "export.json").unlink()
    (tmp_path / "x" / "train" / "made_up-000009.tar").write_bytes(b"of a run with more shards")
    options = ["--scratch", tmp_path / "scratch", "--samples-per-shard", 4]
    out = _made(place, tmp_path / "x", *options)
    assert files_below(out) == files_below(usual)
    (out / "export.json").rename(out / "thesis.txt")
    done = place("export", "data", *FORMAT, "--out", out, *options)
    check_fault(done, 2, f"--out = {out}; expected an empty or new folder")
    assert len(files_below(out)) == 4
