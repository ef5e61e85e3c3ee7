"""Frames on the page of `veldt view`, in a real browser, from a file: colours, kelvin, and what is drawn over them."""

import base64
import json

import numpy as np
import pytest

import passes
from browser import DESKTOP, PHONE
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
WIDTH, HEIGHT = passes.WIDTH, passes.HEIGHT
HUMAN = (0, 229, 255)


@pytest.fixture(scope="module", name="dataset")
def _dataset(tmp_path_factory):
    return make_view(tmp_path_factory.mktemp("data"))


@pytest.fixture(name="page")
def _page(dataset):
    return dataset.parent / "page" / "index.html"


def _palettes(page) -> dict[str, np.ndarray]:
    text = (page.parent / "data" / "dataset.js").read_text(encoding="ascii")
    palettes = json.loads(text[len("takeDataset(") : -3])["palettes"]
    return {
        p["name"]: np.frombuffer(base64.b64decode(p["colours"]), np.uint8).reshape(256, 3) for p in palettes
    }


# --- a frame's pixels -------------------------------------------------------------------------------------------------


def test_frames_are_shown_through_each_palette(browser, page, dataset):
    open_frame(browser, page)
    switch(browser, **NOTHING_OVER)
    levels = counts_of(dataset, "ir8", "down", 0)
    for name, colours in _palettes(page).items():
        choose(browser, "palette", name)
        assert (middles(screen_of(browser)) == colours[levels]).all(), name


def test_palettes_go_from_cold_to_hot_whatever_the_polarity(browser, page, dataset):
    open_frame(browser, page, "side")
    switch(browser, **NOTHING_OVER)
    levels = counts_of(dataset, "ir8", "side", 0)
    assert (middles(screen_of(browser))[..., 0] == 255 - levels).all()


@pytest.mark.parametrize("frame", [0, 1])
def test_every_count_is_decoded(browser, page, dataset, frame):
    open_frame(browser, page, frame=frame)
    for name, kind in (("levels", "ir8"), ("counts", "ir16")):
        assert (
            browser.run(f"return [...shown.{name}]")
            == counts_of(dataset, kind, "down", frame).ravel().tolist()
        )


def test_the_key_of_palettes_goes_through_them(browser, page):
    open_frame(browser, page)
    seen = []
    for _ in range(7):
        seen.append(
            (browser.run("return document.getElementById('palette').value"), screen_of(browser).tobytes())
        )
        browser.press("p")
    assert [name for name, _ in seen] == list(_palettes(page))
    assert len({pixels for _, pixels in seen}) == 7
    assert browser.run("return document.getElementById('palette').value") == "white_hot"


def test_a_fixed_window_spreads_ir16_evenly(browser, page, dataset):
    open_frame(browser, page, frame=1)
    switch(browser, **NOTHING_OVER)
    choose(browser, "source", "window")
    for name, value in (("low_k", 200), ("high_k", 500.5)):
        browser.run(
            f"""const field = document.getElementById("{name}");
            field.value = {value};
            field.dispatchEvent(new Event("input", {{ bubbles: true }}));"""
        )
    counts = counts_of(dataset, "ir16", "down", 1)
    low, high = 200 / 0.01, 500.5 / 0.01
    levels = np.clip(np.floor(256 * (counts - low) / (high - low)), 0, 255)
    # All but the plate that says that the shutter is closed.
    assert (middles(screen_of(browser))[5:, :, 0] == levels[5:]).all()
    assert browser.run("return document.querySelector('.ramp').textContent") == "200.0 K500.5 K"


def test_percentiles_are_those_of_the_frame(browser, page, dataset):
    open_frame(browser, page)
    switch(browser, **NOTHING_OVER)
    browser.press("l")
    assert browser.run("return document.getElementById('source').value") == "percentiles"
    counts = counts_of(dataset, "ir16", "down", 0)
    in_order = np.sort(counts, axis=None)
    low, high = (in_order[int(np.ceil(share * counts.size)) - 1] for share in (0.01, 0.99))
    levels = np.clip(np.floor(256 * (counts - low) / (high - low)), 0, 255)
    assert (middles(screen_of(browser))[..., 0] == levels).all()


