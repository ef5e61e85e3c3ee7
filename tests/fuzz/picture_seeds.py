"""TIFF, PNG and JPEG files of 8 x 6 pixels, one for each kind of picture that is read as levels or temperatures."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import OpenImageIO

from png_seeds import GREY, png

# Numbers of TIFF's tags and types (TIFF revision 6.0, 1992, section 2).
WIDTH, HEIGHT, BITS, COMPRESSION, PHOTOMETRIC, STRIP = 256, 257, 258, 259, 262, 273
SAMPLES, ROWS, STRIP_BYTES, FORMAT, GDAL_METADATA = 277, 278, 279, 339, 42112
SHORT, LONG, ASCII = 3, 4, 2
HEAD_BYTES = 8
PLAIN, DEFLATE = 1, 8
XMP = (
    'http://ns.adobe.com/xap/1.0/\0<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf='
    '"http://www.w3.org/1999/02/22-rdf-syntax-ns#"><rdf:Description xmlns:drone-dji="http://www.dji.com/drone-dji/1.0/"'
    ' drone-dji:RelativeAltitude="+60.10" drone-dji:GimbalPitchDegree="-45.00"></rdf:Description></rdf:RDF></x:xmpmeta>'
)
COUNTS = '<GDALMetadata><Item name="SCALE" sample="0" role="scale">0.04</Item></GDALMetadata>'


def even(data: bytes) -> bytes:
    """Filled up, because what follows begins at an even place."""
    return data + bytes(len(data) % 2)


def tiff(pixels: np.ndarray, compression: int = PLAIN, metadata: str = "") -> bytes:
    """A little-endian file of one strip: integers, or floats, (height, width) or (height, width, 3)."""
    samples = pixels.shape[2] if pixels.ndim == 3 else 1
    data = pixels.astype(pixels.dtype.newbyteorder("<")).tobytes()
    data = even(zlib.compress(data) if compression == DEFLATE else data)
    text = even(metadata.encode() + b"\0")
    bits = struct.pack(f"<{samples}H", *[8 * pixels.itemsize] * samples)
    tags = [
        (WIDTH, LONG, 1, pixels.shape[1]),
        (HEIGHT, LONG, 1, pixels.shape[0]),
        (BITS, SHORT, samples, 8 * pixels.itemsize if samples == 1 else HEAD_BYTES),
        (COMPRESSION, SHORT, 1, compression),
        (PHOTOMETRIC, SHORT, 1, 2 if samples == 3 else 1),
        (STRIP, LONG, 1, HEAD_BYTES + len(bits) + len(text)),
        (SAMPLES, SHORT, 1, samples),
        (ROWS, LONG, 1, pixels.shape[0]),
        (STRIP_BYTES, LONG, 1, len(data)),
        (FORMAT, SHORT, 1, 3 if pixels.dtype.kind == "f" else 1),
        *([(GDAL_METADATA, ASCII, len(text), HEAD_BYTES + len(bits))] if metadata else []),
    ]
    directory = struct.pack("<H", len(tags)) + b"".join(struct.pack("<HHII", *tag) for tag in tags)
    head = struct.pack("<2sHI", b"II", 42, HEAD_BYTES + len(bits) + len(text) + len(data))
    return head + bits + text + data + directory + bytes(4)


def write_jpeg(file: Path, pixels: np.ndarray, tags: dict | None = None) -> None:
    """A JPEG of 8-bit grey levels."""
    spec = OpenImageIO.ImageSpec(pixels.shape[1], pixels.shape[0], 1, "uint8")
    for name, value in (tags or {}).items():
        spec.attribute(name, value)
    out = OpenImageIO.ImageOutput.create(str(file))
    out.open(str(file), spec)
    out.write_image(pixels[..., np.newaxis])
    out.close()


def write_photo(file: Path, pixels: np.ndarray) -> None:
    """The same with the EXIF and XMP of a drone."""
    write_jpeg(
        file, pixels, {"Model": "M3T", "Exif:FocalLength": 9.1, "GPS:AltitudeRef": 0, "GPS:Altitude": 960.1}
    )
    content, xmp = file.read_bytes(), XMP.encode()
    file.write_bytes(content[:2] + b"\xff\xe1" + struct.pack(">H", len(xmp) + 2) + xmp + content[2:])


def write_picture_seeds(folder: Path) -> None:
    """Write all of them into an existing folder."""
    level = np.arange(48, dtype=np.uint8).reshape(6, 8)
    counts = (7000 + 10 * level.astype(np.uint16)).astype(np.uint16)
    kelvin = (280 + level / 8).astype(np.float32)
    pictures = {
        "grey8.tif": tiff(level),
        "grey_as_colour.tif": tiff(np.dstack([level] * 3)),
        "counts.tif": tiff(counts, metadata=COUNTS),
        "counts_without_scale.tif": tiff(counts, DEFLATE),
        "kelvin.tif": tiff(kelvin),
        "kelvin_deflate.tif": tiff(kelvin, DEFLATE),
        "counts.png": png(counts, GREY),
    }
    for name, content in pictures.items():
        (folder / name).write_bytes(content)
    write_jpeg(folder / "grey.jpg", level)
    write_photo(folder / "photo.jpg", level)
