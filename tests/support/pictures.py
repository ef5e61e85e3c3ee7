"""Read and write pictures, independently of the program's own readers and writers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenImageIO


def channel_name(name: str) -> str:
    """A channel's name as Blender before 5.0 would have spelled it."""
    return name.replace("Object Index", "IndexOB").replace("Material Index", "IndexMA")


def read_planes(file: Path) -> dict[str, np.ndarray]:
    """All channels of a picture by name, each (height, width), in the type they are stored in."""
    opened = OpenImageIO.ImageInput.open(str(file))
    assert opened is not None, OpenImageIO.geterror()
    names = opened.spec().channelnames
    pixels = opened.read_image(opened.spec().format)
    opened.close()
    return {channel_name(name): pixels[..., k] for k, name in enumerate(names)}


def read_grey(file: Path) -> np.ndarray:
    """The only plane (height, width) of a grey picture."""
    (plane,) = read_planes(file).values()
    return plane


def write_exr(file: Path, planes: dict[str, np.ndarray]) -> None:
    """Write planes (height, width) as the float channels of an EXR file."""
    height, width = next(iter(planes.values())).shape
    spec = OpenImageIO.ImageSpec(width, height, len(planes), "float")
    spec.channelnames = tuple(planes)
    out = OpenImageIO.ImageOutput.create(str(file))
    assert out.open(str(file), spec), out.geterror()
    assert out.write_image(np.stack(list(planes.values()), axis=-1).astype(np.float32)), out.geterror()
    out.close()


def write_grey(file: Path, levels: np.ndarray, channels: int = 1) -> None:
    """Write levels (height, width) of 8 or 16 bits in the format of the file's name; with equal channels if several."""
    height, width = levels.shape
    spec = OpenImageIO.ImageSpec(width, height, channels, levels.dtype.name)
    out = OpenImageIO.ImageOutput.create(str(file))
    assert out.open(str(file), spec), out.geterror()
    assert out.write_image(np.repeat(levels[..., None], channels, axis=-1)), out.geterror()
    out.close()
