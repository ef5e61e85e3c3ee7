"""Heights and densities from the user's images."""

import json
import sys

import numpy as np
import OpenImageIO as oiio
import pytest

import configs
from raw_png import RGB, png_bytes
from resolved import load
from scenes import tiny
from planner.plants.density import plan_density
from planner.failures import failure_of
from planner.faults import ConfigError
from planner.land.grey_images import read_density, read_grey, read_height_shares, sample
from planner.land.terrain import build_terrain


def _write(path, values, form):
    """An image of values [row, column], 0 to 1, as `form` of OpenImageIO's."""
    spec = oiio.ImageSpec(values.shape[1], values.shape[0], 1, form)
    image = oiio.ImageOutput.create(str(path))
    assert (
        image.open(str(path), spec)
        and image.write_image(values.astype(np.float32)[..., None])
        and image.close()
    )
    return path


def _smooth(rows=70, columns=50):
    y, x = np.mgrid[:rows, :columns]
    return 0.5 + 0.3 * np.sin(x / 9) * np.cos(y / 7) + 0.15 * np.random.default_rng(4).random((rows, columns))


@pytest.mark.parametrize("form, step", [("uint16", 1 / 65535), ("uint8", 1 / 255)])
def test_png_files_are_read_to_the_last_bit(tmp_path, form, step):
    values = _smooth()
    read = read_grey(_write(tmp_path / "a.png", values, form), "here")
    assert read.shape == values.shape
    assert np.abs(read - values).max() <= 0.5 * step + 1e-6
    assert np.abs(read / step - np.round(read / step)).max() < 1e-6


def test_exr_files_are_read_as_they_are(tmp_path):
    values = 300.0 * _smooth()
    assert read_grey(_write(tmp_path / "a.exr", values, "float"), "here") == pytest.approx(values, rel=1e-6)


def _write_channels(path, planes, parts=1):
    """An EXR of planes [row, column] by the names of their channels; the same in each of its parts."""
    pixels = np.stack(list(planes.values()), axis=-1).astype(np.float32)
    specs = []
    for part in range(parts):
        spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], "float")
        spec.channelnames = tuple(planes)
        spec["oiio:subimagename"] = f"part{part}"
        specs.append(spec)
    image = oiio.ImageOutput.create(str(path))
    assert image.open(str(path), specs) if parts > 1 else image.open(str(path), specs[0])
    for part, spec in enumerate(specs):
        assert part == 0 or image.open(str(path), spec, "AppendSubimage")
        assert image.write_image(pixels)
    assert image.close()
    return path


def test_one_of_an_exr_s_channels_is_chosen_by_name(tmp_path):
    flat, hill = np.full((4, 5), 0.9), np.arange(20.0).reshape(4, 5)
    path = _write_channels(tmp_path / "a.exr", {"Layer.Combined.R": flat, "Layer.Depth.Z": hill})
    assert (read_grey(path, "here", "Layer.Depth.Z") == hill).all()
    odd = {
        None: "it has 2 channels, Layer.Combined.R, Layer.Depth.Z; `channel` chooses one",
        "Z": 'it has no channel "Z", but Layer.Combined.R, Layer.Depth.Z',
    }
    for channel, reason in odd.items():
        with pytest.raises(ConfigError) as raised:
            read_grey(path, "here", channel)
        assert str(raised.value) == f"here = {path}; expected a grey PNG or an EXR file ({reason})"
    alone = _write_channels(tmp_path / "b.exr", {"Layer.Depth.Z": hill})
    assert (read_grey(alone, "here") == hill).all()
    parts = _write_channels(tmp_path / "c.exr", {"Z": hill}, parts=2)
    assert (read_grey(parts, "here", "part1.Z") == hill).all()
    with pytest.raises(ConfigError, match=r"it has 2 channels, part0.Z, part1.Z;"):
        read_grey(parts, "here")
    with pytest.raises(ConfigError, match='a PNG has no channel "Z"'):
        read_grey(_write(tmp_path / "a.png", _smooth(), "uint8"), "here", "Z")


@pytest.mark.parametrize("value", [-9999, -32768, 3.4028235e38, -3.4028235e38, np.nan, np.inf, -1e6, 1e5])
def test_pixels_without_a_height_are_counted(tmp_path, value):
    values = _smooth()
    values[3:5, 7:10] = value
    path = _write(tmp_path / "dem.exr", values, "float")
    for height_m in ([0, 10], [-400, 1600]):
        with pytest.raises(ConfigError) as raised:
            read_height_shares({"file": str(path), "height_m": height_m}, "map")
        assert str(raised.value) == (
            f"map.file = {path}, 6 of 3500 pixels with values such as {np.float32(value):g}; expected heights of"
            " -500 to 9000 m in every pixel, none without data"
        )
    with pytest.raises(ConfigError) as raised:
        read_density({"file": str(path)}, "map")
    assert str(raised.value) == (
        f"map.file = {path}, 6 of 3500 pixels with values such as {np.float32(value):g}; expected 0 to 1 in every"
        " pixel, none without data"
    )


def test_marks_of_missing_data_are_no_heights_however_small_the_scale(tmp_path):
    values = _smooth()
    values[0, 0] = -9999
    path = _write(tmp_path / "dem.exr", values, "float")
    with pytest.raises(ConfigError, match="1 of 3500 pixels with values such as -9999;"):
        read_height_shares({"file": str(path), "height_m": [0, 0.01]}, "map")


def test_heights_in_metres_and_beyond_those_of_0_and_1_are_read(tmp_path):
    path = _write(tmp_path / "dem.exr", np.array([[-400.0, 8848.0], [0.0, 2.0]]), "float")
    shares = read_height_shares({"file": str(path), "height_m": [0, 1]}, "map")
    assert shares.tolist() == [[-400, 8848], [0, 2]]


