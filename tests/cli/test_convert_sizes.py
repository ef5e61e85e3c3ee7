"""`convert` reads passes of every size, from one pixel to 4K, with the same pixel values as in a small picture."""

import numpy as np
import pytest

import passes
from labels import check_labels
from pictures import read_grey, write_exr

IDEAL = ["sensor.model=published", "sensor.optics.blur_sigma_px=0", "sensor.noise.amount=0"]
SIZES = [(1, 1), (1, 37), (37, 1), (2, 2), (641, 3), (3, 513), (3840, 3072)]
FRAMES = 2
PLAUSIBLE_K = (150, 400)


def _object_index(width: int, height: int, frame: int) -> np.ndarray:
    """Slanted stripes of all there is, a pixel wide in small pictures; the first of the first frame is an actor's."""
    kinds = np.array([passes.WALKER, passes.GROUND, passes.SHRUB, 0, passes.ELEPHANT])
    across, down = (97, 61) if width * height > 1e6 else (1, 1)
    rows, columns = np.indices((height, width))
    return kinds[(columns // across + rows // down + frame) % len(kinds)].astype(np.float32)


def _write_clip(folder, width: int, height: int):
    """Write a clip of that size; return its planes by the names of their 8-bit frames, and its manifest."""
    folder.mkdir()
    planes = {f"clips/sized/ir8/{k:06d}.png": _object_index(width, height, k) for k in range(FRAMES)}
    for frame, plane in enumerate(planes.values()):
        normals = {f"Scene.Normal.{axis}": np.full_like(plane, axis == "Z") for axis in "XYZ"}
        depth = np.where(plane == 0, 1e10, 40.0)
        write_exr(folder / f"{frame:06d}.exr", {passes.OBJECTS: plane, passes.DEPTH: depth} | normals)
    manifest = passes.manifest("sized", FRAMES)
    camera = {"width_px": width, "height_px": height, "cx_px": width / 2, "cy_px": height / 2}
    manifest["camera"] = camera | dict.fromkeys(("fx_px", "fy_px"), max(width, height))
    passes.write_manifest(folder, manifest)
    return planes, manifest


def _counts_of_each_index(veldt) -> np.ndarray:
    """The count of each index in an ideal sensor's 16-bit frames, from a picture of 24 x 16 pixels."""
    passes.write_clip(veldt.folder / "usual", "usual")
    done = veldt("convert", "usual", "--out", "usual_out", "--quiet", "--set", *IDEAL)
    assert (done.code, done.err) == (0, "")
    frame = read_grey(veldt.folder / "usual_out" / "clips" / "usual" / "ir16" / "000000.png")
    index = passes.object_index(0)
    counts = np.zeros(passes.ELEPHANT + 1, np.uint16)
    for number in np.unique(index).astype(int):
        (counts[number],) = set(frame[index == number].tolist())
    return counts


@pytest.mark.parametrize("width, height", SIZES)
def test_every_pixel_and_label_is_right(veldt, width, height):
    planes, manifest = _write_clip(veldt.folder / "sized", width, height)
    done = veldt("convert", "sized", "--out", "out", "--quiet", "--set", *IDEAL)
    assert (done.code, done.out, done.err) == (0, "", "")
    check_labels(veldt.read("out/annotations.json"), planes, {"sized": manifest})
    counts = _counts_of_each_index(veldt)
    for name, plane in planes.items():
        frame = read_grey(veldt.folder / "out" / name.replace("ir8", "ir16"))
        assert (frame == counts[plane.astype(int)]).all()


@pytest.mark.parametrize("width, height", SIZES)
def test_the_physical_model_and_its_camera_take_it_too(veldt, width, height):
    planes, manifest = _write_clip(veldt.folder / "sized", width, height)
    done = veldt("convert", "sized", "--out", "out", "--quiet", "--set", "sensor.model=physical")
    assert (done.code, done.out, done.err) == (0, "", "")
    check_labels(veldt.read("out/annotations.json"), planes, {"sized": manifest})
    step_k = veldt.read("out/dataset.json")["kelvin_per_count"]
    for name in planes:
        kelvin = read_grey(veldt.folder / "out" / name.replace("ir8", "ir16")) * step_k
        assert kelvin.shape == (height, width)
        assert PLAUSIBLE_K[0] < kelvin.min() <= kelvin.max() < PLAUSIBLE_K[1]
    assert (veldt("validate", "out").code, veldt("validate", "out").err) == (0, "")