def _place_on_screen(browser, x: int, y: int) -> tuple[float, float]:
    """Where the middle of a pixel of the frame is in the window."""
    left, top, width, height = browser.run(
        """const { left, top, width, height } = document.getElementById("screen").getBoundingClientRect();
        return [left, top, width, height];"""
    )
    return left + (x + 0.5) * width / WIDTH, top + (y + 0.5) * height / HEIGHT


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("frame", [0, 1])
def test_kelvin_at_the_pointer_are_those_of_ir16(browser, page, dataset, frame, size):
    """Exactly, for counts of all 16 bits behind all filters of PNG."""
    open_frame(browser, page, frame=frame, size=SIZES[size])
    counts = counts_of(dataset, "ir16", "down", frame)
    levels = counts_of(dataset, "ir8", "down", frame)
    for x, y in [
        (0, 0),
        (1, 0),
        (2, 0),
        (23, 0),
        (0, 15),
        (23, 15),
        (9, 7),
        (13, 1),
        (5, 13),
        (17, 9),
        (12, 4),
    ]:
        browser.point(*_place_on_screen(browser, x, y))
        browser.wait_for(f'document.getElementById("place").textContent.startsWith("x {x}, y {y} ·")')
        shown = browser.run("return ['kelvin', 'place'].map((id) => document.getElementById(id).textContent)")
        assert shown == [
            f"{counts[y, x] * 0.01:.2f} K",
            f"x {x}, y {y} · ir16 {counts[y, x]} · ir8 {levels[y, x]}",
        ]


def test_the_target_at_the_pointer_is_named(browser, page, dataset):
    open_frame(browser, page)
    document = json.loads((dataset / "clips" / "down" / "labels.json").read_text(encoding="utf-8"))
    walker = document["annotations"][0]
    assert walker["track_id"] == 7 and walker["bbox"] == [8, 5, 2, 4]
    browser.point(*_place_on_screen(browser, 9, 6))
    browser.wait_for('document.getElementById("place").textContent.startsWith("x 9, y 6 ·")')
    contrast = f"{abs(walker['contrast_k']):.1f}"
    sign = "−" if walker["contrast_k"] < 0 else "+"
    parts = ["human 7", "78.3 m away", f"{walker['temperature_k']:.1f} K"]
    parts.append(f"{sign}{contrast} K against its surroundings")
    assert browser.run("return document.getElementById('under').innerText") == " · ".join(parts)
    browser.point(*_place_on_screen(browser, 20, 6))
    browser.wait_for('document.getElementById("under").innerText === "no target"')


def test_the_crosshair_moves_by_keys(browser, page):
    open_frame(browser, page)
    browser.press("shift+ARROW_RIGHT", "shift+ARROW_UP")
    assert browser.run("return document.getElementById('place').textContent").startswith("x 13, y 7 ·")
    browser.press(*["shift+ARROW_LEFT"] * 15)
    assert browser.run("return document.getElementById('place').textContent").startswith("x 0, y 7 ·")


# --- over it ----------------------------------------------------------------------------------------------------------


