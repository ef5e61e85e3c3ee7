"""`export --format tiff` writes kelvin, or counts with their scale, with position and attitude in the tags."""

import json
import math
import re
import shutil

import numpy as np
import pytest

import passes
import tiff_tags
from earth import axes_at, earth_coordinates_m
from pictures import read_grey
from program import Veldt, files_below
from tiff_tags import read_tags

CLIPS = ("one", "two")
NAMES = [f"{clip}/images/{clip}_{k:06d}.tif" for clip in CLIPS for k in range(passes.FRAMES)]
SCALE_K = 0.01
ORIGIN = (-19.3, 23.1, 950.0)
# Right, down and forward of the camera in the columns, and its position: straight down with the top to the north; 30
# deg ahead of straight down with the top to the east; the same with the right side 10 deg low.
TILT, BANK = math.radians(30), math.radians(10)
POSES = [
    [1, 0, 0, 120.5, 0, -1, 0, -310.25, 0, 0, -1, 62.5, 0, 0, 0, 1],
    [0, -math.cos(TILT), math.sin(TILT), -1000, -1, 0, 0, 2000, 0, -math.sin(TILT), -math.cos(TILT), 122]
    + [0, 0, 0, 1],
    [math.cos(BANK), 0, -math.sin(BANK), 5, 0, -1, 0, 6, -math.sin(BANK), 0, -math.cos(BANK), -7.5]
    + [0, 0, 0, 1],
]
ANGLES = [(0, 0, 0), (90, 30, 0), (0, 0, 10)]  # yaw, pitch, roll
CONFIG = {
    "name": "made_up",
    "seed": 5,
    "sensor": {"preset": "boson_640_14mm"},
    "camera": {"width_px": passes.WIDTH, "height_px": passes.HEIGHT},
    "weather": {"date": "2026-07-09", "time": "23:59", "latitude_deg": -3.5, "elevation_m": 1200},
    "clips": [{"id": clip, "season": "winter", "frames": passes.FRAMES} for clip in CLIPS],
}


