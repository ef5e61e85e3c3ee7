"""Labels of a rendered dataset with lens distortion, checked against the positions of actors in the manifest."""

import itertools
import json

import numpy as np
import pytest

from configs import tiny
from labels import check_labels
from lenses import CAMERA, HEIGHT, LENS, PINHOLE, WIDTH, behind_a_lens, check_inside, to_px, undistort
from pictures import read_planes
from program import Veldt

# A calibrated camera: pixels that are not square, the axis off the middle, k3; in OpenCV's pixels, ours are 0.5 more.
MATRIX = {"fx_px": 425.25, "fy_px": 441.5, "cx_px": 171.75, "cy_px": 118.5}
CALIBRATED_LENS = {"k1": -0.25, "k2": 0.08, "p1": 0.0012, "p2": -0.0008, "k3": 0.05}
CALIBRATION = f"""%YAML:1.0
---
image_width: {WIDTH}
image_height: {HEIGHT}
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 425.25, 0., 171.25, 0., 441.5, 118., 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.25, 0.08, 0.0012, -0.0008, 0.05 ]
"""


class Rendered:
    """A generated dataset with its passes, and a second one with a pinhole camera from the same passes."""

    def __init__(self, folder, blender: str, supersample: int, camera: dict, lens: dict, pinhole: str):
        render = {"engine": "blender", "supersample": supersample}
        config = tiny(behind_a_lens) | {"render": render, "camera": camera}
        self.lens, self.supersample = lens, supersample
        veldt = Veldt(folder)
        veldt.write("cal.yml", CALIBRATION)
        veldt.write("config.json", config)
        keep = ("--keep-passes", "--blender", blender)
        _check(veldt("generate", "config.json", "--out", "lens", "--quiet", *keep))
        settings = ("--config", "config.json", "--set", pinhole)
        _check(veldt("convert", "lens/passes", "--out", "pinhole", "--quiet", *settings))
        self.camera = veldt.read("lens/dataset.json")["config"]["camera"]
        self.labels = {kind: veldt.read(f"{kind}/annotations.json") for kind in ("lens", "pinhole")}
        self.manifests = {
            c["id"]: veldt.read(f'lens/passes/{c["id"]}/manifest.json') for c in config["clips"]
        }
        self.planes = {
            f"clips/{clip}/ir8/{k:06d}.png": read_planes(folder / "lens/passes" / clip / f"{k:06d}.exr")[
                "Scene.IndexOB.X"
            ]
            for clip, manifest in self.manifests.items()
            for k in range(len(manifest["frames"]))
        }


def _check(done) -> None:
    assert (done.code, done.out, done.err) == (0, "", "")


@pytest.fixture(scope="module", name="rendered")
def _rendered(tmp_path_factory, blender) -> Rendered:
    return Rendered(tmp_path_factory.mktemp("plain"), blender, 1, CAMERA, LENS, "camera.distortion={}")


@pytest.fixture(scope="module", name="finer")
def _finer(tmp_path_factory, blender) -> Rendered:
    return Rendered(tmp_path_factory.mktemp("finer"), blender, 2, CAMERA, LENS, "camera.distortion={}")


@pytest.fixture(scope="module", name="calibrated")
def _calibrated(tmp_path_factory, blender) -> Rendered:
    size = {"width_px": WIDTH, "height_px": HEIGHT}
    camera = size | {"pixel_pitch_um": 30, "calibration": "cal.yml"}
    pinhole = "camera=" + json.dumps(size | MATRIX)
    return Rendered(tmp_path_factory.mktemp("calibrated"), blender, 1, camera, CALIBRATED_LENS, pinhole)


