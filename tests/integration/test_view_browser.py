"""The page of `veldt view` in a real browser, from a file: scrubbing, playing, links, and legible at every size."""

import pytest

import passes
from browser import DESKTOP, PHONE
from legibility import CONTRAST, TARGETS
from program import Veldt
from reports import change
from view_page import (
    NOTHING_OVER,
    choose,
    counts_of,
    make_view,
    middles,
    open_frame,
    screen_of,
    switch,
    wait_for_frame,
)

SIZES = {"desktop": DESKTOP, "phone": PHONE}


@pytest.fixture(scope="module", name="dataset")
def _dataset(tmp_path_factory):
    return make_view(tmp_path_factory.mktemp("data"))


@pytest.fixture(name="page")
def _page(dataset):
    return dataset.parent / "page" / "index.html"


# --- from frame to frame ----------------------------------------------------------------------------------------------


def test_keys_scrub_and_the_address_follows(browser, page, dataset):
    browser.open(page)
    wait_for_frame(browser, "down", 0)
    switch(browser, **NOTHING_OVER)
    presses = [("ARROW_RIGHT", 1), ("ARROW_RIGHT", 2), ("ARROW_RIGHT", 2), ("ARROW_LEFT", 1), ("HOME", 0)]
    for key, frame in [*presses, ("END", 2), ("PAGE_UP", 0)]:
        browser.press(key)
        wait_for_frame(browser, "down", frame)
        browser.wait_for(f'location.hash === "#clip=down&frame={frame}"')
        assert browser.run("return document.getElementById('slider').valueAsNumber") == frame
        if frame != 1:
            assert (middles(screen_of(browser))[..., 0] == counts_of(dataset, "ir8", "down", frame)).all()
    browser.press("]")
    wait_for_frame(browser, "side", 0)
    browser.wait_for('location.hash === "#clip=side&frame=0"')
    current = browser.run("return document.querySelector('#clips [aria-current]').textContent")
    assert current.startswith("side") and "3 frames · 2 targets (human 1, elephant 1)" in current
    assert browser.complaints() == []


def test_the_slider_has_the_keys_of_sliders(browser, page):
    open_frame(browser, page)
    browser.run("document.getElementById('slider').focus()")
    browser.press("ARROW_RIGHT")
    wait_for_frame(browser, "down", 1)
    browser.press("END")
    wait_for_frame(browser, "down", 2)
    assert browser.run("return document.getElementById('slider').getAttribute('aria-valuetext')").startswith(
        "frame 2,"
    )


def test_a_link_leads_to_its_frame(browser, page):
    open_frame(browser, page, "side", 2)
    assert browser.run("return document.getElementById('link').getAttribute('href')") == "#clip=side&frame=2"
    browser.run("location.hash = '#clip=down&frame=1'")
    wait_for_frame(browser, "down", 1)
    browser.run("location.hash = '#clip=nowhere&frame=1'")
    browser.wait_for('!document.getElementById("fault").hidden')
    assert (
        browser.run("return document.getElementById('fault').textContent") == "There is no clip nowhere here."
    )


@pytest.fixture(scope="module", name="odd")
def _odd(tmp_path_factory):
    """The page of one clip of 12 frames without labels, of which 4 to 6 were skipped, with a name of others."""
    veldt = Veldt(tmp_path_factory.mktemp("odd"))
    folder = passes.write_clip(veldt.folder / "one", "one", 12)
    for frame in (4, 5, 6):
        (folder / f"{frame:06d}.exr").unlink()
    assert veldt("convert", folder, "--out", "out", "--quiet").code == 3
    clips = veldt.folder / "out" / "clips"
    change(clips / "one" / "labels.json", lambda document: document.update(annotations=[]))
    (clips / "one").rename(clips / "a b&c#d")
    change(veldt.folder / "out" / "dataset.json", lambda record: record["clips"][0].update(id="a b&c#d"))
    done = veldt("view", "out", "--out", "page", "--quiet")
    assert (done.code, done.err) == (0, "")
    return veldt.folder / "page" / "index.html"


# A clock of the page that advances on request.
CLOCK = """
let now_ms = 0, waiting = [];
performance.now = () => now_ms;
window.requestAnimationFrame = (callback) => waiting.push(callback);
window.passTo = (ms) => { now_ms = ms; for (const callback of waiting.splice(0)) callback(now_ms); };
"""


