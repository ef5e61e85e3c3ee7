"""Links inside an output folder, which somebody else may have put there: nothing is written or removed through them."""

import pytest

import fake_blender
from configs import tiny
from fake_blender import generate
from program import NO_LINKS, files_below

PLACES = ["passes", "passes/side", "passes/side/manifest.part", "passes/down/000000.exr", "passes/side.log"]


@pytest.fixture(name="blender")
def _blender(veldt):
    veldt.write("config.json", tiny())
    return fake_blender.install(veldt.folder)


@pytest.fixture(name="home")
def _home(veldt):
    """A folder that no run may touch."""
    home = veldt.folder / "home"
    (home / "side").mkdir(parents=True)
    for name in ("mine.txt", "side/mine.txt"):
        (home / name).write_text("mine")
    return home


def _link(veldt, place: str) -> str:
    """Puts a link into `out`, and returns how it is described."""
    link = veldt.folder / "out" / place
    link.parent.mkdir(parents=True)
    target = veldt.folder / "home" / ("" if place in ("passes", "passes/side", "preview") else "mine.txt")
    link.symlink_to(target)
    return f"out/{place} = a link to {target}"


def _is_untouched(home) -> bool:
    names = ["mine.txt", "side/mine.txt"]
    return files_below(home) == names and all((home / name).read_text() == "mine" for name in names)


@pytest.mark.parametrize("place", PLACES)
def test_passes(veldt, blender, home, place):
    link = _link(veldt, place)
    done = generate(veldt, blender, "--quiet")
    assert (done.code, done.out, done.err) == (1, "", f"veldt: {link.rstrip('/')}; {NO_LINKS}\n")
    assert _is_untouched(home)


@pytest.mark.parametrize("place", ["preview", "preview/map.png", "preview/blender.log"])
def test_previews(veldt, blender, home, place):
    link = _link(veldt, place)
    done = veldt("render", "config.json", "--out", "out", "--preview", "--blender", blender, "--quiet")
    assert (done.code, done.out, done.err) == (1, "", f"veldt: {link.rstrip('/')}; {NO_LINKS}\n")
    assert _is_untouched(home)
