"""No command opens a file outside of what it was given: every opening, as the kernel resolved it, seen by strace."""

import json
import re
import shutil
from pathlib import Path

import pytest

import passes
from program import PROGRAM, ROOT

# "openat(AT_FDCWD</tmp/x>, "one", …) = 4</tmp/x/one>": where an opening ended, links followed.
OPENED = re.compile(r"\b(?:open|openat|openat2|creat)\(.* = \d+<(.*)>$")
# The program, its libraries and settings of the system; none of these names comes from a dataset.
SYSTEM = ("/usr/", "/lib/", "/lib64/", "/etc/", "/proc/", "/sys/", "/dev/null", "/dev/urandom", "/dev/shm/")
OURS = (str(ROOT / "assets"), str(ROOT / "configs"), str(PROGRAM.parents[1]))


@pytest.fixture(name="traced")
def _traced(veldt):
    """traced(arguments…) -> how it ended, and the places that were opened in or beside the working folder."""
    (veldt.folder / "scratch").mkdir()
    # OpenImageIO 2.5 lists the user's folders when it draws text, in search of fonts.
    home = veldt.folder.parent / "home"
    home.mkdir(exist_ok=True)
    log = veldt.folder.parent / "strace.log"

    def run(*arguments):
        under = (
            "strace",
            "-f",
            "-y",
            "-qq",
            "-s",
            "4096",
            "-e",
            "trace=open,openat,openat2,creat",
            "-o",
            str(log),
        )
        env = {"HOME": str(home), "TMPDIR": str(veldt.folder / "scratch"), "ASAN_OPTIONS": "detect_leaks=0"}
        done = veldt(*arguments, env=env, under=under)
        places = {match[1] for line in log.read_text().splitlines() if (match := OPENED.search(line))}
        assert places, "strace saw nothing"
        ignored = SYSTEM + OURS + (str(home),)
        return done, {place for place in places if not f"{place}/".startswith(ignored)}

    return run


@pytest.fixture(name="place")
def _place(veldt):
    """A dataset, its passes, and a folder that nothing names."""
    passes.write_clip(veldt.folder / "passes")
    assert veldt("convert", "passes", "--out", "set", "--quiet").code == 0
    secret = veldt.folder / "secret"
    shutil.copytree(veldt.folder / "set", secret)
    (secret / "key.png").write_bytes((secret / "clips/one/ir8/000000.png").read_bytes())
    return veldt


COMMANDS = {
    "validate": (["validate", "set"], ["set"]),
    "convert": (["convert", "passes", "--out", "out"], ["passes", "out"]),
    "merge": (["merge", "set", "--out", "out"], ["set", "out"]),
    "export coco": (["export", "set", "--format", "coco", "--out", "out"], ["set", "out", "out.part"]),
    "export yolo": (["export", "set", "--format", "yolo", "--out", "out"], ["set", "out", "out.part"]),
    "export mot": (["export", "set", "--format", "mot", "--out", "out"], ["set", "out", "out.part"]),
    "report": (["report", "set", "--out", "out.html"], ["set", "out.html", "scratch"]),
    "video": (["video", "set", "--out", "out.mp4"], ["set", "out.mp4"]),
    "view": (["view", "set", "--out", "out"], ["set", "out", "out.part"]),
}


def _outside(places: set[str], folder: Path, given: list[str]) -> set[str]:
    """Those of the places that are in none of the given files and folders, nor beside a file as its temporary name."""
    inside = [str(folder / name) for name in given]
    own = {str(folder), *inside, *(f"{name}.tmp" for name in inside)}
    return {
        place for place in places if place not in own and not place.startswith(tuple(f"{n}/" for n in inside))
    }


@pytest.mark.parametrize("name", COMMANDS)
def test_nothing_else_is_opened(place, traced, name):
    arguments, given = COMMANDS[name]
    done, places = traced(*arguments, "--quiet")
    assert (done.code, done.err) == (0, "")
    assert _outside(places, place.folder, given) == set()


def _link(folder: Path, name: str) -> None:
    """In place of a file or folder of the dataset: a link to the same one in the folder that nothing names."""
    target = folder / "secret" / name
    there = folder / "set" / name
    if there.is_dir():
        shutil.rmtree(there)
    else:
        there.unlink()
    there.symlink_to(target)


def _rename_picture(folder: Path, name: str) -> None:
    file = folder / "set" / "annotations.json"
    labels = json.loads(file.read_text())
    labels["images"][0]["file_name"] = name
    file.write_text(json.dumps(labels))


def _rename_file(folder: Path, name: str) -> None:
    file = folder / "set" / "clips" / "one" / "clip.json"
    record = json.loads(file.read_text())
    record["files"][name] = next(iter(record["files"].values()))
    file.write_text(json.dumps(record))


def _rename_clip(folder: Path, name: str) -> None:
    file = folder / "set" / "dataset.json"
    dataset = json.loads(file.read_text())
    dataset["clips"][0]["id"] = name
    file.write_text(json.dumps(dataset))


TRAPS = {
    "annotations linked": lambda folder: _link(folder, "annotations.json"),
    "clips linked": lambda folder: _link(folder, "clips"),
    "a clip linked": lambda folder: _link(folder, "clips/one"),
    "a record linked": lambda folder: _link(folder, "clips/one/clip.json"),
    "pictures linked": lambda folder: _link(folder, "clips/one/ir8"),
    "a picture linked": lambda folder: _link(folder, "clips/one/ir8/000000.png"),
    "a picture above": lambda folder: _rename_picture(folder, "../secret/key.png"),
    "a picture by its whole path": lambda folder: _rename_picture(folder, str(folder / "secret" / "key.png")),
    "a file above": lambda folder: _rename_file(folder, "../../../secret/key.png"),
    "a clip above": lambda folder: _rename_clip(folder, "../../secret/clips/one"),
}


@pytest.mark.parametrize("trap", TRAPS)
def test_no_trap_leads_to_a_folder_that_nobody_named(place, traced, trap):
    TRAPS[trap](place.folder)
    refused = 0
    for name, (arguments, given) in COMMANDS.items():
        if name == "convert":
            continue  # it reads no dataset
        done, places = traced(*arguments, "--quiet")
        refused += done.code != 0
        assert _outside(places, place.folder, given) == set(), name
    assert refused


def test_an_opening_outside_is_seen(place, traced):
    """So that the tests above can fail: through a link that the user names, and by name."""
    (place.folder / "alias").symlink_to(place.folder / "secret")
    for name in ("secret", "alias"):
        done, places = traced("validate", name)
        assert done.code == 0
        assert str(place.folder / "secret" / "dataset.json") in _outside(places, place.folder, ["set"])