def test_space_plays_at_the_rate_of_the_clip(browser, odd):
    """12 frames at 9 Hz, of which 4 to 6 were skipped; each is shown when it is due, and not before."""
    browser.open(odd)
    wait_for_frame(browser, "a b&c#d", 0)
    browser.run(CLOCK)
    browser.press(" ")
    assert browser.run("return document.getElementById('play').textContent") == "Pause"
    there = [0, 1, 2, 3, 7, 8, 9, 10, 11]
    shown = [max(k for k in there if k <= frame) for frame in range(12)]
    for frame in range(1, 12):
        for off_ms, due in ((-1, shown[frame - 1]), (1, shown[frame])):
            browser.run(f"passTo({1000 * frame / 9 + off_ms})")
            assert browser.run("return document.getElementById('slider').valueAsNumber") == there.index(due)
            wait_for_frame(browser, "a b&c#d", due)
    browser.wait_for('document.getElementById("play").textContent === "Play"')
    browser.wait_for('location.hash === "#clip=a+b%26c%23d&frame=11"')
    assert browser.complaints() == []


def test_skipped_frames_are_passed_over(browser, odd):
    browser.open(odd, fragment="#clip=a+b%26c%23d&frame=3")
    wait_for_frame(browser, "a b&c#d", 3)
    browser.press("ARROW_RIGHT")
    wait_for_frame(browser, "a b&c#d", 7)
    assert browser.run("return document.getElementById('meanings').innerText") == "frames skipped"
    browser.run("location.hash = '#clip=a+b%26c%23d&frame=5'")  # held by the one before
    wait_for_frame(browser, "a b&c#d", 3)
    assert "There are no labels in this frame." in browser.run("return document.body.innerText")


def test_a_frame_that_is_lost_is_named(browser, odd):
    file = odd.parent / "data" / "a b&c#d" / "000002.js"
    content = file.read_bytes()
    browser.open(odd)
    wait_for_frame(browser, "a b&c#d", 0)
    file.unlink()
    browser.press("ARROW_RIGHT", "ARROW_RIGHT")
    browser.wait_for('!document.getElementById("fault").hidden')
    assert browser.run("return document.getElementById('fault').textContent") == (
        "Frame 2 of a b&c#d cannot be shown: cannot read data/a%20b%26c%23d/000002.js"
    )
    file.write_bytes(content)
    browser.press("ARROW_LEFT", "ARROW_RIGHT")
    wait_for_frame(browser, "a b&c#d", 2)
    browser.wait_for('document.getElementById("fault").hidden')


# --- for everybody ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
def test_it_fits_is_legible_and_nothing_complains(browser, page, size, scheme):
    open_frame(browser, page, frame=1, size=SIZES[size], scheme=scheme)
    choose(browser, "source", "window")
    width = SIZES[size][0]
    assert browser.run("return [document.documentElement.scrollWidth, innerWidth]") == [width] * 2
    assert browser.run(CONTRAST) >= 4.5
    targets = browser.run(TARGETS)
    assert targets["count"] >= 10 and targets["overlaps"] == [] and targets["small"] == []
    assert browser.complaints() == []


def test_everything_has_a_name_and_shows_the_focus(browser, page):
    open_frame(browser, page)
    names = browser.names()
    assert len(names) > 15 and all(name for role, name in names), names
    visited = []
    for _ in range(40):
        browser.press("TAB")
        tag, outline, width = browser.run(
            """const at = document.activeElement;
            const { outlineStyle, outlineWidth } = getComputedStyle(at);
            return [at.id || at.className || at.tagName, outlineStyle, parseFloat(outlineWidth)];"""
        )
        if tag == "BODY":
            break
        assert outline == "solid" and width >= 2, tag
        visited.append(tag)
    assert {"slider", "play", "number", "link", "palette", "source", "boxes", "closer"} <= set(visited)


def test_the_help_names_every_key(browser, page):
    open_frame(browser, page)
    keys = browser.run("return [...document.querySelectorAll('#keys kbd')].map((key) => key.textContent)")
    arrows = ["←", "→", "Page Up", "Page Down", "Home", "End", "Space", "[", "]"]
    assert keys == [*arrows, "N", "B", "A", "T", "M", "P", "L", "+", "−", "Shift + arrow"]
