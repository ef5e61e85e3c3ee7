"""Lens distortion in `convert`: pictures and labels are distorted alike, and the camera is stored with the labels."""

import numpy as np
import pytest

import passes
from labels import check_labels
from pictures import read_grey, write_exr

WIDTH, HEIGHT, OVERSCAN = 48, 40, 8
LENS = {"k1": -0.4, "k2": 0.1, "p1": 0.004, "p2": -0.003, "k3": 0.05}
SET_LENS = [f"camera.distortion.{key}={value}" for key, value in LENS.items()]
CAMERA = {"width_px": WIDTH, "height_px": HEIGHT, "fx_px": 50, "fy_px": 51, "cx_px": 23, "cy_px": 21}
BLOCKS = {
    passes.WALKER: (2, 3, 9, 22),
    passes.ELEPHANT: (38, 6, 58, 16),
}  # in the passes: x, y, x and y past the end


def _wide_index() -> np.ndarray:
    """Object indices of a picture with overscan: a walker at the upper left, an elephant that ends in the overscan."""
    plane = np.full((HEIGHT + 2 * OVERSCAN, WIDTH + 2 * OVERSCAN), passes.GROUND, np.float32)
    for index, (x, y, x_end, y_end) in BLOCKS.items():
        plane[y:y_end, x:x_end] = index
    return plane


@pytest.fixture(name="clip")
def _clip(veldt):
    """A clip of one frame with passes that extend beyond the picture."""
    folder = veldt.folder / "one"
    folder.mkdir()
    write_exr(folder / "000000.exr", {passes.OBJECTS: _wide_index()})
    document = passes.manifest(frames=1) | {"camera": CAMERA, "overscan_px": OVERSCAN}
    passes.write_manifest(folder, document)
    return document


def _source_px(lens: dict) -> tuple[np.ndarray, np.ndarray]:
    """Positions of the picture's pixels (height, width) in the passes: OpenCV's formula, inverted by its iteration."""
    column, row = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    x_shown = (column - CAMERA["cx_px"]) / CAMERA["fx_px"]
    y_shown = (row - CAMERA["cy_px"]) / CAMERA["fy_px"]
    x, y = x_shown, y_shown
    for _ in range(200):  # a contraction by half or better a step
        r2 = x * x + y * y
        radial = 1 + lens["k1"] * r2 + lens["k2"] * r2 * r2 + lens["k3"] * r2 * r2 * r2
        x_tangential = 2 * lens["p1"] * x * y + lens["p2"] * (r2 + 2 * x * x)
        y_tangential = lens["p1"] * (r2 + 2 * y * y) + 2 * lens["p2"] * x * y
        x, y = (x_shown - x_tangential) / radial, (y_shown - y_tangential) / radial
    return CAMERA["fx_px"] * x + CAMERA["cx_px"] + OVERSCAN, CAMERA["fy_px"] * y + CAMERA["cy_px"] + OVERSCAN


def _convert(veldt, out: str, *settings) -> dict:
    done = veldt("convert", "one", "--out", out, "--quiet", *(["--set", *settings] if settings else []))
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt.read(f"{out}/annotations.json")


def test_labels_are_the_pixels_the_lens_shows(veldt, clip):
    u_px, v_px = _source_px(LENS)
    shown = _wide_index()[np.floor(v_px).astype(int), np.floor(u_px).astype(int)]
    # The lens matters: it draws the walker into a picture whose pinhole would cut him off at the left.
    assert (shown != _wide_index()[OVERSCAN:-OVERSCAN, OVERSCAN:-OVERSCAN]).sum() > 50
    document = _convert(veldt, "out", *SET_LENS)
    planes = {"clips/one/ir8/000000.png": shown}
    assert check_labels(document, planes, {"one": clip}) == 2


@pytest.mark.usefixtures("clip")
def test_pictures_are_the_radiance_the_lens_shows(veldt):
    """Where all four pixels around a source are of one surface, that surface's count; between two, one in between."""
    sharp = ["sensor.noise.amount=0", "sensor.optics.blur_sigma_px=0"]
    _convert(veldt, "out", *SET_LENS, *sharp)
    u_px, v_px = _source_px(LENS)
    wide = _wide_index()
    ir16 = read_grey(veldt.folder / "out/clips/one/ir16/000000.png")
    column, row = np.floor(u_px - 0.5).astype(int), np.floor(v_px - 0.5).astype(int)
    four = np.stack([wide[row + j, column + i] for j in (0, 1) for i in (0, 1)])
    even = (four == four[0]).all(axis=0)
    assert ir16.shape == (HEIGHT, WIDTH) and np.count_nonzero(~even) > 50
    counts = {index: np.unique(ir16[even & (four[0] == index)]) for index in np.unique(wide)}
    assert all(len(values) == 1 for values in counts.values())  # every surface is as warm wherever it is seen
    assert len({int(values[0]) for values in counts.values()}) == 3
    low, high = (f([int(v[0]) for v in counts.values()]) for f in (min, max))
    assert ((ir16 >= low) & (ir16 <= high)).all()
    between = ~np.isin(ir16, [int(values[0]) for values in counts.values()])
    assert not (between & even).any() and np.count_nonzero(between) > 20  # edges are soft, not jagged


def test_without_distortion_the_overscan_is_cut_off(veldt, clip):
    document = _convert(veldt, "out")
    inner = _wide_index()[OVERSCAN:-OVERSCAN, OVERSCAN:-OVERSCAN]
    assert check_labels(document, {"clips/one/ir8/000000.png": inner}, {"one": clip}) == 2


def test_the_camera_is_stored_with_the_labels(veldt, clip):
    (video,) = _convert(veldt, "out", *SET_LENS)["videos"]
    assert (
        video["camera"] == {key: clip["camera"][key] for key in ("fx_px", "fy_px", "cx_px", "cy_px")} | LENS
    )


def test_passes_that_reach_less_far_than_the_lens_needs(veldt, clip):
    passes.write_manifest(veldt.folder / "one", clip | {"overscan_px": 1})
    done = veldt("convert", "one", "--out", "out", "--quiet", "--set", *SET_LENS)
    u_px, v_px = _source_px(LENS)
    beyond_px = max(
        OVERSCAN + 0.5 - min(u_px.min(), v_px.min()),
        u_px.max() - OVERSCAN - WIDTH + 0.5,
        v_px.max() - OVERSCAN - HEIGHT + 0.5,
    )
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        f"veldt: clip one: overscan_px = 1 px; expected at least {np.ceil(beyond_px):.0f} px for this lens distortion"
        " (render.overscan_px), or a manifest whose camera is smaller than its passes\n"
    )