@pytest.fixture(scope="module", name="place")
def _place(tmp_path_factory) -> Veldt:
    """A place with `data`, a dataset of two clips; the second states no poses."""
    veldt = Veldt(tmp_path_factory.mktemp("tiff"))
    clips = [passes.write_clip(veldt.folder / clip, clip) for clip in CLIPS]
    manifest = passes.manifest("one")
    for frame, pose in zip(manifest["frames"], POSES):
        frame["camera_to_world"] = pose
        frame["time_s"] += 59.5  # the third is after midnight
    passes.write_manifest(clips[0], manifest)
    veldt.write("config.json", CONFIG)
    done = veldt("convert", *clips, "--config", "config.json", "--out", "data", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    return veldt


def _made(place, out, *options):
    done = place("export", "data", "--out", out, "--format", "tiff", "--quiet", *options)
    assert (done.code, done.out, done.err) == (0, "", "")
    return out


@pytest.fixture(scope="module", name="made")
def _exports(place):
    out = place.folder / "made"
    return _made(place, out, "--origin", ",".join(map(str, ORIGIN)))


def _counts(place, clip: str, frame: int) -> np.ndarray:
    return read_grey(place.folder / "data" / "clips" / clip / "ir16" / f"{frame:06d}.png")


def test_each_clip_is_a_folder_with_images_and_labels(place, tmp_path):
    done = place("export", "data", "--out", tmp_path / "x", "--format", "tiff", "--progress", "none")
    assert (done.code, done.err) == (0, "")
    assert done.out == (
        f"{tmp_path}/x: 6 pictures and 12 labels as tiff\n"
        "  split          clips  pictures  labels   human  elephant\n"
        "  all                2         6      12       6         6\n"
        "origin of the scene: latitude -3.5, longitude 23 deg, height 1200 m; --origin puts it elsewhere\n"
        "3 pictures without position and attitude: their frames have no pose\n"
    )
    labels = [f"{clip}/annotations.json" for clip in CLIPS]
    assert files_below(tmp_path / "x") == sorted([*NAMES, *labels, "export.json"])
    whole = place.read("data/annotations.json")
    for clip in CLIPS:
        document = json.loads((tmp_path / "x" / clip / "annotations.json").read_text())
        assert [video["name"] for video in document["videos"]] == [clip]
        names = [image["file_name"] for image in document["images"]]
        assert names == [f"images/{clip}_{k:06d}.tif" for k in range(passes.FRAMES)]
        ids = {image["id"] for image in document["images"]}
        assert document["annotations"] == [a for a in whole["annotations"] if a["image_id"] in ids]
    request = json.loads((tmp_path / "x" / "export.json").read_text())["request"]
    assert request["origin"] == {"latitude_deg": -3.5, "longitude_deg": 23.0, "height_m": 1200.0}
    assert (request["tiff_type"], request["images"], "link" in request) == ("float32", "ir16", False)


def test_float32_is_kelvin(place, made):
    for name in NAMES:
        clip, frame = name[:3], int(name[-10:-4])
        kelvin = read_grey(made / name)
        assert kelvin.dtype == np.float32
        counts = _counts(place, clip, frame)
        assert (kelvin == (counts * SCALE_K).astype(np.float32)).all()
        # Half a unit in the last place of a float below 512.
        assert np.abs(kelvin.astype(float) - counts * SCALE_K).max() <= 2**-16
        assert (np.rint(kelvin.astype(float) / SCALE_K) == counts).all()
    tags = read_tags(made / NAMES[0])["image"]
    assert tags[tiff_tags.DESCRIPTION] == "Synthetic thermal image: apparent temperature in kelvin"
    assert tags[tiff_tags.GDAL_METADATA] == (
        '<GDALMetadata><Item name="UNITTYPE" sample="0" role="unittype">K</Item></GDALMetadata>'
    )


def test_uint16_is_the_dataset_s_counts_with_their_scale(place, tmp_path):
    made = _made(place, tmp_path / "x", "--tiff-type", "uint16", "--images", "ir16")
    for name in NAMES:
        counts = read_grey(made / name)
        assert counts.dtype == np.uint16
        assert (counts == _counts(place, name[:3], int(name[-10:-4]))).all()
    tags = read_tags(made / NAMES[0])["image"]
    assert tags[tiff_tags.DESCRIPTION].endswith("apparent temperature in kelvin = value * 0.01")
    assert '<Item name="SCALE" sample="0" role="scale">0.01</Item>' in tags[tiff_tags.GDAL_METADATA]


def test_the_camera_is_in_the_tags(made):
    tags = read_tags(made / NAMES[0])
    image, exif = tags["image"], tags["exif"]
    assert (image[tiff_tags.MAKE], image[tiff_tags.MODEL]) == ("Veldt", "boson_640_14mm")
    assert image[tiff_tags.SOFTWARE] == "Veldt"
    assert tiff_tags.DATE_TIME not in image  # it would be the time of writing
    # 30 px of the manifest's camera, of 12 um each.
    assert float(exif[tiff_tags.FOCAL_LENGTH]) == pytest.approx(0.36, rel=1e-6)
    assert float(exif[tiff_tags.FOCAL_PLANE_X]) == pytest.approx(1e4 / 12, rel=1e-6)
    assert exif[tiff_tags.FOCAL_PLANE_UNIT] == 3  # centimetres
    assert float(exif[tiff_tags.F_NUMBER]) == 1
    xmp = image[tiff_tags.XMP].decode()
    for tag, value in (("BandName", "LWIR"), ("CentralWavelength", "11000"), ("WavelengthFWHM", "6000")):
        assert f"<Camera:{tag}><rdf:Seq><rdf:li>{value}</rdf:li></rdf:Seq></Camera:{tag}>" in xmp


def test_times_are_local_solar_time(made):
    times = []
    for name in NAMES[:3]:
        exif = read_tags(made / name)["exif"]
        times.append((exif[tiff_tags.DATE_TIME_ORIGINAL], exif[tiff_tags.SUBSEC_ORIGINAL]))
    assert times == [
        ("2026:07:09 23:59:59", "500"),
        ("2026:07:09 23:59:59", "611"),
        ("2026:07:09 23:59:59", "722"),
    ]
    assert read_tags(made / NAMES[3])["exif"][tiff_tags.DATE_TIME_ORIGINAL] == "2026:07:09 23:59:00"


def _position(gps: dict) -> tuple[float, float, float]:
    angles = [
        sum(float(part) / 60**k for k, part in enumerate(gps[number]))
        * (-1 if gps[number - 1] in "SW" else 1)
        for number in (2, 4)
    ]
    return *angles, float(gps[6]) * (-1 if gps[5] else 1)


@pytest.mark.parametrize("origin", [ORIGIN, (-19.3, 179.999), (60.0, -70.0, -3.0)])
def test_positions_are_within_a_centimetre(place, tmp_path, origin):
    made = _made(place, tmp_path / "x", f"--origin={','.join(map(str, origin))}")
    height_m = origin[2] if len(origin) == 3 else 1200
    for name, pose in zip(NAMES, POSES):
        gps = read_tags(made / name)["gps"]
        assert (gps[0], gps[18]) == (bytes([2, 3, 0, 0]), "WGS-84")
        local_m = axes_at(*origin[:2]) @ (
            earth_coordinates_m(*_position(gps)) - earth_coordinates_m(*origin[:2], height_m)
        )
        assert np.abs(local_m - np.array(pose)[[3, 7, 11]]).max() < 0.002  # the step of heights is 1 mm


def test_attitudes_are_those_of_the_poses(made):
    for name, angles in zip(NAMES, ANGLES):
        xmp = read_tags(made / name)["image"][tiff_tags.XMP].decode()
        found = [float(re.search(f' Camera:{key}="([^"]*)"', xmp)[1]) for key in ("Yaw", "Pitch", "Roll")]
        # North and up turn by 2.24 km / 6335 km = 0.0203 deg at most between the origin and there; of a camera that
        # pitches by 30 deg, yaw and roll turn by 1 / cos(30 deg) of that.
        assert np.abs([math.remainder(a - b, 360) for a, b in zip(found, angles)]).max() < 0.0235


def test_frames_without_a_pose_have_no_position(made):
    for name in NAMES[3:]:
        tags = read_tags(made / name)
        assert "gps" not in tags
        assert b"Camera:Yaw" not in tags["image"][tiff_tags.XMP]


def test_the_same_bytes_again_with_other_threads(place, made, tmp_path):
    again = _made(place, tmp_path / "x", "--origin", ",".join(map(str, ORIGIN)), "--threads", "1")
    for name in files_below(made):
        assert (made / name).read_bytes() == (again / name).read_bytes()
    before = place(
        "export", "data", "--out", again, "--format", "tiff", "--origin", ",".join(map(str, ORIGIN))
    )
    assert before.out == f"{again}: nothing to do; this export already exists\n"


def test_splits_are_folders_around_the_clips(place, tmp_path):
    made = _made(place, tmp_path / "x", "--split", "train:0.5,val:0.5")
    folders = {name.split("/")[0] for name in files_below(made)} - {"export.json"}
    assert folders == {"train", "val"}
    assert len(list(made.glob("*/*/images/*.tif"))) == 6
    assert len(list(made.glob("*/*/annotations.json"))) == 2


FAULTS = {
    "8-bit pictures": (
        ["--images", "ir8"],
        "--images = ir8; expected ir16 with --format tiff, which is in kelvin",
    ),
    "links": (
        ["--link", "hard"],
        "--link = hard; expected none with --format tiff: pictures are written anew",
    ),
    "an origin that is none": (
        ["--origin", "here"],
        "--origin = here; expected LAT,LON or LAT,LON,HEIGHT: -89 to 89 deg, -180 to 180 deg, -500 to 9000 m, "
        "e.g. -19.3,23.1",
    ),
    "pixels that there are not": (
        ["--tiff-type", "float64"],
        "--tiff-type: float64 not in {float32,uint16}; see veldt export --help",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_request_that_cannot_be_meant(place, name):
    options, message = FAULTS[name]
    done = place("export", "data", "--out", "x", "--format", "tiff", *options)
    assert (done.code, done.out, done.err) == (2, "", f"veldt: {message}\n")
    assert not list(place.folder.glob("x*"))


@pytest.mark.parametrize("option", [("--tiff-type", "uint16"), ("--origin", "1,2")])
def test_options_of_tiffs_alone(place, option):
    done = place("export", "data", "--out", "x", "--format", "yolo", *option)
    message = f"{option[0]} = {option[1]}; expected none with --format yolo: only tiff has it"
    assert (done.code, done.out, done.err) == (2, "", f"veldt: {message}\n")


def test_labels_without_temperatures(place):
    done = place("export", "data/annotations.json", "--out", "x", "--format", "tiff")
    message = "--format = tiff; expected another; only Veldt datasets have temperatures"
    assert (done.code, done.out, done.err) == (2, "", f"veldt: {message}\n")


DAMAGED = {
    "no number": ('{"frame_index": 0, "time_s": ', "data/clips/one/frames.jsonl:1: not a frame of a clip: "),
    "a short pose": (
        '{"frame_index": 0, "time_s": 0, "camera_to_world": [1]}',
        "frames.jsonl:1: not a frame",
    ),
    "far away": (
        json.dumps({"frame_index": 0, "time_s": 0, "camera_to_world": [1e300] * 16}),
        "camera_to_world: position = 1e+300 m; expected -100000 to 100000 m",
    ),
}


@pytest.mark.parametrize("name", DAMAGED)
def test_damaged_poses(place, veldt, name):
    line, message = DAMAGED[name]
    shutil.copytree(place.folder / "data", veldt.folder / "data")
    (veldt.folder / "data" / "clips" / "one" / "frames.jsonl").write_text(line)
    done = veldt("export", "data", "--out", "x", "--format", "tiff", "--progress", "none")
    assert (done.code, done.out) == (1, "")
    assert message in done.err
    assert not list(veldt.folder.glob("x*"))
