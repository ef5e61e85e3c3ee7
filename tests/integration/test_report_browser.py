"""A report in a real browser: no console messages, all charts drawn, and legible on desktops and phones."""

import numpy as np
import pytest

from browser import DESKTOP, PHONE
from legibility import CONTRAST, TARGETS
from program import Veldt
from reports import change, flown_config, make_dataset

SIZES = {"desktop": DESKTOP, "phone": PHONE}
SECTIONS = ["frames", "labels", "distributions", "places", "flights", "clips", "physics", "provenance"]
# Chart.js's canvases: counts, six histograms, terms.
CHARTS = 8


def _enrich(document: dict) -> None:
    """Add labels of ten categories with all properties that a label can have."""
    names = [
        "human",
        "elephant",
        "lion",
        "giraffe",
        "zebra",
        "rhinoceros",
        "impala",
        "hippopotamus",
        "crocodile",
    ]
    document["categories"] = [
        {"id": k + 1, "name": name} for k, name in enumerate([*names, "a_<b>bold</b>_one"])
    ]
    rng = np.random.Generator(np.random.PCG64(5))
    labels = [dict(annotation) for annotation in document["annotations"] * 20]
    for number, annotation in enumerate(labels):
        annotation["id"] = number + 1
        annotation["category_id"] = number % 10 + 1
        annotation["track_id"] = 100 + number
        visibility = float(rng.uniform(0.2, 1))
        annotation |= {"visibility": visibility, "occluded": visibility < 0.9, "ignore": visibility < 0.4}
        annotation |= {"contrast_k": float(rng.normal(4, 3)), "contrast_noise": float(rng.lognormal(2, 1))}
        annotation |= {"range_m": float(rng.normal(70, 9)), "temperature_k": float(rng.normal(293, 3))}
    document["annotations"] = labels


def _weigh(record: dict) -> None:
    for number, term in enumerate(record["physics"]["terms"]):
        term |= {"choice": "auto", "spread_mk": 10.0**number / 50, "kept": number > 2}
    record["config"]["labels"] = {"occluded_below_visibility": 0.9, "ignore_below_visibility": 0.4}


@pytest.fixture(scope="module", name="full")
def _full(tmp_path_factory):
    """The page of a dataset that has everything."""
    veldt = Veldt(tmp_path_factory.mktemp("full"))
    dataset = make_dataset(veldt, flown_config())
    change(dataset / "annotations.json", _enrich)
    change(dataset / "dataset.json", _weigh)
    done = veldt("report", "out", "--quiet")
    assert (done.code, done.err) == (0, "")
    return dataset / "report.html"


@pytest.fixture(scope="module", name="bare")
def _bare(tmp_path_factory):
    """The page of a dataset without a clip, poses, labels and the budget."""
    veldt = Veldt(tmp_path_factory.mktemp("bare"))
    dataset = make_dataset(veldt)
    change(dataset / "annotations.json", lambda document: document.update(annotations=[]))

    def lose(record: dict) -> None:
        record.pop("physics")
        record["status"] = "unfinished"
        record["clips"].append({"id": "third" * 20, "status": "failed", "reason": "no <i>room</i> left"})

    change(dataset / "dataset.json", lose)
    done = veldt("report", "out", "--quiet", "--unfinished")
    assert (done.code, done.err) == (0, "")
    return dataset / "report.html"


# --- it is drawn ------------------------------------------------------------------------------------------------------

# Share of a canvas's pixels that are not transparent, and how many colours there are.
_CANVASES = """
return [...document.querySelectorAll("canvas")].map((canvas) => {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const colours = new Set();
  for (let at = 0; at < data.length; at += 4) if (data[at + 3] > 250) colours.add((data[at] << 16) + (data[at + 1] << 8) + data[at + 2]);
  return { colours: colours.size, bars: Chart.getChart(canvas).data.datasets.flatMap((set, k) =>
    Chart.getChart(canvas).getDatasetMeta(k).data.map((bar) => bar.getProps(["width", "height"])))
    .filter(({ width, height }) => width >= 1 && height >= 1).length };
});
"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
def test_nothing_complains_and_every_chart_is_drawn(browser, full, size, scheme):
    browser.open(full, SIZES[size], scheme)
    canvases = browser.run(_CANVASES)
    assert browser.complaints() == []
    assert len(canvases) == CHARTS
    for canvas in canvases:
        assert canvas["colours"] > 5 and canvas["bars"] >= 3, canvases


def test_all_sections_are_there_and_text_stays_text(browser, full):
    browser.open(full)
    assert browser.run("return [...document.querySelectorAll('section')].map((s) => s.id)") == SECTIONS
    assert browser.run("return document.querySelectorAll('main b:not(figcaption b), main i').length") == 0
    assert "unknown" not in browser.run("return document.querySelector('#labels').textContent")
    assert "a <b>bold</b> one" in browser.run("return document.querySelector('#labels').textContent")


def test_frames_show_their_boxes(browser, full):
    browser.open(full)
    shown = browser.run(
        """return [...document.querySelectorAll("#frames figure")].map((figure) => ({
          width: figure.querySelector("img").naturalWidth,
          boxes: figure.querySelectorAll("rect.box").length, dashed: figure.querySelectorAll("rect.ignored").length,
          titles: [...figure.querySelectorAll("rect.box title")].map((title) => title.textContent) }));"""
    )
    assert len(shown) == 4 and all(figure["width"] == 24 for figure in shown)
    assert sum(figure["boxes"] for figure in shown) > 8 and sum(figure["dashed"] for figure in shown) > 0
    assert all("% visible" in title for figure in shown for title in figure["titles"])


def test_boxes_lie_on_what_they_label(browser, full):
    """On the screen, the elephant's box is where its pixels are in the picture: x 0 to 5 of 24, y 10 to 14 of 16."""
    browser.open(full)
    picture, box = browser.run(
        """const figure = document.querySelector("#frames figure");
        const place = ({ left, top, width, height }) => [left, top, width, height];
        const box = [...figure.querySelectorAll("rect.box")].find((rect) => rect.getAttribute("y") === "10");
        return [figure.querySelector("img"), box].map((node) => place(node.getBoundingClientRect()));"""
    )
    left, top, width, height = picture
    expected = [left, top + height * 10 / 16, width * 5 / 24, height * 4 / 16]
    assert box == pytest.approx(expected, abs=3)  # the line is 2 px wide, half of it outside


