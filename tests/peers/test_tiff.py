"""TIFFs, read by other programs: pixels by Pillow and tifffile, positions and attitudes as OpenDroneMap reads them.

OpenDroneMap's way (opendm/photo.py, commit 00c3f89): ExifRead for EXIF and GPS; the bytes from "<x:xmpmeta" to
"</x:xmpmeta>" through xmltodict for XMP, where a tag is an attribute (@Camera:Yaw) or an element with a sequence. Yaw
is that of the picture's top, clockwise from north; pitch is 0 straight down and 90 at the horizon ahead.
"""

import json
import math
import xml.etree.ElementTree

import exifread
import numpy as np
import pytest
import tifffile
import xmltodict
from PIL import Image

from earth import axes_at, earth_coordinates_m

ORIGIN = (-19.3, 23.1, 950.0)
OPTIONS = (f"--origin={','.join(map(str, ORIGIN))}",)
FRAMES = 12
PITCH_UM, WIDTH_PX = 17, 67


def _file(folder, frame: int):
    return folder / "survey" / "images" / f"survey_{frame:06d}.tif"


def _exif(file) -> dict:
    with open(file, "rb") as opened:
        return exifread.process_file(opened, details=True)


def _xmp(file) -> dict:
    content = file.read_bytes()
    begin, end = content.find(b"<x:xmpmeta"), content.find(b"</x:xmpmeta")
    assert 0 < begin < end
    document = xmltodict.parse(content[begin : end + 12].decode("utf8"))
    return document["x:xmpmeta"]["rdf:RDF"]["rdf:Description"]


def _angle_deg(tags: dict, name: str) -> float:
    parts = [float(value) for value in tags[f"GPS {name}"].values]
    sign = -1 if tags[f"GPS {name}Ref"].values in ("S", "W") else 1
    return sign * (parts[0] + parts[1] / 60 + parts[2] / 3600)


def _height_m(tags: dict) -> float:
    sign = -1 if tags["GPS GPSAltitudeRef"].values[0] > 0 else 1
    return sign * float(tags["GPS GPSAltitude"].values[0])


@pytest.fixture(scope="module", name="poses")
def _poses(place) -> list[dict]:
    return json.loads((place.folder / "passes" / "survey.json").read_text())


@pytest.mark.parametrize("kind", ["float32", "uint16"])
def test_pixels(export, place, kind):
    folder = export("survey", "tiff", "--tiff-type", kind)
    for frame in range(FRAMES):
        counts = np.asarray(Image.open(place.folder / f"survey/clips/survey/ir16/{frame:06d}.png"))
        expected = (counts * 0.01).astype(np.float32) if kind == "float32" else counts
        for read in (np.asarray(Image.open(_file(folder, frame))), tifffile.imread(_file(folder, frame))):
            assert read.dtype == kind
            assert (read == expected).all()


@pytest.mark.parametrize("kind, scale", [("float32", None), ("uint16", "0.01")])
def test_gdal_s_scale_and_unit(export, kind, scale):
    folder = export("survey", "tiff", "--tiff-type", kind)
    with tifffile.TiffFile(_file(folder, 0)) as opened:
        text = opened.pages[0].tags["GDAL_METADATA"].value
    items = {item.get("role"): item.text for item in xml.etree.ElementTree.fromstring(text)}
    assert (items["unittype"], items.get("scale")) == ("K", scale)


def test_positions_are_within_a_centimetre(export, poses):
    folder = export("survey", "tiff", *OPTIONS)
    for frame, pose in enumerate(poses):
        tags = _exif(_file(folder, frame))
        earth_m = earth_coordinates_m(
            _angle_deg(tags, "GPSLatitude"), _angle_deg(tags, "GPSLongitude"), _height_m(tags)
        )
        local_m = axes_at(*ORIGIN[:2]) @ (earth_m - earth_coordinates_m(*ORIGIN))
        assert np.abs(local_m - np.array(pose["camera_to_world"])[[3, 7, 11]]).max() < 0.01


def test_attitudes(export, poses):
    folder = export("survey", "tiff", *OPTIONS)
    for frame, pose in enumerate(poses):
        xmp = _xmp(_file(folder, frame))
        found = [float(xmp[f"@Camera:{key}"]) for key in ("Yaw", "Pitch", "Roll")]
        # 2.1 km from the origin, north and up turn by 0.019 deg; yaw and roll by 1 / cos(80 deg) of that at most.
        off_deg = np.abs([math.remainder(a - b, 360) for a, b in zip(found, pose["angles_deg"])])
        assert off_deg[1] < 0.02 and off_deg.max() < 0.02 / math.cos(math.radians(pose["angles_deg"][1]))


def test_views_as_opendronemap_turns_them(export, poses):
    # The body's axes by yaw, pitch and roll in north, east, down of the camera's own place (Bäumker and Heimes, "New
    # Calibration and Computing Method for Direct Georeferencing", 2001): no approximation is left.
    folder = export("survey", "tiff", *OPTIONS)
    for frame, pose in enumerate(poses):
        file = _file(folder, frame)
        tags, xmp = _exif(file), _xmp(file)
        y, p, r = (math.radians(float(xmp[f"@Camera:{key}"])) for key in ("Yaw", "Pitch", "Roll"))
        down = np.array(
            [
                math.cos(y) * math.sin(p) * math.cos(r) + math.sin(y) * math.sin(r),
                math.sin(y) * math.sin(p) * math.cos(r) - math.cos(y) * math.sin(r),
                math.cos(p) * math.cos(r),
            ]
        )
        here = axes_at(_angle_deg(tags, "GPSLatitude"), _angle_deg(tags, "GPSLongitude"))
        view = here.T @ (down[[1, 0, 2]] * [1, 1, -1])
        matrix = np.array(pose["camera_to_world"]).reshape(4, 4)
        # Angles have six decimals: 1e-8 rad.
        assert np.abs(axes_at(*ORIGIN[:2]) @ view - matrix[:3, 2]).max() < 3e-8


def test_the_camera_as_opendronemap_takes_it(export):
    file = _file(export("survey", "tiff", *OPTIONS), 0)
    tags, xmp = _exif(file), _xmp(file)
    assert tags["Image Make"].values == "Veldt"
    assert xmp["Camera:BandName"]["rdf:Seq"]["rdf:li"] == "LWIR"
    assert float(xmp["@Camera:GPSXYAccuracy"]) == 0.01
    # Ratio of focal length and sensor width: units of 3 are centimetres.
    assert tags["EXIF FocalPlaneResolutionUnit"].values == [3]
    width_mm = WIDTH_PX / float(tags["EXIF FocalPlaneXResolution"].values[0]) * 10
    assert width_mm == pytest.approx(WIDTH_PX * PITCH_UM / 1000, rel=1e-5)
    assert float(tags["EXIF FocalLength"].values[0]) / width_mm == pytest.approx(30 / WIDTH_PX, rel=1e-5)


def test_labels_beside_the_images(export, place):
    folder = export("survey", "tiff", *OPTIONS) / "survey"
    document = json.loads((folder / "annotations.json").read_text())
    assert all((folder / image["file_name"]).is_file() for image in document["images"])
    assert len(document["annotations"]) == len(place.read("survey/annotations.json")["annotations"])
