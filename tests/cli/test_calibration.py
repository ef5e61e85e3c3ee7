"""`camera.calibration`: a file of OpenCV's or ROS', read once and written out as numbers; or refused in exact words."""

import pytest

import passes
from configs import tiny

# Of the camera in `passes`, whose principal point is 0.5 px more than OpenCV's.
CALIBRATION = """image_width: 24
image_height: 16
camera_name: made_up
camera_matrix:
  rows: 3
  cols: 3
  data: [30, 0, 11.5, 0, 30, 7.5, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.05, 0.01, 0.001, -0.001, 0.002]
"""
SIZE = {"width_px": 24, "height_px": 16}
NUMBERS = {"fx_px": 30, "fy_px": 30, "cx_px": 12, "cy_px": 8}
LENS = {"k1": 0.05, "k2": 0.01, "p1": 0.001, "p2": -0.001, "k3": 0.002}


@pytest.fixture(name="clip")
def _clip(veldt):
    """Passes of one frame that reach a pixel beyond the picture, and a config that names a calibration."""
    passes.write_clip(veldt.folder / "one", frames=1)
    (veldt.folder / "configs").mkdir()
    veldt.write("configs/cal.yaml", CALIBRATION)
    _write_config(veldt, "config", SIZE | {"calibration": "cal.yaml"})


def _write_config(veldt, name: str, camera: dict) -> None:
    clip = {"id": "one", "season": "winter", "frames": 1}
    veldt.write(f"configs/{name}.json", {"name": "made_up", "seed": 5, "camera": camera, "clips": [clip]})


def _convert(veldt, out: str, *options: str):
    return veldt("convert", "one", "--out", out, "--quiet", *options)


@pytest.mark.usefixtures("clip")
def test_a_dataset_holds_the_numbers_and_not_the_files_name(veldt):
    done = _convert(veldt, "out", "--config", "configs/config.json")
    assert (done.code, done.out, done.err) == (0, "", "")
    camera = veldt.read("out/dataset.json")["config"]["camera"]
    assert "calibration" not in camera
    assert {key: camera[key] for key in NUMBERS} == NUMBERS
    assert camera["distortion"] == LENS
    (video,) = veldt.read("out/annotations.json")["videos"]
    assert video["camera"] == NUMBERS | LENS


@pytest.mark.usefixtures("clip")
def test_the_numbers_themselves_make_the_same_dataset(veldt):
    _write_config(veldt, "numbers", SIZE | NUMBERS | {"distortion": LENS})
    for name in ("config", "numbers"):
        assert _convert(veldt, name, "--config", f"configs/{name}.json").code == 0
    assert veldt.read("config/dataset.json")["config"] == veldt.read("numbers/dataset.json")["config"]
    assert veldt.pixels("config") == veldt.pixels("numbers")


@pytest.mark.usefixtures("clip")
def test_variants_share_the_calibration_and_do_not_change_it(veldt):
    variants = [
        {"name": "summer", "season": "summer"},
        {"name": "bent", "camera": {"distortion": {"k1": 0.1}}},
    ]
    veldt.write("variants.json", {"variants": variants[:1]})
    options = ("--config", "configs/config.json", "--variants", "variants.json")
    assert _convert(veldt, "out", *options).code == 0
    assert veldt.read("out/summer/dataset.json")["config"]["camera"]["distortion"] == LENS
    veldt.write("variants.json", {"variants": variants})
    done = _convert(veldt, "more", *options)
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        "veldt: variants.json: variants[1] (bent): camera.distortion.k1 = 0.1; expected none beside"
        " camera.calibration\n"
    )


@pytest.mark.usefixtures("clip")
def test_passes_of_another_camera_are_refused(veldt):
    veldt.write("configs/cal.yaml", CALIBRATION.replace("11.5", "11.75"))
    done = _convert(veldt, "out", "--config", "configs/config.json")
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        "veldt: configs/config.json: camera.cx_px = 12.25 px; expected 12 px, as the passes in one have it\n"
    )
    assert not (veldt.folder / "out").exists()


FAULTS = {
    "size": (
        CALIBRATION.replace("24", "48"),
        " size of the picture = 48 x 16 px; expected 24 x 16 px, camera.width_px x camera.height_px",
    ),
    "rational": (
        CALIBRATION.replace("cols: 5", "cols: 8").replace("0.002]", "0.002, 0.5, 0, 0]"),
        " distortion_coefficients: k4 = 0.5; expected 0: the rational model is not supported",
    ),
    "fisheye": (
        CALIBRATION.replace("plumb_bob", "equidistant"),
        " distortion_model = equidistant; expected plumb_bob, radtan, or rational_polynomial whose k4 to k6 are 0",
    ),
    "malformed": (
        CALIBRATION.replace("0, 1]", "0, 1"),
        "8: expected numbers and , in a list",
    ),
    "binary": ("\x01\x02\x03", " control characters; expected a text: YAML, XML or JSON"),
    "deep": (
        "[" * 100000,
        " more than 4000 brackets, tags and keys; expected a calibration of one camera",
    ),
    "empty": ("", " no keys; expected some, such as camera_matrix"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_calibration_that_cannot_be_used_is_refused_in_one_line(veldt, name):
    """Not a word of OpenCV's own on the terminal, even if the environment has it print its errors."""
    content, why = FAULTS[name]
    file = veldt.write("cal.yaml", content)
    veldt.write("config.json", tiny() | {"camera": SIZE | {"calibration": "cal.yaml"}})
    done = veldt("validate", "config.json", env={"OPENCV_DUMP_ERRORS": "1"})
    assert (done.code, done.out) == (2, "")
    assert done.err == f"veldt: config.json: camera.calibration: {file}:{why}\n"


@pytest.mark.parametrize(
    "file, why",
    [
        ("/dev/zero", "it is a pipe or a device; expected a file"),
        ("/", "it is a folder; expected a file"),
        ("/nowhere.yml", "no such file"),
    ],
)
def test_only_files_are_read(veldt, file, why):
    veldt.write("config.json", tiny() | {"camera": SIZE | {"calibration": file}})
    done = veldt("validate", "config.json")
    assert (done.code, done.out) == (2, "")
    assert done.err == f"veldt: config.json: camera.calibration: cannot read {file}: {why}\n"


def test_a_calibrated_camera_is_planned_with(veldt):
    """Python has the numbers, not the file."""
    veldt.write("cal.yaml", CALIBRATION)
    camera = SIZE | {"calibration": "cal.yaml"}
    veldt.write("config.json", tiny() | {"camera": camera})
    done = veldt("validate", "config.json")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("config.json: 2 clips, 16 frames")
