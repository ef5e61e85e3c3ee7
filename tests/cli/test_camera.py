"""`camera` reads EXIF and XMP of real JPEGs, whose segments the tests write byte by byte, into parts of a config."""

import struct

import OpenImageIO
import pytest

from configs import tiny

XMP = "http://ns.adobe.com/xap/1.0/\0"
DJI = 'xmlns:drone-dji="http://www.dji.com/drone-dji/1.0/"'


def _segment(content: bytes) -> bytes:
    return b"\xff\xe1" + struct.pack(">H", len(content) + 2) + content


def _xmp(attributes: str) -> bytes:
    rdf = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
    return _segment(
        f'{XMP}<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="{rdf}">'
        f"<rdf:Description {DJI} {attributes}></rdf:Description></rdf:RDF></x:xmpmeta>".encode()
    )


def _text(tag: int, text: str) -> tuple:
    return tag, 2, len(text) + 1, text.encode() + b"\0"


def _rationals(tag: int, *values: float) -> tuple:
    return tag, 5, len(values), b"".join(struct.pack("<II", round(100 * value), 100) for value in values)


def _directory(entries: list[tuple], start: int) -> bytes:
    """A TIFF directory that begins at `start`, with what does not fit into its entries behind it."""
    data, table = b"", struct.pack("<H", len(entries))
    after = start + 2 + 12 * len(entries) + 4
    for tag, kind, count, value in sorted(entries):
        if len(value) <= 4:
            table += struct.pack("<HHI", tag, kind, count) + value.ljust(4, b"\0")
        else:
            table += struct.pack("<HHII", tag, kind, count, after + len(data))
            data += value + b"\0" * (len(value) % 2)
    return table + struct.pack("<I", 0) + data


def _exif(model: str, focal_mm: float) -> bytes:
    """Make, model and lens, and a moment and a place in Hwange."""
    pointer = [(0x8769, 4, 1, bytes(4)), (0x8825, 4, 1, bytes(4))]
    makers = [_text(0x10F, "DJI"), _text(0x110, model)]
    lens = [_rationals(0x920A, focal_mm)]
    place = [
        *(_text(1, "S"), _rationals(2, 18, 30, 0), _text(3, "E"), _rationals(4, 26, 15, 0)),
        *((5, 1, 1, b"\0"), _rationals(6, 960.1), _rationals(7, 23, 30, 0), _text(29, "2026:07:08")),
    ]
    lens_at = 8 + len(_directory(makers + pointer, 8))
    place_at = lens_at + len(_directory(lens, lens_at))
    pointer = [(0x8769, 4, 1, struct.pack("<I", lens_at)), (0x8825, 4, 1, struct.pack("<I", place_at))]
    first = _directory(makers + pointer, 8)
    return _segment(
        b"Exif\0\0II*\0"
        + struct.pack("<I", 8)
        + first
        + _directory(lens, lens_at)
        + _directory(place, place_at)
    )


@pytest.fixture(scope="module", name="plain")
def _plain(tmp_path_factory) -> bytes:
    """A JPEG of 640 x 512 px without tags."""
    file = tmp_path_factory.mktemp("plain") / "plain.jpg"
    picture = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(640, 512, 1, "uint8"))
    assert picture.write(str(file))
    return file.read_bytes()


def _photo(plain: bytes, height_m: float = 60.1, pitch_deg: float = -45, model: str = "M3T") -> bytes:
    xmp = _xmp(
        'drone-dji:ImageSource="InfraredCamera" drone-dji:FlightYawDegree="+30.00" '
        f'drone-dji:RelativeAltitude="{height_m:+.2f}" drone-dji:GimbalPitchDegree="{pitch_deg:+.2f}"'
    )
    return plain[:2] + _exif(model, 9.1) + xmp + plain[2:]


def test_a_photo_becomes_parts_of_a_config(veldt, plain):
    (veldt.folder / "a.jpg").write_bytes(_photo(plain))
    done = veldt("camera", "a.jpg")
    assert (done.code, done.err) == (0, "")
    assert done.json() == {
        "sensor": {"preset": "dji_mavic_3t"},
        "weather": {"date": "2026-07-09", "time": "01:15", "latitude_deg": -18.5, "elevation_m": 900},
        "flight": {"altitude_m": 60.1, "look_angle_deg": 45, "heading_deg": 60},
    }


