"""`veldt compare --kelvin`: temperatures of datasets, of their exports, and of other tools' pictures."""

import numpy as np
import pytest

import passes
from pictures import write_grey
from program import Veldt, check_fault
from reports import Page


def _compare(veldt, *arguments):
    done = veldt("compare", *arguments, "--progress", "none")
    assert (done.code, done.err) == (0, ""), done
    return done


def _row(document: dict, name: str) -> dict:
    return next(row for row in document["measures"] if row["name"] == name)


@pytest.fixture(scope="module", name="radiometric")
def _radiometric(tmp_path_factory) -> Veldt:
    """A dataset of a clip of 8 frames, `data`, and its TIFFs, of floats and of counts."""
    veldt = Veldt(tmp_path_factory.mktemp("radiometric"))
    clip = passes.write_clip(veldt.folder / "one", "one", 8)
    done = veldt("convert", clip, "--out", "data", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    for kind in ("float32", "uint16"):
        done = veldt("export", "data", "--format", "tiff", "--tiff-type", kind, "--out", kind, "--quiet")
        assert (done.code, done.out, done.err) == (0, "", "")
    return veldt


@pytest.mark.parametrize("kind", ["float32", "uint16"])
def test_exported_temperatures_are_the_dataset_s(radiometric, kind):
    found = _compare(radiometric, f"{kind}/one/images", "data", "--kelvin", "--json").json()
    assert 0 < found["levels"]["kelvin_per_level"] < 1
    assert 200 < found["levels"]["lowest_k"] < 320
    assert all(row["difference"] in (0, None) for row in found["measures"])
    assert any(row["difference"] == 0 for row in found["measures"])


def test_16_bit_pngs_have_the_scale_that_is_given(radiometric):
    folder = "data/clips/one/ir16"
    scale = ("--kelvin", "--real-kelvin-per-count")
    found = _compare(radiometric, folder, "data", *scale, "0.01", "--json").json()
    assert _row(found, "mean")["difference"] == 0
    warmer = _compare(radiometric, folder, "data", *scale, "0.011", "--json").json()
    assert _row(warmer, "mean")["difference"] < -50
    done = radiometric("compare", folder, "data", "--kelvin", "--progress", "none")
    assert done.code == 1
    rule = "expected kelvin per count in its tags or as an option"
    assert f"{folder}/000000.png: scale of its counts = unknown; {rule}" in done.err


def test_tenths_of_degrees_celsius(radiometric):
    folder = radiometric.folder / "tenths"
    folder.mkdir()
    rng = np.random.default_rng(3)
    for k in range(4):
        write_grey(folder / f"{k}.tif", rng.integers(100, 300, (24, 32)).astype(np.int16))
    done = radiometric("compare", "tenths", "data", "--kelvin", "--progress", "none")
    advice = "--real-kelvin-per-count 0.01, or 0.1 with --real-unit celsius for tenths of a degree"
    assert done.code == 1
    rule = f"expected kelvin per count in its tags or as an option: {advice}"
    assert f"tenths/0.tif: scale of its counts = unknown; {rule}\n" in done.err
    scale = ("--real-unit", "celsius", "--real-kelvin-per-count", "0.1")
    found = _compare(radiometric, "tenths", "data", "--kelvin", *scale, "--json").json()
    levels = found["levels"]
    mean_k = levels["lowest_k"] + _row(found, "mean")["real"] * levels["kelvin_per_level"]
    assert mean_k == pytest.approx(293, abs=1)
    done = radiometric("compare", "data", "tenths", "--kelvin", *scale)
    what = "data is a Veldt dataset, which states the scale of its ir16"
    rule = "expected it for a folder of pictures of your own"
    check_fault(done, 2, f"--real-kelvin-per-count: {what}; {rule}")


def test_floats_are_temperatures_only_if_asked(radiometric):
    done = radiometric("compare", "float32/one/images", "data", "--progress", "none")
    assert done.code == 1
    assert "pixels = float; expected grey of 8 or 16 bits" in done.err


def test_scales_are_of_temperatures(radiometric):
    done = radiometric("compare", "float32/one/images", "data", "--kelvin-per-count", "0.01")
    check_fault(done, 2, "--kelvin-per-count requires --kelvin; see veldt compare --help")


def test_the_table_and_the_page_of_temperatures(radiometric):
    done = _compare(radiometric, "float32/one/images", "data", "--kelvin", "--html", "k.html")
    assert any(line.startswith("levels   of ") for line in done.out.splitlines())
    shown = Page(radiometric.folder / "k.html").figures["real"]["shown_frames"]
    assert all(frame["picture"].startswith("data:image/png;base64,") for frame in shown)