def test_a_decoder_is_chosen_by_the_first_bytes_alone(tmp_path):
    values = _smooth()
    for kind, other in (("exr", "png"), ("png", "dpx")):
        path = _write(tmp_path / f"map.{kind}", values, "float" if kind == "exr" else "uint16")
        renamed = path.rename(tmp_path / f"renamed.{other}")
        assert read_grey(renamed, "here") == pytest.approx(values, abs=1e-5)
    read_grey(renamed, "here")
    bitmap = b"BM" + (70).to_bytes(4, "little") + bytes(4) + (54).to_bytes(4, "little")
    bitmap += (
        (40).to_bytes(4, "little") + bytes([2, 0, 0, 0, 2, 0, 0, 0, 1, 0, 24, 0]) + bytes(24) + bytes(16)
    )
    (tmp_path / "map.png").write_bytes(bitmap)
    assert oiio.ImageInput.open(str(tmp_path / "map.png")) is None  # OpenImageIO tries no other decoder


_GREY = png_bytes(np.arange(4000, dtype=np.uint16).reshape(50, 80))


@pytest.mark.parametrize(
    "content, reason",
    [
        (None, "expected a readable file (No such file or directory)"),
        (b"", "expected an image, and the file is empty"),
        (b"GIF89a", "expected a grey PNG or an EXR file (it is neither)"),
        # The rest is OpenImageIO's, whose versions differ.
        (_GREY[:200], "expected a grey PNG or an EXR file (Read error: hit end of file"),
        (
            png_bytes(np.ones((2, 2, 3), np.uint8), RGB),
            "expected a grey PNG or an EXR file (its pixels are not grey)",
        ),
        (
            png_bytes(np.ones((1, 1), np.uint8), size=(30000, 30000)),
            "expected a grey PNG or an EXR file (30000 x 30000 pixels are more than 400000000)",
        ),
    ],
)
def test_images_that_cannot_be_used_are_named(tmp_path, capfd, content, reason):
    path = tmp_path / "a.png"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(ConfigError) as raised:
        read_grey(path, "scene.terrain.heightmap.file")
    assert str(raised.value).startswith(f"scene.terrain.heightmap.file = {path}; {reason}")
    assert "\n" not in str(raised.value) and capfd.readouterr() == ("", "")


def test_a_damaged_exr_is_named(tmp_path):
    path = _write(tmp_path / "a.exr", _smooth(), "float")
    path.write_bytes(path.read_bytes()[:-3000])
    with pytest.raises(ConfigError, match=r"expected a grey PNG or an EXR file \(.*\)$"):
        read_grey(path, "here")


def test_without_openimageio_the_package_is_named(tmp_path, monkeypatch):
    path = _write(tmp_path / "a.png", _smooth(), "uint8")
    monkeypatch.setitem(sys.modules, "OpenImageIO", None)
    with pytest.raises(ModuleNotFoundError) as raised:
        read_grey(path, "here")
    assert failure_of(raised.value).hint.endswith("(apt-get install python3-openimageio)")


def test_pixels_lie_from_corner_to_corner_and_north_is_up():
    values = np.array([[0.0, 1.0], [2.0, 3.0]])
    assert sample(values, 10.0, [-5, 5, -5, 5, 0], [5, 5, -5, -5, 0]) == pytest.approx([0, 1, 2, 3, 1.5])
    assert sample(values, 10.0, 99.0, 99.0) == 1.0


def test_a_heightmap_is_the_land(tmp_path):
    y, x = np.mgrid[1:-1:61j, -1:1:61j]
    path = _write(tmp_path / "hill.png", np.exp(-3 * (x**2 + y**2)), "uint16")
    given = {"file": str(path), "height_m": [100, 140]}
    settings = tiny()["scene"]["terrain"] | {"water_radius_m": 0, "heightmap": given}
    terrain = build_terrain(settings, 3)
    # 2 m pixels of a hill that bends by 40 x 6 / 60^2 = 0.07 / m at most: 0.07 x 2^2 / 8 between them.
    for at_m in ((0, 0), (31, -14), (-59, 59)):
        expected_m = 100 + 40 * np.exp(-3 * ((at_m[0] / 60) ** 2 + (at_m[1] / 60) ** 2))
        assert terrain.height_m(*at_m) == pytest.approx(expected_m, abs=0.04)
    assert build_terrain(settings | {"water_radius_m": 10}, 3).waters[0].level_m < 140


def test_a_density_map_defines_the_areas(tmp_path):
    path = _write(tmp_path / "areas.png", np.repeat([[0.0, 0.0, 0.5, 0.5, 1.0, 1.0]], 6, axis=0), "uint8")
    settings = tiny()["scene"]["terrain"] | {"density_map": {"file": str(path)}}
    areas = plan_density(build_terrain(settings, 3), settings, 3)
    x_m = np.array([-58.0, -40.0, -8.0, 8.0, 40.0, 58.0])
    shares = areas.shares(x_m, np.zeros(6))
    assert shares.argmax(axis=1).tolist() == [0, 0, 1, 1, 2, 2]
    assert shares.sum(axis=1) == pytest.approx(np.ones(6))


def test_files_are_relative_to_the_config(tmp_path):
    heightmap = {"file": "maps/hill.png", "height_m": [0, 9]}
    config = configs.LEAST | {"scene": {"terrain": {"heightmap": heightmap}}}
    (tmp_path / "a.json").write_text(json.dumps(config), encoding="utf-8")
    assert load(tmp_path / "a.json")["scene"]["terrain"]["heightmap"]["file"] == str(
        tmp_path / "maps/hill.png"
    )
