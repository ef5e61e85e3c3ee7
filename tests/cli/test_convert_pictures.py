"""`convert` reads pictures of indices and of colours, with the same result as an EXR index plane."""

import numpy as np
import OpenImageIO
import pytest

import passes
from datasets import content_of
from program import ROOT

COLOURS = {
    0: (10, 20, 250),
    passes.GROUND: (90, 60, 30),
    passes.SHRUB: (0, 128, 0),
    passes.WALKER: (255, 0, 0),
    passes.ELEPHANT: (128, 128, 128),
}
SMALL = {passes.GROUND: 1, passes.SHRUB: 4, passes.WALKER: 101, passes.ELEPHANT: 102}


def write_png(file, pixels: np.ndarray) -> None:
    """Write pixels (height, width[, channels]) of 8 or 16 bits, alpha not multiplied in."""
    shape = pixels.shape if pixels.ndim == 3 else (*pixels.shape, 1)
    spec = OpenImageIO.ImageSpec(shape[1], shape[0], shape[2], str(pixels.dtype))
    spec.attribute("oiio:UnassociatedAlpha", 1)
    out = OpenImageIO.ImageOutput.create(str(file))
    assert out.open(str(file), spec), out.geterror()
    assert out.write_image(pixels.reshape(shape)), out.geterror()
    out.close()


def _coloured(frame: int, alpha: bool = False) -> np.ndarray:
    index = passes.object_index(frame)
    picture = np.zeros((*index.shape, 3 + alpha), np.uint8)
    for number, colour in COLOURS.items():
        picture[index == number] = (*colour, 255) if alpha else colour
    if alpha:
        picture[index == 0] = 0  # a film without a sky
    return picture


KINDS = {
    "8 bits": lambda frame: passes.object_index(frame).astype(np.uint8),
    "16 bits": lambda frame: passes.object_index(frame).astype(np.uint16),
    "colours": _coloured,
    "colours and alpha": lambda frame: _coloured(frame, True),
}


def _manifest(clip: str, coloured: bool) -> dict:
    document = passes.manifest(clip)
    for frame in document["frames"]:
        frame["file"] = frame["file"].replace(".exr", ".png")
    if coloured:
        document["sky_colour"] = list(COLOURS[0])
        for each in document["objects"]:
            each["colour"] = list(COLOURS[each["index"]])
    return document


def _write(folder, kind: str):
    """A clip whose frames are pictures."""
    folder.mkdir()
    for frame in range(passes.FRAMES):
        write_png(folder / f"{frame:06d}.png", KINDS[kind](frame))
    passes.write_manifest(folder, _manifest(folder.name, "colours" in kind))
    return folder


@pytest.mark.parametrize("kind", KINDS)
def test_pictures_make_the_dataset_of_an_index_plane(veldt, kind):
    _write(veldt.folder / "one", kind)
    done = veldt("convert", "one", "--out", "out", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    (veldt.folder / "index").mkdir()
    passes.write_clip(veldt.folder / "index" / "one", has_depth=False)
    assert veldt("convert", "index/one", "--out", "by_index", "--quiet").code == 0
    assert veldt.pixels("out") == veldt.pixels("by_index")
    assert content_of(veldt.folder / "out") == content_of(veldt.folder / "by_index")


def _refused(veldt, *options) -> str:
    done = veldt("convert", "one", "--out", "out", "--quiet", "--strict", *options)
    assert (done.code, done.out) == (1, "")
    assert not (veldt.folder / "out" / "clips" / "one").exists()
    return done.err


def test_a_colour_of_nothing_is_refused_with_the_nearest(veldt):
    _write(veldt.folder / "one", "colours")
    picture = _coloured(0)
    picture[2:4, 3] = (254, 1, 0)
    write_png(veldt.folder / "one" / "000000.png", picture)
    assert (
        "one/000000.png: colour at pixel (3, 2) = #fe0100 (254, 1, 0) (2 pixels); expected an object's or the sky's; "
        "did you mean #ff0000 (255, 0, 0)?" in _refused(veldt)
    )


def test_an_index_the_manifest_lacks_is_refused(veldt):
    _write(veldt.folder / "one", "8 bits")
    picture = KINDS["8 bits"](0)
    picture[2, 3] = 103
    write_png(veldt.folder / "one" / "000000.png", picture)
    assert (
        "one/000000.png: object index at pixel (3, 2) = 103 (1 pixels); expected an index of the manifest's objects: "
        "0, 1, 4, 101, 102" in _refused(veldt)
    )


def test_a_picture_that_ends_too_soon_is_refused(veldt):
    _write(veldt.folder / "one", "16 bits")
    file = veldt.folder / "one" / "000000.png"
    file.write_bytes(file.read_bytes()[:90])
    assert "one/000000.png: damaged: " in _refused(veldt)


def test_a_picture_that_is_something_else_is_refused(veldt):
    _write(veldt.folder / "one", "8 bits")
    (veldt.folder / "one" / "000000.png").write_bytes((ROOT / "README.md").read_bytes())
    assert "one/000000.png: not a PNG file, or its header is damaged" in _refused(veldt)