def test_a_frame_can_be_enlarged_and_boxes_taken_off(browser, full):
    browser.open(full)
    before, wide, again = browser.run(
        """const button = document.querySelector("#frames button");
        const width = () => button.getBoundingClientRect().width;
        const widths = [width()];
        for (let k = 0; k < 2; ++k) { button.click(); widths.push(width()); }
        return widths;"""
    )
    assert wide > 1.8 * before and again == before
    visible = browser.run(
        """document.querySelector("#frames input").click();
        return getComputedStyle(document.querySelector("#frames .frame svg")).display;"""
    )
    assert visible == "none"


def test_tracks_lie_where_the_map_has_them(browser, full):
    """`down` starts at (20, -10): in the picture, at its share of the window east, and north is up."""
    browser.open(full)
    found = browser.run(
        """const { flights } = JSON.parse(document.getElementById("figures").textContent);
        const { west_m, south_m, side_m } = flights.map.window;
        const ground = document.querySelector(".map image").getBoundingClientRect();
        const dots = [...document.querySelectorAll(".map circle")].map((dot) => dot.getBoundingClientRect());
        const heights = (name) => {
          const { top, bottom } = document.querySelector(`.map ${name}`).getBoundingClientRect();
          return [top, bottom];
        };
        return {
          window: [west_m, south_m, side_m], ground: [ground.left, ground.bottom, ground.width], dots: dots.length,
          dot: [dots[0].left + dots[0].width / 2, dots[0].top + dots[0].height / 2],
          line: heights(".track"), seen: heights(".seen"),
        };"""
    )
    (left, bottom, width), (west_m, south_m, side_m) = found["ground"], found["window"]
    east, north = (20 - west_m) / side_m, (-10 - south_m) / side_m
    assert found["dots"] == 2
    assert found["dot"] == pytest.approx([left + east * width, bottom - north * width], abs=1)
    # Flown north as far as (20, 0); the line's ends are round.
    expected = [bottom - share * width for share in (-south_m / side_m, north)]
    assert found["line"] == pytest.approx(expected, abs=3)
    # It sees 10.67 m south and north of the middle frame, at -5 m.
    expected = [bottom - (north + reach_m / side_m) * width for reach_m in (15.67, -5.67)]
    assert found["seen"] == pytest.approx(expected, abs=2)


def test_the_heat_map_has_marks(browser, full):
    browser.open(full)
    fills = browser.run(
        "return [...document.querySelectorAll('.heat svg[role] rect')].map((r) => r.getAttribute('fill'))"
    )
    assert len(fills) == 40 * 27 and len(set(fills)) > 4


def test_what_is_missing_is_said(browser, bare):
    browser.open(bare)
    assert browser.complaints() == []
    text = browser.run("return document.body.innerText")
    assert (
        f"This dataset is unfinished: 1 of 3 clips is missing: {'third' * 20} (failed: no <i>room</i> left). "
        "All figures describe the other clips." in text
    )
    assert text.count("There are no labels.") == 2
    assert "The passes of this dataset have no camera poses." in text
    assert "The dataset does not state which physical terms it includes." in text
    assert browser.run("return document.querySelectorAll('canvas').length") == 0


# --- it can be read ---------------------------------------------------------------------------------------------------

_SMALL_TEXT = """
const shown = (node) => node.checkVisibility?.() ?? true;
const texts = [...document.querySelectorAll("body *")].filter((node) => shown(node) && !["SCRIPT", "STYLE", "TITLE", "title"].includes(node.tagName)
  && [...node.childNodes].some((child) => child.nodeType === 3 && child.data.trim()));
return { least: Math.min(Chart.defaults.font.size, ...texts.map((node) => parseFloat(getComputedStyle(node).fontSize))), texts: texts.length };
"""


@pytest.mark.parametrize("page", ["full", "bare"])
@pytest.mark.parametrize("size", SIZES)
def test_it_fits_and_is_legible(browser, request, page, size):
    browser.open(request.getfixturevalue(page), SIZES[size])
    browser.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    width = SIZES[size][0]
    assert (
        browser.run("return [document.documentElement.scrollWidth, innerWidth, visualViewport.width]")
        == [width] * 3
    )
    text = browser.run(_SMALL_TEXT)
    assert text["texts"] > 30 and text["least"] >= 12
    targets = browser.run(TARGETS)
    assert targets["count"] >= 10 and targets["overlaps"] == [] and targets["small"] == []


@pytest.mark.parametrize("page", ["full", "bare"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_stands_out(browser, request, page, scheme):
    browser.open(request.getfixturevalue(page), DESKTOP, scheme)
    assert browser.run(CONTRAST) >= 4.5


def test_wide_tables_scroll_in_themselves(browser, full):
    browser.open(full, PHONE)
    inner = browser.run(
        "return [...document.querySelectorAll('.scroll')].map((t) => [t.scrollWidth > t.clientWidth, t.clientWidth])"
    )
    assert any(scrolls for scrolls, _ in inner)
    assert all(width < PHONE[0] for _, width in inner)