def test_overscan_is_what_the_lens_needs(rendered, finer, calibrated):
    """The corners show the outermost points; the number is the same for passes of any resolution."""
    for dataset in (rendered, finer, calibrated):
        for manifest in dataset.manifests.values():
            camera = manifest["camera"]
            assert (camera["width_px"], camera["height_px"]) == (WIDTH, HEIGHT)
            corners = np.array(list(itertools.product((0.5, WIDTH - 0.5), (0.5, HEIGHT - 0.5))))
            shown = (corners - (camera["cx_px"], camera["cy_px"])) / (camera["fx_px"], camera["fy_px"])
            beyond_px = np.abs(to_px(undistort(shown, dataset.lens), camera) - corners).max()
            assert manifest["overscan_px"] == np.ceil(beyond_px)
            shape = next(iter(dataset.planes.values())).shape
            margin = 2 * manifest["overscan_px"]
            assert shape == (
                dataset.supersample * (HEIGHT + margin),
                dataset.supersample * (WIDTH + margin),
            )


def test_every_label_holds_exactly_the_pixels_the_lens_shows(rendered, calibrated):
    """Compares with the nearest pixel of the passes by the formula, which is inverted here independently."""
    column, row = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    for dataset in (rendered, calibrated):
        shown = {}
        for name, plane in dataset.planes.items():
            manifest = dataset.manifests[name.split("/")[1]]
            camera = manifest["camera"]
            points = np.stack(
                [(column - camera["cx_px"]) / camera["fx_px"], (row - camera["cy_px"]) / camera["fy_px"]],
                axis=-1,
            )
            place = to_px(undistort(points, dataset.lens), camera) + manifest["overscan_px"]
            place = np.floor(place).astype(int)
            shown[name] = plane[place[..., 1], place[..., 0]]
        assert check_labels(dataset.labels["lens"], shown, dataset.manifests) > 30


def test_a_pinhole_makes_of_the_same_passes_what_lies_in_their_middle(rendered, calibrated):
    for dataset in (rendered, calibrated):
        middle = {}
        for name, plane in dataset.planes.items():
            margin = dataset.manifests[name.split("/")[1]]["overscan_px"]
            middle[name] = plane[margin:-margin, margin:-margin]
        assert check_labels(dataset.labels["pinhole"], middle, dataset.manifests) > 30


def test_passes_labels_and_provenance_are_of_the_calibrated_camera(calibrated):
    """The file's numbers everywhere, and its name nowhere: the dataset speaks for itself."""
    for manifest in calibrated.manifests.values():
        assert manifest["camera"] == {"width_px": WIDTH, "height_px": HEIGHT} | MATRIX
    assert "calibration" not in calibrated.camera
    assert calibrated.camera["distortion"] == CALIBRATED_LENS
    assert {key: calibrated.camera[key] for key in MATRIX} == MATRIX


def test_labels_lie_within_their_actors_projected_box(rendered, finer, calibrated):
    """A label's edge is half a pixel beyond its last pixel's centre; behind a lens that centre looks up to half a pixel
    past the centre of the nearest pixel of the passes, in either direction; of a finer picture's pixel half is inside
    the body, so one of four centres that are a quarter of a pixel from its own. Poses: 0.01 px, as without a lens.
    The lens shrinks by up to 1 and stretches nowhere beyond 1.01, the tangential part: 0.01 px more.
    """
    for dataset, sub_px in ((rendered, 0.0), (finer, 0.25), (calibrated, 0.0)):
        assert check_inside(dataset.labels["pinhole"], dataset.manifests, PINHOLE, 0.51 + sub_px) == 0
        moved_px = check_inside(dataset.labels["lens"], dataset.manifests, dataset.lens, 1.02 + sub_px)
        assert moved_px > 3  # so a lens forgotten, or the wrong way round, would not have passed


def test_labels_store_the_camera_and_its_lens(rendered, calibrated):
    for dataset in (rendered, calibrated):
        for kind, lens in (("lens", dataset.lens), ("pinhole", PINHOLE)):
            for video in dataset.labels[kind]["videos"]:
                camera = dataset.manifests[video["name"]]["camera"]
                assert video["camera"] == {key: camera[key] for key in MATRIX} | lens
