"""The page of a comparison in a real browser: no console messages, all charts drawn, and legible on a phone."""

import numpy as np
import pytest

from browser import DESKTOP, PHONE
from pictures import write_grey
from program import Veldt

# Canvases that show more than one colour.
_DRAWN = """
return [...document.querySelectorAll("canvas")].map((canvas) => {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  return new Set(Array.from({ length: data.length / 4 }, (_, k) => data[4 * k] + 256 * data[4 * k + 1])).size > 5;
});
"""


def _write(veldt: Veldt, folder: str, labels: bool) -> None:
    (veldt.folder / folder).mkdir()
    noise = np.random.default_rng(len(folder))
    names = [f"<b>{k}<b>.png" for k in range(5)]
    for name in names:
        frame = noise.normal(90, 4, (96, 128))
        frame[30:48, 40:52] += 80
        write_grey(veldt.folder / folder / name, frame.astype(np.uint8))
    if labels:
        images = [{"id": k, "file_name": name, "width": 128, "height": 96} for k, name in enumerate(names)]
        boxes = [{"id": k, "image_id": k, "category_id": 0, "bbox": [39, 29, 14, 20]} for k in range(5)]
        document = {"images": images, "annotations": boxes, "categories": [{"id": 0, "name": "person"}]}
        veldt.write(f"{folder}/annotations.json", document)


@pytest.mark.parametrize("labels", [True, False])
def test_the_page_is_drawn(browser, tmp_path, labels):
    veldt = Veldt(tmp_path)
    _write(veldt, "real", labels)
    _write(veldt, "made", labels)
    assert veldt("compare", "real", "made", "--html", "page.html", "--quiet").code == 0
    for size, scheme in ((DESKTOP, "light"), (PHONE, "dark")):
        browser.open(veldt.folder / "page.html", size, scheme)
        assert browser.run(_DRAWN) == [True, True]
        assert browser.run("return document.documentElement.scrollWidth") <= size[0]
        shown = browser.run("return [...document.querySelectorAll('section')].map((part) => part.id)")
        parts = ["measures", "spectrum", "levels", "frames", "targets", "classifier", "boxes"]
        assert shown == [part for part in parts if labels or part not in ("targets", "boxes")]
        assert browser.run("return document.querySelectorAll('main b').length") == 0
        assert browser.complaints() == []
