"""Read the tags of a TIFF file byte by byte, independently of any library.

Source: TIFF revision 6.0 (1992), section 2; Exif 2.32 (CIPA DC-008), tables 4 to 15.
"""

from __future__ import annotations

import struct
from fractions import Fraction
from pathlib import Path

_FORMATS = {1: "B", 2: "c", 3: "H", 4: "I", 5: "II", 7: "B", 13: "I"}  # by TIFF's number of the type
EXIF, GPS = 34665, 34853  # where those directories are
DESCRIPTION, MAKE, MODEL, SOFTWARE, DATE_TIME, XMP, GDAL_METADATA = 270, 271, 272, 305, 306, 700, 42112
FOCAL_LENGTH, F_NUMBER, FOCAL_PLANE_X, FOCAL_PLANE_UNIT = 37386, 33437, 41486, 41488
DATE_TIME_ORIGINAL, SUBSEC_ORIGINAL = 36867, 37521


def read_tags(file: Path) -> dict[str, dict]:
    """The tags of a little-endian file by number: of the picture ("image"), and of "exif" and "gps" if it has them.

    Texts are str, bytes are bytes, fractions Fraction; several values are a list.
    """
    content = file.read_bytes()
    magic, version, first = struct.unpack_from("<2sHI", content)
    assert (magic, version) == (b"II", 42)
    tags = {"image": _directory(content, first)}
    for name, number in (("exif", EXIF), ("gps", GPS)):
        if number in tags["image"]:
            tags[name] = _directory(content, tags["image"][number])
    return tags


def _directory(content: bytes, offset: int) -> dict:
    (count,) = struct.unpack_from("<H", content, offset)
    entries = [struct.unpack_from("<HHI", content, offset + 2 + 12 * k) for k in range(count)]
    return {
        number: _value(content, kind, length, offset + 10 + 12 * k)
        for k, (number, kind, length) in enumerate(entries)
    }


def _value(content: bytes, kind: int, count: int, offset: int):
    form = "<" + _FORMATS[kind] * count
    if struct.calcsize(form) > 4:
        (offset,) = struct.unpack_from("<I", content, offset)
    if kind in (1, 2, 7) and count > 1:
        value = content[offset : offset + count]
        return value.rstrip(b"\0").decode() if kind == 2 else value
    values = struct.unpack_from(form, content, offset)
    if kind == 5:
        values = [Fraction(*pair) for pair in zip(values[::2], values[1::2])]
    return values[0] if len(values) == 1 else list(values)
