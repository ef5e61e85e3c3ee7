"""Read and write images with OpenImageIO.

OpenImageIO takes .3 s to load, so it is imported only when an image is read or written. Not used in Blender, whose
Python may lack it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from .faults import listing

_DECODERS = {b"\x89PNG\r\n\x1a\n": "png", b"\x76\x2f\x31\x01": "exr"}  # by the first bytes
_MOST_PIXELS = 20_000 * 20_000


def read_values(path: Path, channel: str | None = None) -> np.ndarray:
    """Values [row from the top, column] of a grey PNG, 0 to 1, or of an EXR's channel, unchanged; float64.

    `channel` names one of an EXR that has several; PART.CHANNEL, if it has several parts. ValueError if the file is
    neither, lacks the channel, has several channels and none is named, has more than 4e8 pixels, or is damaged.
    """
    with open(path, "rb") as file:
        begin = file.read(8)
    kind = next((kind for signature, kind in _DECODERS.items() if begin.startswith(signature)), None)
    if kind is None:
        raise ValueError("it is neither")
    oiio = _oiio()
    with _silent_stderr(), TemporaryDirectory() as folder:
        # From Python, OpenImageIO 2.4 chooses the decoder by the file's name.
        link = Path(folder) / f"map.{kind}"
        link.symlink_to(path.absolute())
        image = oiio.ImageInput.open(str(link))
        if image is None:
            raise ValueError(_one_line(oiio.geterror()) or "OpenImageIO cannot read it")
        try:
            return _values(oiio, image, kind == "png", channel)
        finally:
            image.close()


def _values(oiio, image, is_png: bool, channel: str | None) -> np.ndarray:
    part, number = _chosen(_channels(image), is_png, channel)
    image.seek_subimage(part, 0)
    spec = image.spec()
    if spec.width * spec.height > _MOST_PIXELS:
        raise ValueError(f"{spec.width} x {spec.height} pixels are more than {_MOST_PIXELS}")
    if spec.deep:
        raise ValueError("its pixels are deep")
    pixels = image.read_image(part, 0, number, number + 1, spec.format if is_png else oiio.FLOAT)
    fault = image.geterror()
    if pixels is None or fault:
        raise ValueError(_one_line(fault) or "OpenImageIO cannot read its pixels")
    return pixels[..., 0].astype(float) / (np.iinfo(pixels.dtype).max if is_png else 1.0)


def _channels(image) -> dict[str, tuple[int, int]]:
    """The part and number of each channel, by name."""
    parts = []
    while image.seek_subimage(len(parts), 0):
        spec = image.spec()
        parts.append((spec.getattribute("oiio:subimagename") or str(len(parts)), spec.channelnames))
    return {
        name if len(parts) == 1 else f"{part}.{name}": (p, k)
        for p, (part, names) in enumerate(parts)
        for k, name in enumerate(names)
    }


def _chosen(channels: dict[str, tuple[int, int]], is_png: bool, channel: str | None) -> tuple[int, int]:
    if is_png and channel is not None:
        raise ValueError(f'a PNG has no channel "{channel}"')
    if is_png and len(channels) != 1:
        raise ValueError("its pixels are not grey")
    if channel is None and len(channels) != 1:
        raise ValueError(f"it has {len(channels)} channels, {listing(channels)}; `channel` chooses one")
    if channel is not None and channel not in channels:
        raise ValueError(f'it has no channel "{channel}", but {listing(channels)}')
    return next(iter(channels.values())) if channel is None else channels[channel]


def write_rgb(path: Path, colours: np.ndarray) -> None:
    """Write an image (height, width, 3) of 8 bits; OSError if that fails."""
    oiio = _oiio()
    image = oiio.ImageOutput.create(str(path))
    height, width, channels = colours.shape
    written = image is not None and image.open(str(path), oiio.ImageSpec(width, height, channels, "uint8"))
    if not (written and image.write_image(np.ascontiguousarray(colours)) and image.close()):
        raise OSError(f"{path}: {_one_line(image.geterror() if image else oiio.geterror())}")


def _oiio():
    import OpenImageIO  # pylint: disable=import-outside-toplevel

    # One thread: this process may fork later, and threads do not survive a fork.
    OpenImageIO.attribute("threads", 1)
    OpenImageIO.attribute("exr_threads", -1)
    OpenImageIO.attribute("try_all_readers", 0)  # untrusted bytes must not reach decoders of other formats
    return OpenImageIO


def _one_line(fault: str) -> str:
    return "; ".join(line.strip() for line in fault.splitlines() if line.strip())


@contextmanager
def _silent_stderr() -> Iterator[None]:
    """Suppress libpng's output: on standard error, a script that rejects a config prints its faults alone."""
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
