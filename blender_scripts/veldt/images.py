"""Read and write images with OpenImageIO.

OpenImageIO takes .3 s to load, so it is imported only when an image is read or written. Not for Blender, whose Python
may lack it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

_SIGNATURES = (b"\x89PNG\r\n\x1a\n", b"\x76\x2f\x31\x01")  # PNG; OpenEXR
_MOST_PIXELS = 20_000 * 20_000


def read_values(path: Path) -> np.ndarray:
    """Values [row from the top, column] of a grey PNG, 0 to 1, or of an EXR's first channel, unchanged; float64.

    ValueError if the file is neither, has more than 4e8 pixels or is damaged.
    """
    with open(path, "rb") as file:
        if not file.read(8).startswith(_SIGNATURES):
            raise ValueError("it is neither")
    oiio = _oiio()
    with _silent_stderr():
        image = oiio.ImageInput.open(str(path))
        if image is None:
            raise ValueError(_one_line(oiio.geterror()) or "OpenImageIO cannot read it")
        _check(image)
        is_png = image.format_name() == "png"
        pixels = image.read_image(0, 0, 0, 1, image.spec().format if is_png else oiio.FLOAT)
        fault = image.geterror()
        image.close()
    if pixels is None or fault:
        raise ValueError(_one_line(fault) or "OpenImageIO cannot read its pixels")
    return pixels[..., 0].astype(float) / (np.iinfo(pixels.dtype).max if is_png else 1.0)


def write_rgb(path: Path, colours: np.ndarray) -> None:
    """Write an image (height, width, 3) of 8 bits; OSError if that fails."""
    oiio = _oiio()
    image = oiio.ImageOutput.create(str(path))
    height, width, channels = colours.shape
    written = image is not None and image.open(str(path), oiio.ImageSpec(width, height, channels, "uint8"))
    if not (written and image.write_image(np.ascontiguousarray(colours)) and image.close()):
        raise OSError(f"{path}: {_one_line(image.geterror() if image else oiio.geterror())}")


def _check(image) -> None:
    spec = image.spec()
    if image.format_name() == "png" and spec.nchannels != 1:
        raise ValueError("its pixels are not grey")
    if spec.width * spec.height > _MOST_PIXELS:
        raise ValueError(f"{spec.width} x {spec.height} pixels are more than {_MOST_PIXELS}")


def _oiio():
    import OpenImageIO  # pylint: disable=import-outside-toplevel

    # One thread: this process may fork later, and a fork has no threads but its own.
    OpenImageIO.attribute("threads", 1)
    OpenImageIO.attribute("exr_threads", -1)
    return OpenImageIO


def _one_line(fault: str) -> str:
    return "; ".join(line.strip() for line in fault.splitlines() if line.strip())


@contextmanager
def _silent_stderr() -> Iterator[None]:
    """Drop what libpng prints: of a script that rejects a config, standard error holds its faults alone."""
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