def _extent(mask: np.ndarray) -> list[int]:
    """First column, first row, last column, last row."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return [columns[0], rows[0], columns[-1], rows[-1]]


def _coloured(browser, colour) -> np.ndarray:
    return (np.abs(screen_of(browser) - colour) <= 2).all(axis=2)


@pytest.mark.parametrize("frame", [0, 2])
def test_boxes_lie_where_labels_have_them(browser, page, dataset, frame):
    """The line is 2 px wide, and its inner edge is the box's; a box that ends within a pixel of the screen mixes
    there, which moves an extent by one pixel at most."""
    open_frame(browser, page, frame=frame)
    switch(browser, names=False, tracks=False, boxes=True)
    document = json.loads((dataset / "clips" / "down" / "labels.json").read_text(encoding="utf-8"))
    (walker,) = (
        a
        for a in document["annotations"]
        if a["track_id"] == 7 and a["image_id"] == document["images"][frame]["id"]
    )
    x, y, width, height = walker["bbox"]
    assert (x, width) == (8 + frame, 2 if frame == 0 else 2)
    screen = _coloured(browser, HUMAN)
    scale = screen.shape[1] / WIDTH
    expected = [x * scale - 2, y * scale - 2, (x + width) * scale + 1, (y + height) * scale + 1]
    assert _extent(screen) == pytest.approx(expected, abs=1)
    inside = screen[
        int(y * scale) + 1 : int((y + height) * scale) - 1, int(x * scale) + 1 : int((x + width) * scale) - 1
    ]
    assert not inside.any()
    browser.press("b")
    assert not _coloured(browser, HUMAN).any()


def test_masks_names_and_tracks_have_their_keys(browser, page):
    open_frame(browser, page, frame=2)
    switch(browser, **NOTHING_OVER)
    plain = screen_of(browser)
    scale = plain.shape[1] / WIDTH
    extents = {}
    for name, key in (("names", "a"), ("tracks", "t"), ("masks", "m")):
        browser.press(key)
        assert browser.run(f"return document.getElementById('{name}').checked")
        changed = (screen_of(browser) != plain).any(axis=2)
        extents[name] = _extent(changed)
        browser.press(key)
        assert (screen_of(browser) == plain).all()
    # The walker's mask is at x 10 to 12, y 5 to 7, above a shrub; the elephant's at the left edge, y 10 to 14. A dark
    # line of 2 px lies on the outlines, so its ends are 1 px outside of them, and up to a pixel is mixed.
    expected = [0, 5 * scale - 1, 12 * scale, 14 * scale]
    assert extents["masks"] == pytest.approx(expected, abs=1)
    x, y = (np.arange(start, stop) * scale for start, stop in ((10, 13), (5, 8)))
    assert changed[
        int((y[0] + y[1]) / 2), int(x[2]) - 1 : int(x[2]) + 1
    ].any()  # its right side, of the upper pixel
    assert not changed[int(y[0]) + 3 : int(y[2]) - 3, int(x[0]) + 3 : int(x[2]) - 3].any()  # nothing within
    # His track comes from the left and ends at his box, 2 px wide with a dark line of 4 px below it.
    left, top, right, bottom = extents["tracks"]
    assert 9 * scale - 3 <= left < 9.5 * scale and right <= 10 * scale
    assert 5 * scale < top and bottom < 8 * scale
    assert extents["names"][1] < 5 * scale  # above the box


def test_zoom_shows_a_part_and_keeps_its_pixels(browser, page, dataset):
    open_frame(browser, page)
    switch(browser, **NOTHING_OVER)
    browser.press("+")  # at the middle: x 6 to 18, y 4 to 12
    assert browser.run("return document.getElementById('zoom').textContent") == "zoom 2×"
    screen = screen_of(browser)
    scale = screen.shape[1] / 12
    rows, columns = (((np.arange(n) + 0.5) * scale).astype(int) for n in (8, 12))
    levels = counts_of(dataset, "ir8", "down", 0)[4:12, 6:18]
    assert (screen[np.ix_(rows, columns)][..., 0] == levels).all()
    browser.press("-")
    assert (middles(screen_of(browser))[..., 0] == counts_of(dataset, "ir8", "down", 0)).all()


def test_a_closed_shutter_is_said(browser, page):
    open_frame(browser, page, frame=1)
    assert "shutter closed" in browser.run("return document.getElementById('caption').textContent")
    assert _coloured(browser, (255, 196, 0)).any()
    browser.press("HOME")
    wait_for_frame(browser, "down", 0)
    assert "shutter closed" not in browser.run("return document.getElementById('caption').textContent")
    assert not _coloured(browser, (255, 196, 0)).any()
