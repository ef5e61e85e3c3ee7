"""The pictures of the pages still show what Veldt draws: by their record, assets/pictures/pictures.json."""

import functools
import hashlib
import json
import re
import shlex
import sys

import pytest

from program import ROOT

sys.path.insert(0, str(ROOT / "assets" / "pictures"))

from draw_pictures import FOLDER, PICTURES, RECORD, main, reworded  # pylint: disable=wrong-import-position

# Shows how fast a machine was, which no run repeats; the page names the machine and the command.
PLOTS_OF_SPEED = {"thermal_core/truth.svg"}

FOLDERS = ("assets", "blender_scripts", "cli", "configs", "tests", "thermal_core")
PAGES = [*ROOT.glob("*.md"), *(page for folder in FOLDERS for page in (ROOT / folder).rglob("*.md"))]


@pytest.fixture(scope="module", name="record")
def _record() -> dict:
    return json.loads(RECORD.read_text(encoding="utf-8"))


@pytest.fixture(scope="module", name="made")
def _made(tmp_path_factory):
    """Makes what pictures show, once for all of them."""
    return functools.cache(lambda shown: shown.make(tmp_path_factory.mktemp("shown") / "made"))


@pytest.mark.parametrize("name", PICTURES)
def test_it_shows_what_veldt_draws(name, record, made):
    for shown in PICTURES[name].shows:
        command = shlex.join(shown.command())
        was, now = record.get(name, {}).get("shows", {}).get(command, {}), made(shown)
        other = [one for one in sorted(was.keys() | now.keys()) if was.get(one) != now.get(one)]
        assert not other, (
            f"assets/pictures/{name} no longer shows what Veldt draws; ./run pictures {name.rsplit('.', 1)[0]} draws it"
            f" again. {command} makes other pixels or figures of {', '.join(other[:4])}{' …' if other[4:] else ''}"
        )


def test_each_picture_is_the_recorded_one(record):
    there = {file.name: file for file in FOLDER.iterdir() if file.suffix in (".jpg", ".png", ".svg")}
    assert set(there) == set(PICTURES) == set(record)
    for name, file in there.items():
        assert hashlib.sha256(file.read_bytes()).hexdigest() == record[name]["sha256"], name


def test_pages_say_of_a_picture_what_is_true(record):
    for name, entry in record.items():
        for page, words in entry["words"].items():
            text = " ".join((ROOT / page).read_text(encoding="utf-8").split())
            assert words in text, f"{page} does not say of {name}: {words}; ./run pictures does"


def test_pages_show_no_other_pictures():
    named = {
        (page.parent / link).resolve().relative_to(ROOT).as_posix()
        for page in PAGES
        for link in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", page.read_text(encoding="utf-8"))
    }
    assert named == {f"assets/pictures/{name}" for name in PICTURES} | PLOTS_OF_SPEED


def test_words_change_and_lines_stay():
    page = "A place\nof 98 actors,\n93,000 plants. More.\n"
    assert (
        reworded(page, "98 actors, 93,000 plants", "9 actors, 12 plants")
        == "A place\nof 9 actors,\n12 plants. More.\n"
    )
    assert reworded(page, "98 actors,", "98 actors,") == page
    with pytest.raises(ValueError, match='expected the words "97 actors"'):
        reworded(page, "97 actors", "98 actors")


def test_an_unknown_picture_is_refused(capsys):
    assert main(["hours", "heath"]) == 2
    assert capsys.readouterr().err.startswith("pictures: unknown picture heath; expected one of demo, ")
