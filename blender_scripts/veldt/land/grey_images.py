"""Read the user's height and density maps: grey PNG files of 8 or 16 bits, and OpenEXR files.

PNG is decoded here because Blender's Python may lack an image library; EXR is read through OpenImageIO, which must be
installed.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np

from ..faults import ConfigError
from ..regular_files import read_regular

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_GREY = 0
_MOST_PIXELS = 20_000 * 20_000
_MOST_BYTES = 2 << 30  # more than an EXR of so many pixels has


def read_grey(path: Path, where: str) -> np.ndarray:
    """Values [row from the top, column] of an image: 0 to 1 for a PNG file, unchanged for the first channel of an EXR.

    ConfigError, naming `where` and the file, if it cannot be read, is not grey or has values that are not finite.
    """
    try:
        content = read_regular(Path(path), _MOST_BYTES)
    except OSError as error:
        raise ConfigError(f"{where} = {path}; expected a readable file ({error.strerror})") from error
    if not content:
        raise ConfigError(f"{where} = {path}; expected an image, and the file is empty")
    try:
        values = _png(content) if content.startswith(_SIGNATURE) else _exr(Path(path))
    except (ValueError, struct.error, zlib.error) as error:
        raise ConfigError(f"{where} = {path}; expected a grey PNG or an EXR file ({error})") from error
    if min(values.shape) < 2:
        raise ConfigError(
            f"{where} = {path}, {values.shape[1]} x {values.shape[0]} pixels; expected 2 x 2 or more"
        )
    if not np.isfinite(values).all():
        raise ConfigError(f"{where} = {path}; expected finite values in all pixels")
    return values


def sample(values: np.ndarray, size_m: float, x_m, y_m) -> np.ndarray:
    """Values interpolated bilinearly: corner pixels lie on the corners of the place, with the top row in the north."""
    rows, columns = values.shape
    u, column = _split((np.asarray(x_m, float) / size_m + 0.5) * (columns - 1), columns)
    v, row = _split((0.5 - np.asarray(y_m, float) / size_m) * (rows - 1), rows)
    top = values[row, column] * (1 - u) + values[row, column + 1] * u
    bottom = values[row + 1, column] * (1 - u) + values[row + 1, column + 1] * u
    return top * (1 - v) + bottom * v


def _split(place: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Fraction beyond the pixel before a position, and the index of that pixel, clamped to the image."""
    place = np.clip(place, 0.0, count - 1.0)
    number = np.minimum(place.astype(np.int64), count - 2)
    return place - number, number


def _png(content: bytes) -> np.ndarray:
    """A grey PNG's values (PNG, ISO/IEC 15948): no palette, no colour, not interlaced."""
    header, data = b"", []
    place = len(_SIGNATURE)
    while place + 8 <= len(content):
        (length,), kind = struct.unpack_from(">I", content, place), content[place + 4 : place + 8]
        body = content[place + 8 : place + 8 + length]
        if kind == b"IHDR":
            header = body
        elif kind == b"IDAT":
            data.append(body)
        place += length + 12
    width, height, bits, colour, _, _, interlace = struct.unpack(">IIBBBBB", header)
    if colour != _GREY or bits not in (8, 16) or interlace:
        raise ValueError("its pixels are not grey, of 8 or 16 bits, row by row")
    if width * height > _MOST_PIXELS:
        raise ValueError(f"{width} x {height} pixels are more than {_MOST_PIXELS}")
    stride = width * bits // 8
    raw = zlib.decompressobj().decompress(b"".join(data), height * (stride + 1))
    if len(raw) < height * (stride + 1):
        raise ValueError("it is cut short")
    lines = np.frombuffer(raw, np.uint8).reshape(height, stride + 1)
    pixels = _unfiltered(lines[:, 0], lines[:, 1:], bits // 8)
    return pixels.reshape(-1).view(">u2" if bits == 16 else np.uint8).reshape(height, width) / (
        2.0**bits - 1
    )


def _unfiltered(filters: np.ndarray, lines: np.ndarray, step: int) -> np.ndarray:
    """Bytes (rows, stride) with each row's prediction from the left and from above added back."""
    pixels = np.zeros(lines.shape, np.uint8)
    above = np.zeros(lines.shape[1], np.uint8)
    for row, (kind, line) in enumerate(zip(filters, lines)):
        if kind == 0:
            above = line
        elif kind == 1:
            above = _summed(line, step)
        elif kind == 2:
            above = line + above
        elif kind in (3, 4):
            above = _predicted(kind, line, above, step)
        else:
            raise ValueError(f"row {row} has no filter {kind}")
        pixels[row] = above
    return pixels


def _summed(line: np.ndarray, step: int) -> np.ndarray:
    """Running sums of bytes modulo 256, separately for each of the `step` bytes of a pixel."""
    return np.add.accumulate(line.reshape(-1, step), axis=0, dtype=np.uint8).reshape(-1)


def _predicted(kind: int, line: np.ndarray, above: np.ndarray, step: int) -> np.ndarray:
    """A row predicted from its left and upper neighbours: by their mean (3), or by Paeth's rule (4)."""
    out, up = bytearray(line.tobytes()), bytes(step) + above.tobytes()
    for k in range(len(out)):
        left = out[k - step] if k >= step else 0
        if kind == 3:
            guess = (left + up[k + step]) // 2
        else:
            guess = _paeth(left, up[k + step], up[k])
        out[k] = (out[k] + guess) & 0xFF
    return np.frombuffer(bytes(out), np.uint8)


def _paeth(left: int, above: int, corner: int) -> int:
    guess = left + above - corner
    off = abs(guess - left), abs(guess - above), abs(guess - corner)
    return (left, above, corner)[off.index(min(off))]


def _exr(path: Path) -> np.ndarray:
    """An EXR's first channel, as float64."""
    try:
        import OpenImageIO as oiio  # pylint: disable=import-outside-toplevel
    except ImportError as error:
        raise ValueError(
            "it is not a PNG; reading EXR needs Python's OpenImageIO (package python3-openimageio)"
        ) from error
    image = oiio.ImageInput.open(str(path))
    if image is None:
        raise ValueError(oiio.geterror() or "OpenImageIO cannot read it")
    pixels = image.read_image(0, 0, 0, 1, oiio.FLOAT)
    image.close()
    if pixels is None:
        raise ValueError("OpenImageIO cannot read its pixels")
    return np.asarray(pixels, float)[..., 0]