def test_what_is_missing_is_named_on_standard_error(veldt, plain):
    (veldt.folder / "a.jpg").write_bytes(plain[:2] + _exif("M3T", 9.1) + plain[2:])
    done = veldt("camera", "a.jpg")
    assert done.code == 0
    assert set(done.json()) == {"sensor", "weather"}
    assert done.err == (
        "a.jpg: no drone-dji:RelativeAltitude, FLIR:MAVRelativeAltitude or Camera:AboveGroundAltitude; "
        "expected one of them for flight.altitude_m\n"
        "a.jpg: no drone-dji:GimbalPitchDegree or Camera:Pitch; expected one of them for flight.look_angle_deg\n"
        "a.jpg: flight.altitude_m is left out, and 61 m by default\n"
        "a.jpg: flight.look_angle_deg is left out, and 90 deg by default\n"
    )
    assert veldt("camera", "a.jpg", "--quiet").err == ""


def test_a_folder_becomes_views_that_a_flight_draws(veldt, plain):
    (veldt.folder / "photos").mkdir()
    for name, height_m, pitch_deg in (("1.JPG", 60, -90), ("2.JPG", 60, -90), ("3.jpeg", 120, -30)):
        (veldt.folder / "photos" / name).write_bytes(_photo(plain, height_m, pitch_deg))
    (veldt.folder / "photos" / "notes.txt").write_text("not read")
    done = veldt("camera", "photos", "--views", "views.csv")
    assert (done.code, done.err) == (0, "")
    fragment = done.json()
    assert fragment == {"sensor": {"preset": "dji_mavic_3t"}, "flight": {"views": {"file": "views.csv"}}}
    assert (veldt.folder / "views.csv").read_text().splitlines()[1:] == [
        "altitude_m,look_angle_deg,weight",
        "60,90,2",
        "120,30,1",
    ]
    config = tiny()
    config["sensor"] = fragment["sensor"]
    for key in ("altitude_m", "look_angle_deg", "view"):
        config["clips"][0]["flight"].pop(key, None)
    config["clips"][0]["flight"] |= fragment["flight"]
    veldt.write("config.json", config)
    assert veldt("validate", "config.json").code == 0


def test_photos_without_a_view_are_named_and_left_out(veldt, plain):
    (veldt.folder / "a.jpg").write_bytes(_photo(plain))
    (veldt.folder / "b.jpg").write_bytes(plain)
    (veldt.folder / "c.jpg").write_bytes(b"\xff\xd8\xff junk")
    (veldt.folder / "d.jpg").write_bytes(_photo(plain, pitch_deg=20))
    done = veldt("camera", "a.jpg", "b.jpg", "c.jpg", "d.jpg", "--views", "views.csv")
    assert done.code == 3
    faults = done.err.splitlines()
    assert faults[0] == (
        "b.jpg: no tags of a camera; expected EXIF's Model, or XMP of a drone (drone-dji, FLIR, Camera)"
    )
    assert faults[1].startswith("c.jpg: damaged: ")
    assert faults[2] == (
        "d.jpg: drone-dji:GimbalPitchDegree = 20 deg; expected -91.5 to -1 deg, below the horizon"
    )
    assert len(faults) == 3
    assert (veldt.folder / "views.csv").read_text().endswith("\n60.1,45,1\n")


def test_faults(veldt, plain):
    (veldt.folder / "a.jpg").write_bytes(_photo(plain))
    (veldt.folder / "b.jpg").write_bytes(_photo(plain, model="ZH20T"))
    (veldt.folder / "c.jpg").write_bytes(plain)
    (veldt.folder / "empty").mkdir()
    (veldt.folder / "views.csv").write_text("mine")

    def fault(*words: str) -> tuple[int, str]:
        done = veldt("camera", *words)
        assert done.out == ""
        return done.code, done.err.removeprefix("veldt: ").rstrip("\n")

    assert fault("a.jpg", "b.jpg") == (
        2,
        "2 photos; expected one, or --views FILE.csv, which takes the views of many",
    )
    assert fault("empty") == (2, "PHOTO = empty; expected a photo, or a folder with .jpg, .png or .tif files")
    assert fault("a.jpg", "--views", "views.csv") == (
        2,
        "--views = views.csv; expected a file that does not exist yet",
    )
    assert fault("missing.jpg") == (1, "cannot read missing.jpg: no such file")
    assert fault("a.jpg", "b.jpg", "--views", "new.csv")[0] == 1
    assert "photos of 2 cameras: " in fault("a.jpg", "b.jpg", "--views", "new.csv")[1]
    assert fault("c.jpg", "--views", "new.csv")[1].endswith(
        "no thermal photo with height and gimbal angle; expected at least one"
    )
    assert not (veldt.folder / "new.csv").exists()
    assert (veldt.folder / "views.csv").read_text() == "mine"
