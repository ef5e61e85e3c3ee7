"""Datasets that somebody else has made or changed: no name in them leads a command out of their folder."""

import hashlib
import json

import pytest

import passes
from program import NO_LINKS, check_fault, files_below

FILES = "expected frames.jsonl, labels.json, preview.mp4, ir8/NNNNNN.png and ir16/NNNNNN.png only"
NAME = 'expected a name of at most 200 bytes without "/" or control characters that does not begin with "-"'


@pytest.fixture(name="dataset")
def _dataset(veldt):
    """A dataset of one clip, in foreign/data."""
    folder = passes.write_clip(veldt.folder / "one", "one")
    assert veldt("convert", folder, "--out", "foreign/data", "--quiet").code == 0
    return veldt.folder / "foreign" / "data"


def _sum(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _add_file(dataset, name: str, content: str) -> None:
    """Adds a file to the clip's record, and makes all sums of the dataset right, as an attacker would."""
    record_file, dataset_file = dataset / "clips/one/clip.json", dataset / "dataset.json"
    record, document = json.loads(record_file.read_text()), json.loads(dataset_file.read_text())
    record["files"][name] = _sum(content)
    text = json.dumps(record, indent=2) + "\n"
    document["clips"][0]["record_sha256"] = _sum(text)
    record_file.unlink()
    record_file.write_text(text)
    dataset_file.unlink()
    dataset_file.write_text(json.dumps(document))


def _rename_clip(dataset, name: str) -> None:
    document = json.loads((dataset / "dataset.json").read_text())
    document["clips"][0]["id"] = name
    (dataset / "dataset.json").unlink()
    (dataset / "dataset.json").write_text(json.dumps(document))


COMMANDS = {
    "merge": ["merge", "foreign/data", "--out", "home/merged"],
    "validate": ["validate", "foreign/data"],
    "video": ["video", "foreign/data", "--out", "home/video.mp4"],
    "view": ["view", "foreign/data", "--out", "home/view"],
}


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", ["../../../mine.txt", "/dev/zero", "clip.json"])
def test_a_clip_s_record_names_no_files_but_its_own(veldt, dataset, command, name):
    (veldt.folder / "home").mkdir()
    (veldt.folder / "home" / "mine.txt").write_text("mine")
    (veldt.folder / "foreign" / "mine.txt").write_text("theirs")
    _add_file(dataset, name, "theirs")
    before = files_below(veldt.folder / "home")
    done = veldt(*COMMANDS[command])
    check_fault(done, 1, f'foreign/data/clips/one/clip.json: files = "{name}"; {FILES}')
    assert (veldt.folder / "home" / "mine.txt").read_text() == "mine"
    assert [file for file in files_below(veldt.folder / "home") if "merged" not in file] == before


IDS = {"../../victim": "../../victim", "/tmp": "/tmp", "-rf": "-rf", "..": "..", "a\x1b[2Jb": "a\\u001b[2Jb"}
READERS = COMMANDS | {
    "export": ["export", "foreign/data", "--format", "coco", "--out", "home/coco"],
    "report": ["report", "foreign/data", "--out", "home/report.html"],
    "balance": ["balance", "foreign/data", "--out", "home/chosen.json", "--per-class", "small_animal=0:9"],
}


@pytest.mark.parametrize("command", READERS)
@pytest.mark.parametrize("name", IDS)
def test_ids_of_clips_are_names(veldt, dataset, command, name):
    (veldt.folder / "home").mkdir()
    _rename_clip(dataset, name)
    done = veldt(*READERS[command])
    check_fault(done, 1, f'foreign/data/dataset.json: clips[0].id = "{IDS[name]}"; {NAME}')
    assert files_below(veldt.folder / "home") == []


SHOWS = {"export", "report"}  # pictures, by the names in annotations.json
LINKS = {
    "clips/one/ir8/000001.png": COMMANDS.keys() | SHOWS,
    "clips/one/ir8": COMMANDS.keys() | SHOWS,
    "clips/one/labels.json": COMMANDS.keys(),
    "clips/one/clip.json": COMMANDS.keys(),
    "clips/one": COMMANDS.keys() | SHOWS,
    "clips": READERS.keys(),
    "annotations.json": READERS.keys(),
    "dataset.json": READERS.keys(),
}


@pytest.mark.parametrize("command", READERS)
@pytest.mark.parametrize("link", LINKS)
def test_links_are_not_followed(veldt, dataset, command, link):
    """What a dataset links to is neither read nor handed on, even if it is what the sums say."""
    secret = veldt.folder / "secret"
    (dataset / link).rename(secret)
    (dataset / link).symlink_to(secret)
    (veldt.folder / "home").mkdir()
    done = veldt(*READERS[command], "--progress", "none")
    if command in LINKS[link]:
        assert done.code == 1 and f"foreign/data/{link} = a link to {secret}; {NO_LINKS}\n" in done.err
        assert [file for file in files_below(veldt.folder / "home") if not file.startswith("merged")] == []
    else:
        assert (done.code, done.err) == (0, "")  # that file is not read


@pytest.mark.parametrize("name", ["../secret.png", "/dev/zero"])
def test_a_report_embeds_pictures_of_its_dataset_only(veldt, dataset, name):
    (dataset.parent / "secret.png").write_bytes((dataset / "clips/one/ir8/000000.png").read_bytes())
    labels = json.loads((dataset / "annotations.json").read_text())
    for image in labels["images"]:
        image["file_name"] = name
    (dataset / "annotations.json").write_text(json.dumps(labels))
    done = veldt("report", "foreign/data", "--out", "report.html")
    rule = 'expected a relative path without "..", control characters, or parts that begin with "-" or exceed 200 bytes'
    check_fault(done, 1, f'made_up: file_name of image 1 = "{name}"; {rule}')
    assert not (veldt.folder / "report.html").exists()


@pytest.mark.parametrize("command", READERS)
@pytest.mark.parametrize(
    "place, message",
    [
        ("clips/0/record_sha256", "clips[0].record_sha256 = nothing; expected one"),
        ("clips/0/frames", "clips[0].frames = nothing; expected one"),
        ("config/sensor/kelvin_per_count", "config.sensor.kelvin_per_count = nothing; expected a number"),
    ],
)
def test_a_value_that_dataset_json_lacks_is_named(veldt, dataset, command, place, message):
    document = json.loads((dataset / "dataset.json").read_text())
    *parents, key = [int(part) if part.isdigit() else part for part in place.split("/")]
    entry = document
    for part in parents:
        entry = entry[part]
    del entry[key]
    (veldt.folder / "home").mkdir()
    (dataset / "dataset.json").write_text(json.dumps(document))
    done = veldt(*READERS[command])
    assert done.code == 1 and done.err == f"veldt: foreign/data/dataset.json: {message}\n"
